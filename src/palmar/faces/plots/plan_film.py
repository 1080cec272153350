"""A plan carried out on one object, as a film: the hand feels its way, and what is known of the object shrinks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from palmar.faces.plots.areas import draw_area
from palmar.faces.plots.gif import Picture, rendered, write_gif
from palmar.faces.plots.hand import draw_finger, draw_object, draw_palm, finger_points
from palmar.faces.plots.plan_picture import BELIEF, LEAST
from palmar.faces.plots.region_picture import millimetre_ticks
from palmar.faces.plots.sheet import MARGIN, Extent, Pad, Room, sheet
from palmar.faces.plots.style import HEADING_SIZE, Role
from palmar.geometry.planar_set import areal
from palmar.geometry.polygon import turned
from palmar.models.case import Case
from palmar.studies.plan import Plan
from palmar.studies.plan_walk import Moment, longest_way, walk

ROOM = Room(Pad(3.0, 6.0, 3.0, 5.0), Pad(12.0, 11.0, 2.0, 3.0), Pad(0.0, 0.0, 0.0, 0.0))
DELAY, LAST = 60, 2500
"""Milliseconds of a picture, and of the last."""


def write_plan_film(path: Path, case: Case, plan: Plan) -> None:
    """Write a GIF of an object that takes the most approaches, whole or not at all."""
    moments = list(walk(case, plan, longest_way(case, plan)))
    extent = _extent(case, moments)
    write_gif(path, [_picture(case, each, extent) for each in moments], DELAY, LAST)


def _extent(case: Case, moments: list[Moment]) -> Extent:
    """All that the hand and the belief ever cover."""
    found = Extent(*moments[0].belief.bounds)
    for each in moments:
        points = np.concatenate(_fingers(case, each))
        (x, y), (x_most, y_most) = points.min(axis=0), points.max(axis=0)
        found = found.joined(Extent(float(x), float(y), float(x_most), float(y_most)))
    return found


def _picture(case: Case, moment: Moment, extent: Extent) -> Picture:
    page = sheet([[extent]], title="Where the object's centre may be (orange)", room=ROOM)
    axes = page.panels[0][0]
    millimetre_ticks(axes)
    draw_area(axes, areal(moment.belief.buffer(LEAST * max(extent.size))), BELIEF)
    draw_object(axes, case.object, moment.thing, fill=0.6)
    _draw_hand(axes, case, moment)
    page.write((MARGIN, MARGIN), moment.doing, size=HEADING_SIZE, bold=True, role=Role.CAPTION)
    return rendered(page.figure)


def _fingers(case: Case, moment: Moment) -> list[NDArray[np.float64]]:
    """Joints and tips (links + 1, 2) of the right and of the left finger, m, in the frame of the start."""
    x, y, theta = moment.hand
    return [
        turned(finger_points(case.hand, (psi,), left=left), theta) + np.array([x, y])
        for psi, left in zip(moment.fingers, (False, True), strict=True)
    ]


def _draw_hand(axes: Axes, case: Case, moment: Moment) -> None:
    x, y, facing = moment.hand
    draw_palm(axes, case.hand, at=(x, y), facing=facing)
    for psi, left in zip(moment.fingers, (False, True), strict=True):
        draw_finger(axes, case.hand, (psi,), left=left, at=(x, y), facing=facing)
