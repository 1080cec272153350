"""From where a motion catches the object, drawn: the open hand, the bands of the pre-image and the error they allow."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import radians

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from shapely import MultiPolygon, box

from palmar.faces.plots.areas import LEGEND_ROW, Band, draw_area, legend
from palmar.faces.plots.dimensions import dimension, note, radius_dimension, text_fits
from palmar.faces.plots.facts import FACTS, Fact, write_facts
from palmar.faces.plots.hand import WALL_ROOM, draw_hand, draw_object, draw_wall, finger_points, object_reach
from palmar.faces.plots.lettering import millimetres, square_millimetres
from palmar.faces.plots.sheet import MARGIN, MM, Extent, Pad, Room, Sheet, per_paper_mm, sheet
from palmar.faces.plots.strokes import stroke
from palmar.faces.plots.style import FINE, HEAVY, SMALL_SIZE, Role
from palmar.faces.words import region_notes, resting_rows
from palmar.geometry.planar_set import Circle, areal, inscribed_circle
from palmar.geometry.planar_set import seen_from_object as from_object
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.objects import Disk
from palmar.regions.on_the_wall import resting_height
from palmar.regions.region import Region

Place = tuple[float, float]

WHOLE = Band(Role.WHOLE, "whole region: all of the object starts inside", 0.0, dashes=(0, (1, 1.2)))
CENTRE = Band(Role.CENTRE, "centre region: the object's centre starts inside", 1.0)
CONTACT = Band(Role.CONTACT, "contact region: first contacts lie inside", 2.0, filled=False, dashes=(0, (4, 1.5)))
OUTER = Band(Role.LOST, "no start beyond this line is caught", 0.5, filled=False, dashes=(0, (2.5, 1.5)))
CERTAIN = Band(Role.HELD, "certain: by bounds instead of simulation", 2.0)
ERROR = Band(Role.LARGEST, "allowed error: the largest circle in the centre region", 3.0, filled=False)
PALM = Band(Role.CENTRE, "the middle of the palm starts inside", 1.0)
PALM_ERROR = replace(ERROR, words="allowed error: the largest circle in that region")

ROOM = Room(Pad(3.0, 11.0, 3.0, 5.0), Pad(12.0, 11.0, 2.0, 3.0), Pad(0.0, 0.0, FACTS, 0.0))
ROW_LEVEL = 3.5
VISIBLE = 5e-3
"""Error bands below this share of the area are too thin to draw."""
FAIR = radians(15.0)
ALONG = radians(50.0)


@dataclass(frozen=True)
class _Scene:
    """A region in the frame it is drawn in: where hand and object stand (m), the sets, the allowed error."""

    hand_at: Place
    object_at: Place | None
    sets: tuple[tuple[MultiPolygon, Band], ...]
    allowed: Circle | None


def region_picture(
    case: Case, region: Region, *, seen_from_object: bool = False, object_at: Place | None = None
) -> Figure:
    """One region; ``object_at`` (m, hand frame) is where the object is drawn, a valid start where not given."""
    return region_pictures(case, [region], seen_from_object=seen_from_object, object_at=object_at)


def region_pictures(
    case: Case, regions: Sequence[Region], *, seen_from_object: bool = False, object_at: Place | None = None
) -> Figure:
    """Regions of one case, one below the other at one scale, each with its facts beside it.

    In the hand's frame; or, seen from the object, where around it the middle of the palm may be. An empty region says
    why nothing is caught.
    """
    scenes = [_scene(case, each, seen_from_object, object_at) for each in regions]
    bands = _bands_drawn(scenes, PALM_ERROR if seen_from_object else ERROR)
    sides = replace(ROOM.sides, bottom=LEGEND_ROW * ((len(bands) + 1) // 2) + 2.0)
    beside = 3.0 if sum(case.open_joints) < FAIR or seen_from_object else 10.0
    room = replace(ROOM, sides=sides, inside=replace(ROOM.inside, left=beside, right=beside))
    title = "Where the hand may start" if seen_from_object else "Where the object may start"
    name = case.behaviour.name
    does = "closing" if name is BehaviourName.CLOSE else name.value.replace("_", " ")
    extents = [[_extent(case, each)] for each in scenes]
    page = sheet(extents, title=f"{title} for {does} to catch it", footer=" ".join(region_notes(regions)), room=room)
    for region, scene, (axes,) in zip(regions, scenes, page.panels, strict=True):
        theta = case.start.theta if region.orientations is None else region.orientations[0]
        _draw(axes, case, scene, theta)
        _row_on_the_wall(axes, case, region, scene)
        _facts(page, axes, case, region)
    legend(page, (MARGIN, page.box(page.panels[-1][0]).bottom - ROOM.outside.bottom), bands)
    return page.figure


def _bands_drawn(scenes: Sequence[_Scene], error: Band) -> list[Band]:
    """The bands that some scene shows, in the order of the legend."""
    shown = {band.words: band for scene in scenes for area, band in scene.sets if not area.is_empty}
    return [*shown.values(), error] if any(each.allowed for each in scenes) else []


def _scene(case: Case, region: Region, reversed_view: bool, object_at: Place | None) -> _Scene:
    if not reversed_view:
        at = object_at or _valid_start(region)
        outer = region.outer if region.outer is not None and region.band > VISIBLE * region.area else MultiPolygon()
        sets = (
            (region.whole, WHOLE),
            (outer, OUTER),
            (region.centre, CENTRE),
            (region.contact, CONTACT),
            (region.certain or MultiPolygon(), CERTAIN),
        )
        return _Scene((0.0, 0.0), at, sets, region.allowed_error)
    allowed = region.allowed_error
    turned = None if allowed is None else Circle((-allowed.centre[0], -allowed.centre[1]), allowed.radius)
    x, y = object_at or (allowed.centre if allowed else (0.0, case.hand.finger_length))
    return _Scene((-x, -y), (0.0, 0.0), ((from_object(region.centre), PALM),), turned)


def _valid_start(region: Region) -> Place | None:
    """A start well inside the centre region, beside the circle of allowed error."""
    circle = region.allowed_error
    if circle is None:
        return None
    left, _, _, top = region.centre.bounds
    beside = areal(region.centre.intersection(box(left, 0.0, circle.centre[0] - circle.radius, top)))
    if beside.is_empty:
        return circle.centre
    found = inscribed_circle(beside, 0.01 * circle.radius)
    return circle.centre if found is None else found.centre


def _extent(case: Case, scene: _Scene) -> Extent:
    hand, (x, y) = case.hand, scene.hand_at
    points = np.abs(finger_points(hand, case.open_joints))
    side, top = points.max(axis=0) + hand.half_thickness
    extent = Extent(x - side, y - hand.half_thickness, x + side, y + top)
    for area, _ in scene.sets:
        extent = extent if area.is_empty else extent.joined(Extent(*area.bounds))
    size = object_reach(case.object)
    at = scene.object_at or (0.0, size)
    if case.support.wall is not None:
        extent = extent.joined(Extent(extent.left, y, extent.right, y + (1.0 + WALL_ROOM) * case.support.wall))
    return extent.joined(Extent(at[0] - size, at[1] - size, at[0] + size, at[1] + size))


def _draw(axes: Axes, case: Case, scene: _Scene, theta: float) -> None:
    millimetre_ticks(axes)
    for area, band in scene.sets:
        draw_area(axes, area, band)
    if case.support.wall is not None:
        draw_wall(axes, scene.hand_at[1] + case.support.wall)
    size = object_reach(case.object)
    draw_object(axes, case.object, scene.object_at or (0.0, size), theta, fill=0.6)
    draw_hand(axes, case.hand, case.hand.open, distal=case.open_joints[1:], at=scene.hand_at)
    if scene.allowed is not None:
        circle = scene.allowed
        draw_object(axes, Disk(radius=circle.radius), circle.centre, role=ERROR.role, fill=0.0)
        radius_dimension(axes, circle.centre, circle.radius, ALONG, role=ERROR.role)
    if scene.hand_at == (0.0, 0.0):
        _hand_dimensions(axes, case)


def _row_on_the_wall(axes: Axes, case: Case, region: Region, scene: _Scene) -> None:
    """Where along the wall the origin of an object that rests on it may be, seen from the hand."""
    if scene.hand_at == (0.0, 0.0):
        for low, high in region.resting or ():
            height = resting_height(case)
            stroke(axes, MM * np.array([(low, height), (high, height)]), Role.CENTRE, level=ROW_LEVEL, width=HEAVY)


def _hand_dimensions(axes: Axes, case: Case) -> None:
    """Palm width and finger length (of a bent finger its links) as dimensions, or in words below a small hand."""
    hand = case.hand
    gap = 5.0 + MM * hand.half_thickness / per_paper_mm(axes)
    palm, finger = millimetres(hand.palm_width), millimetres(hand.finger_length)
    if not text_fits(axes, hand.palm_width, palm) and not text_fits(axes, hand.finger_length, finger):
        note(axes, (0.0, -gap * per_paper_mm(axes) / MM), f"palm {palm}, finger {finger}", role=Role.DIMENSION)
        return
    points = [(float(x), float(y)) for x, y in finger_points(hand, case.open_joints)]
    dimension(axes, (-hand.half_palm, 0.0), (hand.half_palm, 0.0), palm, -gap)
    if any(case.open_joints[1:]):
        for length, ends in zip(hand.finger_links, pairwise(points), strict=True):
            dimension(axes, *ends, millimetres(length), -gap)
    else:
        dimension(axes, points[0], points[-1], finger, -gap)


def millimetre_ticks(axes: Axes) -> None:
    """Ticks and names of axes in millimetres."""
    axes.set_axis_on()
    for axis, name in ((axes.xaxis, "x (mm)"), (axes.yaxis, "y (mm)")):
        axis.set_major_locator(MaxNLocator(nbins=7, steps=[1, 2, 5, 10]))
        axis.set_label_text(name, fontsize=SMALL_SIZE, color=Role.DIMENSION.line)
    axes.tick_params(
        labelsize=SMALL_SIZE, width=FINE, color=Role.DIMENSION.line, labelcolor=Role.DIMENSION.line, length=2.5
    )
    axes.ticklabel_format(style="plain", useOffset=False)
    for spine in axes.spines.values():
        spine.set(color=Role.DIMENSION.line, linewidth=FINE)


def _facts(page: Sheet, axes: Axes, case: Case, region: Region) -> None:
    """Closure, allowed error, area and guarantee, in the column beside the panel."""
    how = "Without friction"
    if region.closure is Closure.FRICTIONAL and case.contact.friction > 0.0:
        how = f"With friction {case.contact.friction:.3g}"
    circle = region.allowed_error
    facts: list[Fact] = [("", how, Role.CAPTION)]
    if circle is None:
        facts.append(("nothing is caught", f"{region.reason}", Role.LOST))
    else:
        facts.append(("allowed error", f"{millimetres(circle.radius)} in every direction", ERROR.role))
        facts.append(("area of the centre region", square_millimetres(region.area), Role.CENTRE))
        if region.certain is not None:
            facts.append(("of it certain", square_millimetres(region.certain.area), CERTAIN.role))
    facts += [(name, value, Role.CENTRE) for name, value in resting_rows(region)]
    facts.append((f"{region.model.value} model", region.guarantee.meaning, Role.CAPTION))
    write_facts(page, axes, facts)
