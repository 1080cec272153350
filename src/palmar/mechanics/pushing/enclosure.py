"""From which base angle on a hand is too nearly closed for a disk to pass, whichever of its fingers stalls.

A finger that stalls stays where it is while the other goes on, so all pairs of base angles from then on count. For straight
fingers on a palm that does not move only equal ones do: there, in the pocket, no disk without friction stalls one finger
alone (docs/derivations/certified_region.md).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.closing_end import opening
from palmar.mechanics.pushing.compiled import compiled, compiled_to_allocate
from palmar.mechanics.pushing.hand_pose import LINK_WIDTH, MOST_LINKS, HandMotion, place_links

Floats = NDArray[np.float64]


class Closed(NamedTuple):
    """From which base angle (rad) on a disk in the pocket is caught, and one outside lost; ``last`` + 1: from none."""

    caught_from: float
    lost_from: float


FINEST, MOST_BOXES, MOST_WAITING = 1e-11, 50_000, 400
"""Boxes of pairs of angles are halved down to this width (rad), as long as there are not too many."""


@compiled
def _reach_rate(hand: HandMotion) -> float:
    """Bound (m/rad) on how fast any point of a finger moves in the frame of the palm."""
    total, turn = 0.0, 1.0
    for j in range(len(hand.links)):
        turn += hand.ratios[j]
        total += hand.links[j] * abs(turn)
    return total


@compiled
def _opening_at(hand: HandMotion, right: float, left: float, rows: Floats) -> float:
    place_links(hand, hand.first, right, left, rows)
    return opening(rows, len(hand.links))


@compiled_to_allocate
def _last_open(hand: HandMotion, radius: float, equal_only: bool) -> float:
    """The largest t such that a pair of angles, the lesser one t, may leave an opening of 2 ``radius``; else ``first``."""
    rows, waiting = np.zeros((2 * MOST_LINKS + 1, LINK_WIDTH)), np.zeros((MOST_WAITING, 3))
    rate, last_open, number, looked = _reach_rate(hand), hand.first, 1, 0
    waiting[0, 0], waiting[0, 1], waiting[0, 2] = hand.first, hand.first, hand.last - hand.first
    while number > 0:
        number, looked = number - 1, looked + 1
        a, b, width = waiting[number]
        lesser = min(a + width, b + width)
        if lesser <= last_open or (equal_only and a != b):
            continue
        half = 0.5 * width
        if _opening_at(hand, a + half, b + half, rows) + 2.0 * rate * half < 2.0 * radius:
            continue
        if width <= FINEST or number + 4 > MOST_WAITING or looked > MOST_BOXES:
            last_open = lesser
            continue
        for k in range(4):
            one, other = a + half * (k // 2), b + half * (k % 2)
            if one <= other:  # by mirror symmetry; the greatest lesser angles come first off the stack
                waiting[number, 0], waiting[number, 1], waiting[number, 2] = one, other, half
                number += 1
    return last_open


def closed_from(hand: HandMotion, radius: float) -> Closed:
    """When the pocket is closed for a disk of ``radius`` (m)."""
    straight = len(hand.links) == 1 and hand.vx == 0.0 and hand.vy == 0.0
    found, never = _last_open(hand, float(radius), straight), hand.last + 1.0
    shut = found if found < hand.last else never
    return Closed(shut, shut if straight else never)
