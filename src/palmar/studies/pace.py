"""How fast, and how sharply, a closing hand moves a disk's centre: per radian of finger, whatever the rate.

Starts over the region and on its outline are followed at equal steps of the closing angle, and their places differenced
twice within each phase. The jumps of velocity between phases (first touch, arrival on the axis or palm) are
impacts, not accelerations; the speed measures them. On a link of a line finger the closed forms are |c'| = r and
|c''| = sqrt(r^2 + R^2), with r the contact's distance from the joint.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon

from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.closing_case import closing_hand
from palmar.mechanics.pushing.closing_tables import build_tables
from palmar.mechanics.pushing.resting import slider_of
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.studies.final_poses import grid
from palmar.worlds.planar.table import TableWorld, covered

Floats = NDArray[np.float64]
STARTS, RIM, STEPS = 100, 100, 720
"""Starts on a grid and on the outline, whose disks go farthest and turn sharpest on the tips; steps of the angle."""
REACHED, STANDING = 1e-7, 1e-6
"""Shares of the finger's length: a disk this near is on the axis or palm; a speed below this (per rad) is rounding."""
REST, PUSHED, SQUEEZED, SLID = range(4)
"""Phases: at rest, pushed by one finger, squeezed along the axis by both, slid along the palm by one."""


@dataclass(frozen=True)
class Pace:
    """Speed |c'| (m per rad) and acceleration |c''| (m per rad^2) of caught disks; 0 where that never happens.

    Pushed by one finger: the greatest. Squeezed by two parts of the hand: the speed that 95% of the starts of a grid do not
    exceed, for there is no greatest; a disk gripped just above its equator moves the faster, the nearer to it.
    """

    push_speed: float
    push_acceleration: float
    squeeze_speed: float


def pace(case: Case, region: MultiPolygon) -> Pace:
    """Follow starts in and around the region; raises NotCoveredError where the event-to-event kernel does not apply."""
    if not covered(case) or not isinstance(case.object, Disk):
        raise NotCoveredError("the pace is found for disks pressed about their centre")
    hand = closing_hand(case.hand, case.object.radius, case.contact.friction)
    surface = slider_of(case.object, case.support).surface
    world = TableWorld(hand, surface, build_tables(hand, surface, spin=False))
    within = grid(region, STARTS)[0]
    outline = shapely.get_coordinates(region.boundary)
    starts = np.concatenate([within, outline[:: max(1, len(outline) // RIM)]])
    caught = world.ends(starts).codes <= Outcome.CAGED.code
    places, phases, step = _followed(world, starts)
    speed, acceleration, pushed, squeezed = _rates(places, phases, step)
    of_grid = np.arange(len(starts)) < len(within)
    return Pace(
        _most(speed, pushed & caught),
        _most(acceleration, pushed & caught),
        _usual(speed, squeezed & caught, of_grid),
    )


def _rates(
    places: Floats, phases: NDArray[np.int8], step: float
) -> tuple[Floats, Floats, NDArray[np.bool_], NDArray[np.bool_]]:
    """|c'| and |c''| (K - 4, N) at all angles but two on either side, and where the disk is pushed and squeezed there.

    A jump of velocity within a phase shows in at most two neighbouring second differences; the least of three leaves it out.
    """
    middle = phases[2:-2]
    same = np.ones(middle.shape, bool)
    for k in (0, 1, 3, 4):
        same &= phases[k : k + len(middle)] == middle
    speed = np.linalg.norm(places[3:-1] - places[1:-3], axis=2) / (2.0 * step)
    bends = np.linalg.norm(places[2:] - 2.0 * places[1:-1] + places[:-2], axis=2) / step**2
    acceleration = np.minimum(np.minimum(bends[:-2], bends[1:-1]), bends[2:])
    return speed, acceleration, same & (middle == PUSHED), same & (middle >= SQUEEZED)


def _followed(world: TableWorld, starts: Floats) -> tuple[Floats, NDArray[np.int8], float]:
    """Places (K, N, 2) of N disks at K closing angles, their phases (K, N), and the step of the angle (rad)."""
    hand = world.hand
    angles = np.linspace(hand.first, hand.last, STEPS + 1)
    ends = [world.ends(starts, last=float(angle)) for angle in angles]
    places = np.stack([each.poses[:, :2] for each in ends])
    near = REACHED * hand.length
    on_axis, on_palm = np.abs(places[..., 0]) < near, places[..., 1] < hand.radius + near
    phases = np.full(on_axis.shape, PUSHED, np.int8)
    phases[on_axis], phases[on_palm] = SQUEEZED, SLID
    step = float(angles[1] - angles[0])
    moving = np.linalg.norm(np.diff(places, axis=0), axis=2) > STANDING * hand.length * step
    phases[:-1][~moving] = REST
    phases[1:][~moving] = REST
    return places, phases, step


def _most(values: Floats, where: NDArray[np.bool_]) -> float:
    return float(values[where].max()) if where.any() else 0.0


def _usual(values: Floats, where: NDArray[np.bool_], of_grid: NDArray[np.bool_]) -> float:
    """What the greatest value of a start does not exceed for 95% of the starts of the grid."""
    return float(np.quantile(np.where(where, values, 0.0).max(axis=0)[of_grid], 0.95))
