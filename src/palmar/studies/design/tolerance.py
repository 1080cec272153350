"""How far from its nominal place an object may be so that a closing hand still catches it, whatever it is.

Disks on a table and straight fingers: the exact regions at the ends of the range of radii and between, at the least
friction, which decides; the largest circle in what they have in common. Else: places on a grid, each carried by the batch
kernels under every circumstance asked about, the largest circle of caught ones about the best place on the axis, its radius
then bisected along rays. With sensors: whether the planner proves a policy for the error asked about.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from palmar.behaviours.policy import is_guaranteed
from palmar.geometry.planar_set import areal, inscribed_circle
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.design_brief import DesignBrief
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.models.support import SupportKind
from palmar.regions.disk import disk_sides
from palmar.studies.design.circumstances import RADII, STRAIGHT, Circumstances, case_of
from palmar.studies.design.felt import place_ahead, plan_for

Floats = NDArray[np.float64]
Place = tuple[float, float]
FLATTENING = 3e-5
"""Of the boundaries of exact regions, in finger lengths."""
CELLS = 9
"""Steps of the grid across the error's radius."""
ROOM = 1.3
"""The grid reaches so many of the error asked about to each side; larger errors are not told apart."""

BETWEEN = 21
"""Centres looked at between the nodes of the grid on the axis."""


@dataclass(frozen=True)
class Tolerance:
    """Radius (m) of the circle of starts that are all caught, and its centre (m, hand frame); None where nothing is."""

    radius: float
    place: Place | None


def tolerance(brief: DesignBrief, hand: Hand, does: Behaviour = STRAIGHT, beaten: float = 0.0) -> Tolerance:
    """What the hand tolerates under all circumstances of the brief, if it closes as ``does`` says.

    Not worked out where it is no more than ``beaten`` (m): then some radius that is no more, either.
    """
    if brief.targets.sensors is not None:
        proved = is_guaranteed(plan_for(brief, hand).found.policy)
        return Tolerance(brief.error if proved else 0.0, place_ahead(brief, hand) if proved else None)
    if is_exact(brief, does):
        return _of_regions(brief, hand)
    return _of_starts(brief, Circumstances(brief, hand, does), beaten)


def is_exact(brief: DesignBrief, does: Behaviour = STRAIGHT) -> bool:
    """Whether regions are known in closed form: disks on a table, straight fingers."""
    on_table = brief.targets.radii is not None and brief.targets.support is SupportKind.TABLE
    return on_table and brief.targets.sensors is None and does.name is BehaviourName.CLOSE


def _of_regions(brief: DesignBrief, hand: Hand) -> Tolerance:
    low, high = brief.held
    common = None
    for radius in np.linspace(low, high, RADII if low < high else 1):
        case = case_of(brief, hand, Disk(radius=float(radius)), brief.least_friction.friction)
        inner = disk_sides(case, FLATTENING * hand.finger_length)[0]
        common = inner if common is None else areal(common & inner)
        if common.is_empty:
            return Tolerance(0.0, None)
    assert common is not None
    circle = inscribed_circle(common, 1e-4 * hand.finger_length)
    return Tolerance(circle.radius, circle.centre)


def _of_starts(brief: DesignBrief, asked: Circumstances, beaten: float) -> Tolerance:
    step, cells = brief.error / CELLS, ceil(ROOM * CELLS)
    x = step * np.arange(0 if asked.mirrored else -cells, cells + 1)
    y = asked.lowest + step * np.arange(2 * cells + 1)
    grid = np.stack(np.meshgrid(x, y), axis=-1)
    row, known = 0, np.inf
    for caught in asked.one_by_one(grid.reshape(-1, 2)):
        row, known = _deepest(caught.reshape(grid.shape[:2]), asked.mirrored)
        if known == 0.0 or (known + 0.5) * step <= beaten:  # so near a place is lost, and more will be
            return Tolerance((known + 0.5) * step if known else 0.0, None)
    return _about(asked, (0.0, float(y[row])), step, known * step)


def _about(asked: Circumstances, place: Place, step: float, known: float) -> Tolerance:
    """The largest circle about a place on the axis within half a ``step`` (m) of one; ``known`` (m): about how large."""
    boundary = asked.boundary(place, known + step)
    y = place[1] + step * np.linspace(-0.5, 0.5, BETWEEN)
    far = np.hypot(boundary[:, 0, None], boundary[:, 1, None] - y).min(axis=0)
    best = int(far.argmax())
    middle = (0.0, float(y[best]))
    return Tolerance(asked.circle(middle, float(far[best]) + 0.1 * step), middle)


def _deepest(caught: NDArray[np.bool_], mirrored: bool) -> tuple[int, float]:
    """The row whose node on the axis is the farthest from all nodes that are not caught, and how far, in steps."""
    whole = np.concatenate([caught[:, :0:-1], caught], axis=1) if mirrored else caught
    far = distance_transform_edt(np.pad(whole, 1))[1:-1, 1:-1]
    axis = far[:, far.shape[1] // 2]
    row = int(axis.argmax())
    return row, float(axis[row])
