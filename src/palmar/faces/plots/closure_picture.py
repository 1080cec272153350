"""What a hand holds, drawn: the smallest disk, the case's object and the largest disk, without and with friction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import cos, pi, radians, sin

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from palmar.faces.plots.circle_test import STRIP, CircleTest, draw_circle_tests
from palmar.faces.plots.closure_views import View, disk_view, limit_views, polygon_view, view_extent
from palmar.faces.plots.dimensions import dimension, friction_cone, label, note, radius_dimension
from palmar.faces.plots.hand import draw_hand, draw_object, finger_points
from palmar.faces.plots.lettering import angle, line_height, millimetres
from palmar.faces.plots.sheet import MARGIN, MM, Extent, Pad, Room, Sheet, per_paper_mm, sheet
from palmar.faces.plots.style import HEADING_SIZE, TEXT_SIZE, Role
from palmar.mechanics.closure.sizing import Grip
from palmar.models.case import Case
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.studies.closure import ClosureAnswer, RadiusRange, grip_of

ROOM = Room(inside=Pad(4.0, 20.0, 4.0, 16.0), sides=Pad(right=12.0), highest=250.0, narrowest=48.0)
WORDS = 9.5
"""Height (mm) of a panel's first line of words above its lower edge."""
CONE, SMALLEST_CONE = 11.0, 4.0
"""Length (mm) of friction cones, and below which they are left out."""


@dataclass(frozen=True)
class _Row:
    """One closure: its heading, the closed hand, the radii it holds and the verdict on the case's object."""

    heading: str
    grip: Grip
    radii: RadiusRange | None
    held: bool


def closure_picture(case: Case, answer: ClosureAnswer) -> Figure:
    """Rows: without friction, and with it if the case has any; columns: smallest disk, the case's object, largest disk.

    All panels are to one scale. Fingers stand at the angle at which they hold the disk; where the case's disk is not
    held it lies on the palm, where they touch it or can come no nearer. A polygon is drawn at the case's start
    orientation, and once more, larger, with the circles of the any-orientation test.
    """
    rows = _rows(case, answer)
    views = [_views(case, row) for row in rows]
    extents = [[view_extent(case.hand, view) for view in each] for each in views]
    notes = "".join(f" {each[0].upper()}{each[1:]}." for each in answer.notes)
    drawn = " Hand and object are drawn at the middle of the given ranges." if case.ranges else ""
    footer = f"Your object: {answer.object.reason}. Finger angles count from fully open, 0°.{drawn}{notes}"
    polygon = case.object if isinstance(case.object, ConvexPolygon) else None
    room = ROOM if polygon is None else replace(ROOM, sides=replace(ROOM.sides, bottom=STRIP))
    page = sheet(extents, title="What this hand holds, to scale", footer=footer, room=room)
    names = ("smallest", "your disk" if polygon is None else "your polygon", "largest")
    for row, seen, shown, panels in zip(rows, views, extents, page.panels, strict=True):
        _headings(page, panels, row.heading, names)
        for view, extent, axes in zip(seen, shown, panels, strict=True):
            _draw(axes, case.hand, view, extent, row.grip.friction_angle or 0.0)
    _hand_dimensions(case.hand, views, page)
    if polygon is not None:
        known = answer.polygon
        held = (None, None) if known is None else (known.structural.intervals, known.frictional.intervals)
        tests = [CircleTest(row.heading, row.radii, row.held, at) for row, at in zip(rows, held, strict=False)]
        draw_circle_tests(page, page.box(page.panels[-1][0]).bottom, polygon, tests)
    return page.figure


def _rows(case: Case, answer: ClosureAnswer) -> list[_Row]:
    contact, verdict = case.contact, answer.object
    rows = [_Row("Without friction", grip_of(case.hand, None), answer.structural, verdict.structural)]
    if contact.friction_angle > 0.0:
        heading = f"With friction {_friction(case)}, force cone ±{angle(contact.friction_angle)}"
        grip = grip_of(case.hand, contact.friction_angle)
        rows.append(_Row(heading, grip, answer.frictional, verdict.frictional))
    return rows


def _friction(case: Case) -> str:
    known = [each for each in case.ranges if each.place == ("contact", "friction")]
    drawn = f"{case.contact.friction:.3g}"
    return f"{known[0].low:.3g} to {known[0].high:.3g}, drawn at {drawn}" if known else drawn


def _views(case: Case, row: _Row) -> tuple[View, View, View]:
    smallest, largest = limit_views(row.grip, row.radii)
    if isinstance(case.object, Disk):
        return smallest, disk_view(row.grip, case.object, row.held), largest
    return smallest, polygon_view(row.grip, case.object, case.start.theta), largest


def _draw(axes: Axes, hand: Hand, view: View, extent: Extent, cone: float) -> None:
    """Object, fingers, cones and words of one panel."""
    draw_hand(axes, hand, view.psi, ghost=view.item is None)
    if view.item is not None:
        within = _with_edge(axes, extent)
        draw_object(axes, view.item, view.at, view.theta, role=view.role, within=within)
        if view.radius is not None:
            _draw_radius(axes, view, view.radius, within)
            _draw_cones(axes, view, view.radius, cone)
    role = view.role if view.verdict is None else (Role.HELD if view.verdict else Role.LOST)
    unit = per_paper_mm(axes) / MM
    middle, bottom = 0.5 * (extent.left + extent.right), axes.get_ylim()[0] / MM
    for i, line in enumerate(view.words):
        y = bottom + (WORDS - (i + 1) * line_height(TEXT_SIZE)) * unit
        note(axes, (middle, y), line, role=Role.CAPTION if i else role, upright="baseline", bold=not i)


def _draw_radius(axes: Axes, view: View, radius: float, within: Extent) -> None:
    """The radius as a dimension where it fits, and as a label for a disk too small to be seen on paper."""
    if within.contains(view.at):
        radius_dimension(axes, view.at, radius, radians(125.0), role=view.role)
    if view.exact and MM * radius < per_paper_mm(axes):
        below = view.at[1] == radius and view.role is not Role.LARGEST  # the palm's dimension stands there
        label(axes, view.at, millimetres(radius), (0.0, -4.0) if below else (-7.0, 4.0), role=view.role)


def _with_edge(axes: Axes, extent: Extent) -> Extent:
    """The extent, with room for the outline's own width."""
    edge = 0.5 * per_paper_mm(axes) / MM
    return Extent(extent.left - edge, extent.bottom - edge, extent.right + edge, extent.top + edge)


def _draw_cones(axes: Axes, view: View, radius: float, half_angle: float) -> None:
    """Friction cones at both contacts of a disk that is held, where there is room."""
    length = min(CONE, 0.75 * MM * radius / per_paper_mm(axes))
    if view.pose is None or not half_angle or length < SMALLEST_CONE:
        return
    e = view.pose.elevation
    x, y = radius * cos(e), view.pose.height + radius * sin(e)
    friction_cone(axes, (x, y), pi + e, half_angle, length=length)
    friction_cone(axes, (-x, y), -e, half_angle, length=length)


def _headings(page: Sheet, panels: Sequence[Axes], heading: str, names: Sequence[str]) -> None:
    top = page.box(panels[0]).top
    page.rule(top)
    page.write((MARGIN, top - 2.0), heading, size=HEADING_SIZE, bold=True, upright="top")
    for axes, name in zip(panels, names, strict=True):
        box = page.box(axes)
        page.write((0.5 * (box.left + box.right), top - 8.0), name, across="center", upright="top")


def _hand_dimensions(hand: Hand, views: Sequence[Sequence[View]], page: Sheet) -> None:
    """Palm width and finger length, once, where a largest disk is held."""
    for row, panels in zip(views, page.panels, strict=True):
        view, axes = row[-1], panels[-1]
        if view.pose is not None:
            base, *_, tip = finger_points(hand, (view.psi,))
            gap = 5.0 + MM * hand.half_thickness / per_paper_mm(axes)
            ends = (-hand.half_palm, 0.0), (hand.half_palm, 0.0)
            dimension(axes, *ends, millimetres(hand.palm_width), -gap)
            ends = (float(base[0]), float(base[1])), (float(tip[0]), float(tip[1]))
            dimension(axes, *ends, millimetres(hand.finger_length), -gap)
            return
