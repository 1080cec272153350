"""Where the arm can serve a task, seen from above: the places of the cylinder's axis about the arm's shoulder."""

from __future__ import annotations

from dataclasses import replace

from matplotlib.figure import Figure

from palmar.faces.plots.areas import LEGEND_ROW, Band, draw_area, legend
from palmar.faces.plots.facts import Fact, write_facts
from palmar.faces.plots.hand import draw_object
from palmar.faces.plots.lettering import millimetres, square_millimetres
from palmar.faces.plots.region_picture import CENTRE, ROOM, millimetre_ticks
from palmar.faces.plots.sheet import MARGIN, Extent, sheet
from palmar.faces.plots.style import Role
from palmar.models.objects import Disk
from palmar.studies.cell_workspace import Workspace

SERVED = Band(Role.GHOST, "places served", 4.0, filled=False, dashes=(0, (3, 1.5)))
WITH_ERROR = replace(CENTRE, words="served with this error of vision")
EDGE = 0.05
"""Room about the places (m)."""


def workspace_picture(found: Workspace, at: tuple[float, float], error: float) -> Figure:
    """The places served, those served with an error (m) of vision, and the nominal place (m) with that error about it."""
    left, low, right, high = found.places.bounds if not found.places.is_empty else (-1.0, -1.0, 1.0, 1.0)
    extent = Extent(left - EDGE, low - EDGE, right + EDGE, high + EDGE)
    room = replace(ROOM, sides=replace(ROOM.sides, bottom=LEGEND_ROW * 2 + 2.0))
    page = sheet([[extent]], title="Where the arm can serve", room=room)
    axes = page.panels[0][0]
    millimetre_ticks(axes)
    draw_area(axes, found.with_error(error), WITH_ERROR)
    draw_area(axes, found.places, SERVED)
    draw_object(axes, Disk(radius=max(error, 1e-3)), at, fill=0.0)
    facts: list[Fact] = [
        ("", "Places of the axis, seen from above; origin at the shoulder", Role.CAPTION),
        ("served", square_millimetres(found.places.area), Role.GHOST),
        ("error of vision", millimetres(error), Role.OBJECT),
        ("room at the nominal place", millimetres(found.room(at)), Role.CENTRE),
        (f"at places {1e3 * found.spacing:g} mm apart", found.guarantee.meaning, Role.CAPTION),
    ]
    write_facts(page, axes, facts)
    legend(page, (MARGIN, page.box(axes).bottom - ROOM.outside.bottom), [WITH_ERROR, SERVED])
    return page.figure
