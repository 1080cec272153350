"""What the fingers' final angles say: caught or missed, how surely, and of which radius the disk is.

A hand that has caught nothing closes to its last angle with both fingers. A disk of radius R held between palm and both
fingers stops them both at the psi at which they touch it there, which ``touched_radius`` inverts in closed form:
R = (D sin psi - h) / (1 - cos psi) on the side of the fingers, and a like formula at their tips.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from palmar.mechanics.closure.disk_2_2 import structural_radii, touched_radius
from palmar.mechanics.closure.holding_pose import touching_pose
from palmar.mechanics.pushing.closing_case import closing_hand
from palmar.models.case import Case
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import Disk
from palmar.studies.closure import grip_of
from palmar.studies.final_poses import FinalPoses, KindOfEnd

STEP = 1e-5
ROWS = 9


@dataclass(frozen=True)
class Apart:
    """Two ways to end and how far apart (rad) their base angles are, in the finger in which they differ most."""

    one: str
    other: str
    angle: float


@dataclass(frozen=True)
class FinalAngles:
    """Base angles (rad) as a sensor: where a miss ends, how far from it every catch stops short, and the radius read.

    ``caught_from_missed`` is the least distance (rad) of a catch from a miss, 0 where fingers reach their last angle
    around a caged object; readings must be better than half of it. ``centred`` is the angle of the hold on the palm
    (None without one), ``radius_per_angle`` (m/rad) how the radius read there changes, ``radii`` rows of (angle, radius).
    """

    missed: float
    caught_from_missed: float
    apart: tuple[Apart, ...]
    centred: float | None
    radius_per_angle: float | None
    radii: tuple[tuple[float, float], ...]


def final_angles(case: Case, ends: FinalPoses) -> FinalAngles:
    """What the final angles say for the case's disk, from the ways in which its starts end."""
    assert isinstance(case.object, Disk)
    last = closing_hand(case.hand, case.object.radius, case.contact.friction).last
    held = [each for each in ends.kinds if each.caught]
    short = min(last - each.smaller[1] for each in held)
    pose = touching_pose(grip_of(case.hand, None), case.object.radius, case.object.radius)
    psi = pose.psi if pose is not None and pose.psi <= last else None
    return FinalAngles(
        last,
        max(short, 0.0),
        tuple(Apart(one.name, other.name, _distance(one, other)) for one, other in combinations(held, 2)),
        psi,
        None if psi is None else _slope(case.hand, psi),
        _radii(case.hand),
    )


def radius_read(hand: Hand, psi: float) -> float:
    """The radius (m) of the disk that palm and both fingers hold at base angle psi (rad)."""
    return float(touched_radius(hand.half_palm, hand.finger_length, hand.half_thickness, psi))


def _distance(one: KindOfEnd, other: KindOfEnd) -> float:
    """Distance of two boxes of (smaller, larger) angles, the greater of both gaps; 0 where they overlap."""
    gaps = [
        max(mine[0] - theirs[1], theirs[0] - mine[1], 0.0)
        for mine, theirs in ((one.smaller, other.smaller), (one.larger, other.larger))
    ]
    return max(gaps)


def _slope(hand: Hand, psi: float) -> float:
    return (radius_read(hand, psi + STEP) - radius_read(hand, psi - STEP)) / (2.0 * STEP)


def _radii(hand: Hand) -> tuple[tuple[float, float], ...]:
    """Rows of (angle, radius) from the largest disk held without friction to the smallest."""
    crossing = hand.fingers is Fingers.CROSSING
    size = (hand.half_palm, hand.finger_length, hand.half_thickness)
    held = structural_radii(*size, crossing=crossing, psi_limits=hand.base_limits)
    if np.isnan(held.max):
        return ()
    grip = grip_of(hand, None)
    rows = []
    for radius in np.linspace(float(held.max), float(held.min), ROWS + 1)[: -1 if held.min == 0.0 else None]:
        pose = touching_pose(grip, float(radius), float(radius))
        if pose is not None:
            rows.append((pose.psi, float(radius)))
    return tuple(rows)
