"""What touch buys, drawn as the source's figure 3.7: closing alone beside approaching by touch, placing and closing."""

from __future__ import annotations

from dataclasses import replace
from math import degrees

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from palmar.faces.plots.areas import LEGEND_ROW, Band, draw_area, legend
from palmar.faces.plots.facts import write_facts
from palmar.faces.plots.hand import draw_hand, draw_object, finger_points
from palmar.faces.plots.region_picture import ROOM, millimetre_ticks
from palmar.faces.plots.sheet import MARGIN, MM, Extent, Sheet, sheet
from palmar.faces.plots.style import HEAVY, Role
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.sensors import Stretch
from palmar.regions.profile import body_lines
from palmar.studies.touch import Touch

SENSORY = Band(Role.HELD, "an approach by touch, placing the hand and closing certainly catch it", 0.5)
CLOSING = Band(Role.CENTRE, "closing alone catches it, the hand where it is drawn", 1.0, dashes=(0, (4, 1.5)))
APART = 0.03
"""Gap at either end of a sensor, as a share of its length, so that neighbours are told apart."""


def touch_picture(case: Case, here: Touch) -> Figure:
    """Both pre-images of the object's centre in the frame of the open hand, and the sensors on it."""
    assert isinstance(case.object, Disk)
    bands = [CLOSING] if here.sensory.is_empty else [SENSORY, CLOSING]
    reach = np.abs(finger_points(case.hand, (here.opening,))).max(axis=0) + case.hand.half_thickness
    extent = Extent(-reach[0], -case.hand.half_thickness, reach[0], reach[1])
    for area in (here.sensory, here.closing):
        extent = extent if area.is_empty else extent.joined(Extent(*area.bounds))
    room = replace(ROOM, sides=replace(ROOM.sides, bottom=LEGEND_ROW * len(bands) + 2.0))
    title = "What touch buys"
    footer = f"Approach of {1e3 * here.travel:.4g} mm. Thick stretches of the hand are sensors."
    page = sheet([[extent]], title=title, footer=footer, room=room)
    axes = page.panels[0][0]
    millimetre_ticks(axes)
    draw_area(axes, here.sensory, SENSORY)
    draw_area(axes, here.closing, CLOSING)
    draw_object(axes, case.object, (0.0, here.travel + case.object.radius), fill=0.5)
    draw_hand(axes, case.hand, here.opening)
    for each in case.sensors.stretches(case.hand):
        _draw_sensor(axes, case, each, here.opening)
    _facts(page, axes, here)
    legend(page, (MARGIN, page.box(axes).bottom - ROOM.outside.bottom), bands, columns=1)
    return page.figure


def _draw_sensor(axes: Axes, case: Case, stretch: Stretch, opening: float) -> None:
    place, along = body_lines(case.hand, opening)[stretch.body]
    length = float(np.hypot(*along))
    begin, end = stretch.begin / length, min((stretch.end or length) / length, 1.0)
    gap = APART * (end - begin)
    ends = MM * (place + along * np.array([[begin + gap], [end - gap]]))
    axes.plot(*ends.T, color=Role.HELD.line, linewidth=2.0 * HEAVY, solid_capstyle="butt", zorder=30)


def _facts(page: Sheet, axes: Axes, here: Touch) -> None:
    facts = [
        ("", f"Fingers open to {degrees(here.opening):.3g} deg", Role.CAPTION),
        ("by touch", f"{1e4 * here.sensory.area:.4g} cm²", SENSORY.role),
        ("by closing alone", f"{1e4 * here.closing.area:.4g} cm²", CLOSING.role),
        ("felt, of the width touched", f"{1e3 * here.felt:.4g} of {1e3 * here.touched:.4g} mm", Role.CAPTION),
        ("certain, of it in one run", f"{1e3 * here.good:.4g}, {1e3 * here.connected:.4g} mm", Role.CAPTION),
    ]
    write_facts(page, axes, facts)
