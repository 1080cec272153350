"""Whether the disk's centre can leave: loops that the hand's chain of segments closes for good.

The palm and the links are one chain from tip to tip; a disk's centre is kept off the chain's elements, each grown by R +
its half thickness, all convex. Where two elements that are not neighbours come so near that the grown ones overlap, the
chain between their closest points and the segment joining these is a loop that a centre cannot cross: each point of that
segment lies in one of the two. Conversely a bounded part of the free plane is wound about by one of these loops, for with
those of neighbours, which bound nothing, they generate all cycles of the cover's nerve. The closest pair of two convex
sets only jumps where they are parallel, over covered ground, so a centre stays inside a loop as long as its two elements
overlap: from the last time on at which they do not.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.impact.finger_motion import CaptureHand, begin_phase, place_chain
from palmar.mechanics.impact.segments import closest_points

Floats = NDArray[np.float64]
MOST_STEPS = 20_000


@inlined
def clearance_of(hand: CaptureHand, element: int) -> float:
    """Distance of the disk's centre from an element of the chain that it touches; the palm is a line."""
    return hand.radius + (0.0 if element == len(hand.lengths) else hand.half_thickness)


@inlined
def _turns(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> int:
    """1 or -1 where the edge a-b crosses the ray from (x, y) along x upward or downward, else 0."""
    if (ay <= y) == (by <= y):
        return 0
    left = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
    if ay <= y:
        return 1 if left > 0.0 else 0
    return -1 if left < 0.0 else 0


@compiled
def inside_loop(hand: CaptureHand, chain: Floats, i: int, j: int, x: float, y: float, slack: float) -> bool:
    """Whether (x, y) is in the loop of the placed chain's elements i < j, if they overlap when grown, up to ``slack``."""
    apart, px, py, qx, qy = closest_points(
        chain[i, 0], chain[i, 1], chain[i + 1, 0], chain[i + 1, 1],
        chain[j, 0], chain[j, 1], chain[j + 1, 0], chain[j + 1, 1],
    )  # fmt: skip
    if apart > clearance_of(hand, i) + clearance_of(hand, j) + slack:
        return False
    winding = _turns(x, y, px, py, chain[i + 1, 0], chain[i + 1, 1]) + _turns(x, y, qx, qy, px, py)
    for k in range(i + 1, j):
        winding += _turns(x, y, chain[k, 0], chain[k, 1], chain[k + 1, 0], chain[k + 1, 1])
    return winding + _turns(x, y, chain[j, 0], chain[j, 1], qx, qy) != 0


@compiled
def enclosed_for_good(hand: CaptureHand, fingers: Floats, t: float, x: float, y: float, chain: Floats) -> bool:
    """Whether the centre is in a loop that is closed from t, or a time before, on; moves ``chain``."""
    placed = False
    for m in range(len(hand.closures)):
        if hand.closures[m, 0] <= t:
            if not placed:
                place_chain(hand, fingers, t, chain)
                placed = True
            if inside_loop(hand, chain, int(hand.closures[m, 1]), int(hand.closures[m, 2]), x, y, inf):
                return True
    return False


@compiled
def enclosed_now(hand: CaptureHand, fingers: Floats, t: float, x: float, y: float, chain: Floats) -> bool:
    """Whether the centre is in a loop that is closed at t, though it may open again; moves ``chain``."""
    place_chain(hand, fingers, t, chain)
    for i in range(2 * len(hand.lengths) - 1):
        for j in range(i + 2, 2 * len(hand.lengths) + 1):
            if inside_loop(hand, chain, i, j, x, y, 0.0):
                return True
    return False


@compiled
def gap_between(chain: Floats, i: int, j: int) -> float:
    """Distance of two elements of a placed chain."""
    return closest_points(
        chain[i, 0], chain[i, 1], chain[i + 1, 0], chain[i + 1, 1],
        chain[j, 0], chain[j, 1], chain[j + 1, 0], chain[j + 1, 1],
    )[0]  # fmt: skip


@compiled
def element_speed(hand: CaptureHand, phase: int, element: int) -> float:
    """Bound on the speed of an element's points in a phase."""
    n, total = len(hand.lengths), 0.0
    finger = 0 if element > n else 1
    for j in range(abs(element - n)):
        total += hand.lengths[j] * abs(hand.rates[phase, finger, j])
    return total


@compiled
def closed_since(hand: CaptureHand, i: int, j: int, fingers: Floats, chain: Floats) -> float:
    """The time from which on elements i and j overlap when grown; inf if they do not at the end.

    Back from the end in steps during which their distance cannot grow to the limit.
    """
    limit = clearance_of(hand, i) + clearance_of(hand, j)
    phase = len(hand.times) - 1
    t = hand.times[phase]
    for _ in range(MOST_STEPS):
        begin_phase(hand, phase, fingers)
        place_chain(hand, fingers, t, chain)
        short = limit - gap_between(chain, i, j)
        if short <= 0.0:
            return t if t < hand.times[len(hand.times) - 1] else np.inf
        if t <= hand.times[phase]:
            if phase == 0:
                return t
            phase -= 1
        speed = element_speed(hand, phase, i) + element_speed(hand, phase, j)
        back = short / speed if speed > 0.0 else np.inf
        before = max(t - back, hand.times[phase])
        if t - before <= 4e-16 * t:
            return t
        t = before
    return t


@compiled
def meets_at(hand: CaptureHand, phase: int, until: float, close: float, fingers: Floats, chain: Floats) -> float:
    """First time in a phase at which a link of one finger is within two half thicknesses of one of the other, or ``until``.

    No link turns so fast that steps of the gap over the speeds could pass a touch.
    """
    n, t = len(hand.lengths), hand.times[phase]
    begin_phase(hand, phase, fingers)
    speed = element_speed(hand, phase, 0) + element_speed(hand, phase, 2 * n)
    for _ in range(MOST_STEPS):
        place_chain(hand, fingers, t, chain)
        gap = np.inf
        for i in range(n):
            for j in range(n + 1, 2 * n + 1):
                gap = min(gap, gap_between(chain, i, j))
        gap -= 2.0 * hand.half_thickness
        if gap <= close or t >= until or speed == 0.0:
            break
        t += gap / speed
    return min(t, until)
