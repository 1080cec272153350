"""From which base angle on a hand is too nearly closed for a disk to pass, whichever of its fingers stalls.

A finger that stalls stays where it is while the other goes on, so all pairs of base angles from then on count. Only equal
ones do if no disk without friction can stall one finger alone (docs/derivations/certified_region.md).
"""

from __future__ import annotations

from math import inf, pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, compiled_to_allocate
from palmar.mechanics.pushing.closing_end import opening
from palmar.mechanics.pushing.hand_pose import LINK_WIDTH, MOST_LINKS, HandMotion, place_links

Floats = NDArray[np.float64]
FINEST, MOST_BOXES, MOST_WAITING = 1e-11, 50_000, 400
"""Boxes of pairs of angles are halved down to this width (rad), as long as there are not too many."""
SAMPLES = 400


class Closed(NamedTuple):
    """From which base angle (rad) on a disk in the pocket is caught, and one outside lost; ``last`` + 1: from none."""

    caught_from: float
    lost_from: float


def closed_from(hand: HandMotion, radius: float) -> Closed:
    """When the pocket is closed for a disk of ``radius`` (m)."""
    never = hand.last + 1.0
    found = _last_open(hand, float(radius), inf)
    if found < hand.last:
        found = max(found, _last_open(hand, float(radius), stall_together_until(hand, found)))
    shut = found if found < hand.last else never
    return Closed(shut, shut if len(hand.links) == 1 else never)


def stall_together_until(hand: HandMotion, since: float) -> float:
    """Base angle (rad) up to which, from ``since`` on, a disk without friction in the pocket stalls both fingers or none.

    As long as all links are at angles between 0 and 180 degrees, so that the right finger only pushes to the left and the
    left one to the right, every place on their inner sides moves inwards, and so do the tips.
    """
    psi = np.linspace(since, hand.last, SAMPLES)
    turns = 1.0 + np.cumsum(hand.ratios[0])
    joints = hand.offsets[0] + hand.ratios[0] * (psi[:, None] - hand.first)
    angles = psi[:, None] + np.cumsum(joints, axis=1)
    rates, half = turns * hand.links, 0.5 * (hand.last - since) / (SAMPLES - 1)
    fine = (angles.min(axis=1) >= 0.0) & (angles.max(axis=1) <= pi)
    fine &= np.sin(angles) @ rates > half * float(np.abs(rates) @ np.abs(turns))
    for j in range(1, len(hand.links)):
        least = np.cos(angles[:, j : j + 1] - angles[:, :j]) @ rates[:j]
        least -= half * float(np.abs(rates[:j]) @ np.abs(turns[j] - turns[:j]))
        fine &= (least > 0.0) & (least + rates[j] > 0.0)
    return float(hand.last) if fine[:-1].all() else float(psi[max(int(np.argmin(fine)) - 1, 0)])


@compiled
def _reach_rate(hand: HandMotion) -> float:
    """Bound (m/rad) on how fast any point of a finger moves in the frame of the palm."""
    total, turn = 0.0, 1.0
    for j in range(len(hand.links)):
        turn += hand.ratios[0, j]
        total += hand.links[j] * abs(turn)
    return total


@compiled
def _opening_at(hand: HandMotion, right: float, left: float, rows: Floats) -> float:
    place_links(hand, hand.first, right, left, rows)
    return opening(rows, len(hand.links))


@compiled_to_allocate
def _last_open(hand: HandMotion, radius: float, alone_from: float) -> float:
    """The largest t such that a pair of angles, the lesser one t, may leave an opening of 2 ``radius``; else ``first``.

    Of pairs of which the lesser angle is below ``alone_from`` only equal ones count.
    """
    rows, waiting = np.zeros((2 * MOST_LINKS + 1, LINK_WIDTH)), np.zeros((MOST_WAITING, 3))
    rate, last_open, number, looked = _reach_rate(hand), hand.first, 1, 0
    waiting[0, 0], waiting[0, 1], waiting[0, 2] = hand.first, hand.first, hand.last - hand.first
    while number > 0:
        number, looked = number - 1, looked + 1
        a, b, width = waiting[number]
        lesser = min(a + width, b + width)
        if lesser <= last_open or (lesser <= alone_from and a != b):
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
