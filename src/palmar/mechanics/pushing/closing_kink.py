"""Where in a stride the mode of the contacts ceases to be admissible: one begins or ends to slide, leaves, or jams.

The stages run on in the mode of the stride's begin, so along the interpolant how far the mode is from being
inadmissible (``margin_left``) is smooth, and its zero is found by the secant (``crossing``). The stride is cut a little
past it, where the search over all modes finds another one, or none: then the object is jammed.
"""

from __future__ import annotations

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_course import pose_after, twist_after
from palmar.mechanics.pushing.closing_motion import LEFT, REST, RIGHT, TIME, Bench, mode_twist, write_contacts
from palmar.mechanics.pushing.closing_stride import OVER, SHARE
from palmar.mechanics.pushing.crossing import next_point
from palmar.mechanics.pushing.hand_pose import HandMotion
from palmar.mechanics.pushing.polygon_contacts import Body

PASSES = 120
CLOSEST = 1e-10
"""Bracket (rad) at which the search ends: where a contact is left the motion stops and its load jumps to the opposite. The
cut is PAST that, so that it is sure to be left."""
PAST = 1e-8
"""Every cut takes the object at least so far (rad), so that no two modes can hold it up."""


@compiled
def _margin(hand: HandMotion, body: Body, at: Bench, count: int, skin: float, h: float, part: float) -> float:
    """How far the stride's mode is from being inadmissible at the fraction ``part``; -1 where it has no motion."""
    s = at.state
    x, y, theta = pose_after(at, h, part)
    speed = write_contacts(hand, body, at, count, skin, s[TIME] + part * h, s[RIGHT], s[LEFT], x, y, theta)
    guess = twist_after(at, h, part)
    moves, margin = mode_twist(body, at, count, speed, guess)
    return margin if moves else -1.0


@compiled
def first_kink(hand: HandMotion, body: Body, at: Bench, count: int, skin: float, h: float, over: int) -> float:
    """Fraction of the stride at which its mode ends, given the first stage past that; 1 if that was deceptive."""
    at.frame[3] = REST * REST
    level, a, b = -2.0 * OVER, SHARE[min(over, 5) - 1], SHARE[over]
    at_b = _margin(hand, body, at, count, skin, h, b)
    if at_b >= -OVER and b < 1.0:
        a, b = b, 1.0
        at_a, at_b = at_b, _margin(hand, body, at, count, skin, h, 1.0)
    else:
        at_a = _margin(hand, body, at, count, skin, h, a)
    if at_b >= -OVER:
        return 1.0
    if at_a < -OVER:
        a, b, at_b = 0.0, a, at_a
        at_a = max(_margin(hand, body, at, count, skin, h, 0.0), 0.0)
    x1, f1, x2, f2 = (a, at_a - level, b, at_b - level) if at_a > -at_b else (b, at_b - level, a, at_a - level)
    for k in range(PASSES):
        if at_b >= 2.0 * level:
            break
        if b - a <= CLOSEST / h:
            return min(b + PAST / h, 1.0)
        part = next_point(a, b, x1, f1, x2, f2, k)
        here = _margin(hand, body, at, count, skin, h, part)
        if here >= -OVER:
            a = part
        else:
            b, at_b = part, here
        x1, f1, x2, f2 = part, here - level, x1, f1
    return min(max(b, PAST / h), 1.0)
