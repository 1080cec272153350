"""Where a finger ends when the other, with which it shares a plane, has stalled: the first angle at which they touch.

Two fingers that move as mirror images meet on the axis. One that goes on alone passes the axis and ends where its links
come within two half thicknesses of those at rest; so do two that move each in its own way. No point moves faster than the
finger is long times its turn, so turning by the gap over that never passes a touch; it stops where the gap is ``CLOSE``.
"""

from __future__ import annotations

from math import cos, hypot, inf, sin

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing.closing_tables import ClosingHand
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion, place_links

Floats = NDArray[np.float64]
CLOSE = 1e-9
"""Gap, in finger lengths, that counts as a touch."""
MOST_TURNS = 10_000


@inlined
def _from_point(ax: float, ay: float, bx: float, by: float, x: float, y: float) -> float:
    """Distance of the point (x, y) from the segment a-b."""
    dx, dy = bx - ax, by - ay
    along = min(max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
    return hypot(x - ax - along * dx, y - ay - along * dy)


@inlined
def _between(
    ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float
) -> float:  # fmt: skip
    """Distance between the segments a-b and c-d that do not cross."""
    return min(
        min(_from_point(ax, ay, bx, by, cx, cy), _from_point(ax, ay, bx, by, dx, dy)),
        min(_from_point(cx, cy, dx, dy, ax, ay), _from_point(cx, cy, dx, dy, bx, by)),
    )


@compiled
def straight_travel_end(hand: ClosingHand, stalled: float) -> float:
    """Angle at which a straight finger ends whose mirror image has stalled at the angle ``stalled``."""
    if hand.alone == 0.0:
        return hand.last
    d, length, psi = hand.half_palm, hand.length, stalled
    tip_x, tip_y = d + length * cos(stalled), length * sin(stalled)
    for _ in range(MOST_TURNS):
        x, y = -d - length * cos(psi), length * sin(psi)
        gap = _between(d, 0.0, tip_x, tip_y, -d, 0.0, x, y) - 2.0 * hand.half_thickness
        if gap <= CLOSE * length or psi >= hand.alone:
            break
        psi += gap / length
    return min(psi, hand.alone)


@compiled
def travel_end(hand: HandMotion, time: float, right: float, left: float, links: Floats) -> float:
    """Angle at which the motion ends, seen from ``time``; ``right``, ``left``: stall angles or MOVING; moves ``links``."""
    moves = 1 if right == MOVING else 0, 1 if left == MOVING else 0
    if hand.alone == 0.0 or moves[0] + moves[1] == 0 or (moves[0] + moves[1] == 2 and hand.mirrored):
        return hand.last
    count, psi, fastest, length = len(hand.links), time, 0.0, hand.links.sum()
    for finger in range(2):
        turn = 1.0
        for j in range(count):
            turn += hand.ratios[finger, j]
            fastest += moves[finger] * abs(turn) * hand.links[j]
    if fastest == 0.0:
        return hand.alone
    for _ in range(MOST_TURNS):
        place_links(hand, psi, right, left, links)
        gap = inf
        for i in range(1, count + 1):
            for j in range(count + 1, 2 * count + 1):
                one, other = links[i], links[j]
                gap = min(
                    gap, _between(one[0], one[1], one[2], one[3], other[0], other[1], other[2], other[3])
                )  # fmt: skip
        gap -= 2.0 * hand.half_thickness
        if gap <= CLOSE * length or psi >= hand.alone:
            break
        psi += gap / fastest
    return min(psi, hand.alone)
