"""The way of one start through a closing motion: poses at given angles, by the stepping kernel in one pass.

The kernel's state is carried from angle to angle. Where several motions were admissible, the way shown is the one whose
end ``closing_steps`` reports: its alternatives are followed in the same order, each from the frames before it branched.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.closing_end import CAGED
from palmar.mechanics.pushing.closing_motion import ARM, LEFT, RIGHT, THETA, TIME, Bench, X, Y, bench
from palmar.mechanics.pushing.closing_steps import MOST_STEPS, TOLERANCE, follow, judge
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion
from palmar.mechanics.pushing.polygon_contacts import Body, Scale, scale_of

Floats = NDArray[np.float64]


def carry_frames(hand: HandMotion, body: Body, start: Floats, angles: Floats) -> tuple[Floats, Floats]:
    """Poses (K, 3) and base angles right and left (K, 2) at the rising base ``angles`` (K,) from a valid start (3,)."""
    at, scale = bench(0), scale_of(float(hand.links.sum()), body, TOLERANCE)
    s = at.state
    s[X], s[Y], s[THETA], s[TIME], s[RIGHT], s[LEFT], s[ARM] = *start, hand.first, MOVING, MOVING, MOVING
    rows = np.empty((len(angles), 5))
    shown, waiting = None, [rows]
    while waiting:
        rows = waiting.pop().copy()
        if shown is not None:
            s[:] = at.branches[len(waiting)]
        _carry_on(hand, body, at, scale, angles, rows, waiting)
        caught = judge(hand, body, at, scale) <= CAGED
        if shown is None or not caught:
            shown = rows
        if not caught:
            break
    assert shown is not None
    return shown[:, :3], shown[:, 3:]


def _carry_on(
    hand: HandMotion, body: Body, at: Bench, scale: Scale, angles: Floats, rows: Floats, waiting: list[Floats]
) -> None:
    """Write the rows (x, y, theta, right, left) from the state's time on; what branches off is added to ``waiting``."""
    s = at.state
    for k in range(len(angles)):
        if angles[k] < s[TIME]:
            continue
        angle = float(angles[k])
        part = hand._replace(last=min(angle, hand.last), alone=min(angle, hand.alone))
        _, branches = follow(part, body, at, scale, MOST_STEPS, len(waiting))
        waiting.extend([rows] * (branches - len(waiting)))
        right = angles[k] if s[RIGHT] == MOVING else s[RIGHT]
        left = angles[k] if s[LEFT] == MOVING else s[LEFT]
        rows[k:] = s[X], s[Y], s[THETA], right, left
