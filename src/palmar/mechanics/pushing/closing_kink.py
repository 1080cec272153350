"""Where in a stride the mode of the contacts ceases to be admissible: one begins or ends to slide, leaves, or jams.

The stages run on in the mode of the stride's begin, so along the interpolant how far the mode is from being
inadmissible (``margin_left``) is smooth, and its zero is found by false position. The stride is cut a little past it,
where the search over all modes finds another one, or none: then the object is jammed.
"""

from __future__ import annotations

from palmar.mechanics.pushing.closing_motion import LEFT, RIGHT, TIME, Bench, mode_twist, write_contacts
from palmar.mechanics.pushing.closing_stride import OVER, SHARE, pose_after
from palmar.mechanics.pushing.compiled import compiled
from palmar.mechanics.pushing.hand_pose import HandMotion
from palmar.mechanics.pushing.polygon_contacts import Body

PASSES = 60
CLOSEST = 1e-14
PAST = 1e-8
"""Every such cut takes the object at least so far (rad), so that no two modes can hold it up."""


@compiled
def _margin(hand: HandMotion, body: Body, at: Bench, count: int, skin: float, h: float, part: float) -> float:
    """How far the stride's mode is from being inadmissible at the fraction ``part``; -1 where it has no motion."""
    s, k = at.state, at.stages
    x, y, theta = pose_after(at, h, part)
    speed = write_contacts(hand, body, at, count, skin, s[TIME] + part * h, s[RIGHT], s[LEFT], x, y, theta)
    guess = (
        k[0, 0] + part * (k[6, 0] - k[0, 0]),
        k[0, 1] + part * (k[6, 1] - k[0, 1]),
        k[0, 2] + part * (k[6, 2] - k[0, 2]),
    )
    moves, margin = mode_twist(body, at, count, speed, guess)
    return margin if moves else -1.0


@compiled
def first_kink(hand: HandMotion, body: Body, at: Bench, count: int, skin: float, h: float, over: int) -> float:
    """Fraction of the stride at which its mode ends, given the first stage past that; 1 if that was deceptive."""
    a, at_a, b = 0.0, 1.0, SHARE[over]
    at_b = _margin(hand, body, at, count, skin, h, b)
    if at_b >= -OVER and b < 1.0:
        a, at_a, b = b, at_b, 1.0
        at_b = _margin(hand, body, at, count, skin, h, b)
    if at_b >= -OVER:
        return 1.0
    at_a = at_a if a > 0.0 else max(_margin(hand, body, at, count, skin, h, 0.0), 0.0)
    level, weight_a, weight_b, last = -2.0 * OVER, 1.0, 1.0, 0
    for k in range(PASSES):
        if at_b >= 2.0 * level or b - a <= CLOSEST:
            return min(max(b, PAST / h), 1.0)
        above, below = weight_a * (at_a - level), weight_b * (level - at_b)
        part = a + (b - a) * (0.5 if k % 4 == 3 else above / (above + below))
        here = _margin(hand, body, at, count, skin, h, part)
        side = 1 if here >= -OVER else -1
        if side == 1:
            a, at_a, weight_a, weight_b = part, here, 1.0, 0.5 * weight_b if last == 1 else 1.0
        else:
            b, at_b, weight_b, weight_a = part, here, 1.0, 0.5 * weight_a if last == -1 else 1.0
        last = side
    return min(max(b, PAST / h), 1.0)
