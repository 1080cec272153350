"""A hand that goes straight towards disks that stay where they are, until it touches them: batch.

Sphere tracing: from a centre the hand may go on by its clearance without touching, so each step goes exactly that far. No
profile, no set: distances from the links' lines only.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, inf

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.hand_pose import HandMotion, place_links
from palmar.models.hand import Hand
from palmar.models.sensors import Stretch

Floats = NDArray[np.float64]
NOTHING, UNFELT = -1, -2
"""Instead of a sensor: nothing was touched; a part without a sensor was."""
CLOSE, MOST_STEPS = 1e-10, 50_000_000
"""Clearance (m) that is a touch; steps, of which a disk that passes a tip by 1e-9 m takes many."""


@dataclass(frozen=True)
class Touches:
    """For each start (N,): sensor, NOTHING or UNFELT; way (m) of the hand until then."""

    sensors: NDArray[np.int64]
    ways: Floats


def go_until_touched(
    hand: Hand, stretches: tuple[Stretch, ...], opening: float, radius: float, centres: Floats, distance: float
) -> Touches:
    """The hand, open to ``opening`` (rad), goes ``distance`` (m) along y before disks at ``centres`` (N, 2), hand frame."""
    rows, names = _bodies(hand, opening, radius)
    bodies, feet, ways = np.zeros(len(centres), np.int64), np.zeros(len(centres)), np.zeros(len(centres))
    _trace(rows, np.ascontiguousarray(centres), distance, bodies, feet, ways)
    sensors = np.where(bodies < 0, NOTHING, UNFELT)
    for k, each in enumerate(stretches):
        body = names.index(each.body)
        end = inf if each.end is None else each.end
        slack = 1e-12 + (0.0 if end < inf else 1.0)
        here = (bodies == body) & (feet >= each.begin) & (feet <= end + slack) & (sensors == UNFELT)
        sensors[here] = k
    return Touches(sensors, ways)


def _bodies(hand: Hand, opening: float, radius: float) -> tuple[Floats, list[str]]:
    """Rows (ax, ay, bx, by, distance at which a centre touches) of palm, right and left links, and their names."""
    straight = np.zeros((2, len(hand.finger_links)))
    motion = HandMotion(
        hand.half_palm, np.array(hand.finger_links), hand.half_thickness, opening, opening, straight, straight, 0.0, 0.0
    )
    count = len(hand.finger_links)
    rows = np.zeros((2 * count + 1, 8))
    place_links(motion, opening, opening, opening, rows)
    names = ["palm", *(f"{side}_{k + 1}" for side in ("right", "left") for k in range(count))]
    return np.column_stack([rows[:, :4], radius + rows[:, 7]]), names


@compiled
def _trace(
    rows: Floats, centres: Floats, distance: float, bodies: NDArray[np.int64], feet: Floats, ways: Floats
) -> None:
    """Write the body touched (-1: none), how far from its begin (m), and the way of the hand, for each centre."""
    for k in range(len(centres)):
        x, y, way = centres[k, 0], centres[k, 1], 0.0
        bodies[k], feet[k] = -1, 0.0
        for _ in range(MOST_STEPS):
            clearance, body, foot = inf, -1, 0.0
            for j in range(len(rows)):
                ax, ay, dx, dy = rows[j, 0], rows[j, 1], rows[j, 2] - rows[j, 0], rows[j, 3] - rows[j, 1]
                length = hypot(dx, dy)
                along = min(max(((x - ax) * dx + (y - way - ay) * dy) / length, 0.0), length)
                gap = hypot(x - ax - along * dx / length, y - way - ay - along * dy / length) - rows[j, 4]
                if gap < clearance:
                    clearance, body, foot = gap, j, along
            if clearance < CLOSE:
                bodies[k], feet[k] = body, foot
                break
            way += clearance
            if way >= distance:
                way = distance
                break
        ways[k] = way
