"""From where three closing tips catch a cylinder, seen from above."""

from __future__ import annotations

from dataclasses import replace

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from shapely import MultiPolygon, Point

from palmar.faces.plots.areas import LEGEND_ROW, Band, draw_area, legend
from palmar.faces.plots.dimensions import radius_dimension
from palmar.faces.plots.facts import Fact, write_facts
from palmar.faces.plots.hand import draw_object
from palmar.faces.plots.lettering import millimetres, square_millimetres
from palmar.faces.plots.region_picture import CENTRE, ERROR, ROOM, millimetre_ticks
from palmar.faces.plots.sheet import MARGIN, Extent, Sheet, sheet
from palmar.faces.plots.style import Role
from palmar.mechanics.pushing.three_tips import AXES, CAGE
from palmar.models.objects import Disk
from palmar.regions.region import Region
from palmar.studies.three_tips import Task

OPEN = Band(Role.HAND, "the tips, open", 5.0)
CAGING = Band(Role.GHOST, "the tips as they cage the cylinder", 4.0, dashes=(0, (3, 1.5)))
STEEP = -0.9
"""Direction (rad) of the allowed error's dimension line."""


def tips_picture(task: Task, region: Region) -> Figure:
    """The region with the tips open and where they cage the cylinder, the allowed error, and the cylinder in the middle."""
    bands = [CENTRE, ERROR, OPEN, CAGING]
    sides = replace(ROOM.sides, bottom=LEGEND_ROW * 2 + 2.0)
    room = replace(ROOM, sides=sides)
    reach = task.tips.open_radius + 1.5 * task.tips.tip_radius
    extent = Extent(-reach, -0.75 * reach, reach, reach)
    page = sheet([[extent]], title="From where three closing tips catch the cylinder", room=room)
    axes = page.panels[0][0]
    millimetre_ticks(axes)
    draw_area(axes, region.centre, CENTRE)
    draw_area(axes, _discs(task, min(CAGE * (task.radius + task.tips.tip_radius), task.tips.open_radius)), CAGING)
    draw_area(axes, _discs(task, task.tips.open_radius), OPEN)
    draw_object(axes, Disk(radius=task.radius), (0.0, 0.0), fill=0.0)
    _error(axes, region)
    _facts(page, axes, task, region)
    legend(page, (MARGIN, page.box(axes).bottom - ROOM.outside.bottom), bands)
    return page.figure


def _discs(task: Task, circle: float) -> MultiPolygon:
    return MultiPolygon([Point(*(circle * axis)).buffer(task.tips.tip_radius, quad_segs=24) for axis in AXES])


def _error(axes: Axes, region: Region) -> None:
    circle = region.allowed_error
    if circle is not None:
        draw_object(axes, Disk(radius=circle.radius), circle.centre, role=ERROR.role, fill=0.0)
        radius_dimension(axes, circle.centre, circle.radius, STEEP, role=ERROR.role)


def _facts(page: Sheet, axes: Axes, task: Task, region: Region) -> None:
    how = f"With friction {task.friction:.3g}" if task.friction > 0.0 else "Without friction"
    facts: list[Fact] = [("", how, Role.CAPTION), ("radius of the cylinder", millimetres(task.radius), Role.OBJECT)]
    circle = region.allowed_error
    if circle is None:
        facts.append(("nothing is caught", f"{region.reason}", Role.LOST))
    else:
        facts.append(("allowed error", f"{millimetres(circle.radius)} in every direction", ERROR.role))
        facts.append(("area of the centre region", square_millimetres(region.area), Role.CENTRE))
    facts.append(("exact model", region.guarantee.meaning, Role.CAPTION))
    write_facts(page, axes, facts)
