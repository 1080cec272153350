"""One stride of an object that closing links push: Runge and Kutta's method.

The pair of Dormand and Prince, orders 5 and 4, and the fourth-order interpolant between (Shampine). Within a stride the
contacts that touch at its begin stay the same, and so does their mode: which of them carry load, stick or slide. So the
stages are smooth, also past the point where the mode ceases to be admissible or another contact begins; the stride is
cut there afterwards (``closing_kink``, ``closing_touch``).

An object that turns with a link (an edge flush on it that sticks, say) keeps doing so, with the loads that it has,
until something else touches it: such a stride is an arc, without an error.
"""

from __future__ import annotations

from math import cos, hypot, sin

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.closing_motion import (
    LEFT,
    OMEGA,
    RIGHT,
    THETA,
    TIME,
    VX,
    VY,
    Bench,
    X,
    Y,
    mode_twist,
    write_contacts,
)  # fmt: skip
from palmar.mechanics.pushing.compiled import compiled, inlined
from palmar.mechanics.pushing.contact_solve import TIGHT
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion, finger_of
from palmar.mechanics.pushing.metric import Triple
from palmar.mechanics.pushing.polygon_contacts import Body, Scale, link_of

Floats = NDArray[np.float64]
FIRST_STRIDE, LONGEST_STRIDE, LONGEST_ARC, SHORTEST_STRIDE = 0.1, 0.5, 1.0, 1e-7
OVER = 1e-7
"""Margin below zero from which a mode counts as inadmissible: above the slack with which a new mode is found."""
DRIFT = 5.0
"""Gaps, in units of the gap that touches, by which two contacts under load may drift in a stride: where they nearly
oppose each other or meet a third, closing gaps again moves the object by many times as much."""
SHARE = (0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0)
STAGES = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
        [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
ERROR = (-71 / 57600, 0.0, 71 / 16695, -71 / 1920, 17253 / 339200, -22 / 525, 1 / 40)
BETWEEN = np.array(
    [
        [1.0, -8048581381 / 2820520608, 8663915743 / 2820520608, -12715105075 / 11282082432],
        [0.0, 0.0, 0.0, 0.0],
        [0.0, 131558114200 / 32700410799, -68118460800 / 10900136933, 87487479700 / 32700410799],
        [0.0, -1754552775 / 470086768, 14199869525 / 1410260304, -10690763975 / 1880347072],
        [0.0, 127303824393 / 49829197408, -318862633887 / 49829197408, 701980252875 / 199316789632],
        [0.0, -282668133 / 205662961, 2019193451 / 616988883, -1453857185 / 822651844],
        [0.0, 40617522 / 29380423, -110615467 / 29380423, 69997945 / 29380423],
    ]
)


@inlined
def stages(
    hand: HandMotion, body: Body, at: Bench, count: int, skin: float, h: float
) -> tuple[bool, int]:  # fmt: skip
    """Fill the stages of a stride h from the state, the first being the state's own twist.

    Returns (whether all have a motion, the first at which the mode is not admissible, or 7).
    """
    s, k = at.state, at.stages
    k[0, 0], k[0, 1], k[0, 2] = s[VX], s[VY], s[OMEGA]
    over = 7
    for i in range(1, 7):
        x, y, theta = s[X], s[Y], s[THETA]
        for j in range(i):
            weight = h * STAGES[i, j]
            x, y, theta = x + weight * k[j, 0], y + weight * k[j, 1], theta + weight * k[j, 2]
        speed = write_contacts(hand, body, at, count, skin, s[TIME] + SHARE[i] * h, s[RIGHT], s[LEFT], x, y, theta)
        ahead = SHARE[i] / SHARE[i - 1] if i > 1 else 1.0
        guess = (
            k[0, 0] + ahead * (k[i - 1, 0] - k[0, 0]),
            k[0, 1] + ahead * (k[i - 1, 1] - k[0, 1]),
            k[0, 2] + ahead * (k[i - 1, 2] - k[0, 2]),
        )
        moves, margin = mode_twist(body, at, count, speed, guess)
        if not moves:
            return False, over
        if margin < -OVER and over == 7:
            over = i
        motion = at.space.motions[0]
        k[i, 0], k[i, 1], k[i, 2] = motion[0], motion[1], motion[2]
    return True, over


@inlined
def error_of(at: Bench, count: int, reach: float, scale: Scale, base: float, h: float) -> float:
    """Error of the stride (m): estimated for position and angle times ``reach``, known for gaps that the mode closes.

    ``base`` (m) is what the latter were off at the stride's begin, or what touches.
    """
    k = at.stages
    ex, ey, turn = 0.0, 0.0, 0.0
    for i in range(7):
        ex, ey, turn = ex + ERROR[i] * k[i, 0], ey + ERROR[i] * k[i, 1], turn + ERROR[i] * k[i, 2]
    error, drift, held = h * max(max(abs(ex), abs(ey)), reach * abs(turn)), 0.0, 0
    for c in range(count):
        if at.loads[c, 0] != 0.0:
            drift, held = max(drift, abs(at.gaps[c]) - base), held + 1
    return max(error, drift if held == 1 else drift * max(scale.error / (DRIFT * scale.touch), 1.0))


@compiled
def stride(hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale, h: float) -> tuple[float, float, int]:
    """(length of a stride of the error allowed, stages filled; proposal for the next; ``over`` of ``stages``).

    Where the mode has no motion right after the state, the shortest stride with the state's twist is taken.
    """
    base = scale.touch
    for c in range(count):
        base = max(base, abs(at.gaps[c]) if at.loads[c, 0] != 0.0 else 0.0)
    while True:
        moves, over = stages(hand, body, at, count, scale.skin, h)
        if not moves:
            if h <= SHORTEST_STRIDE:
                for i in range(1, 7):
                    at.stages[i, 0], at.stages[i, 1], at.stages[i, 2] = (
                        at.stages[0, 0],
                        at.stages[0, 1],
                        at.stages[0, 2],
                    )
                return SHORTEST_STRIDE, SHORTEST_STRIDE, 7
            h = max(0.2 * h, SHORTEST_STRIDE)
            continue
        error = error_of(at, count, body.reach, scale, base, h)
        factor = 5.0 if error <= 2e-4 * scale.error else 0.9 * (scale.error / error) ** 0.2
        if error <= scale.error or h <= SHORTEST_STRIDE:
            return h, min(max(h * factor, SHORTEST_STRIDE), LONGEST_STRIDE), over
        h = max(h * max(factor, 0.15), SHORTEST_STRIDE)


@compiled
def turns_along(hand: HandMotion, body: Body, at: Bench, count: int) -> bool:
    """Whether all contacts are on one base link that moves and the object turns with it; then notes the pivot."""
    s, pivot = at.state, at.pivot
    pivot[0] = 0.0
    link = link_of(at.active[0])
    finger = finger_of(hand, link)
    if finger < 0 or (link - 1) % len(hand.links) > 0 or hand.vx != 0.0 or hand.vy != 0.0:
        return False
    if s[RIGHT if finger == 0 else LEFT] != MOVING:
        return False
    for k in range(count):
        if link_of(at.active[k]) != link:
            return False
    row = at.links[link]
    rate = row[4]
    vx, vy = -rate * (s[Y] - row[1]), rate * (s[X] - row[0])
    slack = 10.0 * TIGHT * (abs(vx) + abs(vy) + body.reach)
    if abs(s[VX] - vx) + abs(s[VY] - vy) + body.reach * abs(s[OMEGA] - rate) > slack:
        return False
    pivot[0], pivot[1], pivot[2], pivot[3] = 1.0, row[0], row[1], rate
    for i in range(7):  # no more than bounds of the speed here
        k = at.stages[i]
        k[0], k[1], k[2] = 1.5 * hypot(vx, vy), 0.0, rate
    return True


@inlined
def pose_after(at: Bench, h: float, part: float) -> Triple:
    """Pose at the fraction ``part`` of the stride."""
    s, k, pivot = at.state, at.stages, at.pivot
    x, y, theta = s[X], s[Y], s[THETA]
    if pivot[0] > 0.0:
        angle = pivot[3] * h * part
        cosine, sine, dx, dy = cos(angle), sin(angle), x - pivot[1], y - pivot[2]
        return pivot[1] + cosine * dx - sine * dy, pivot[2] + sine * dx + cosine * dy, theta + angle
    for i in range(7):
        if part == 1.0:
            weight = h * (STAGES[6, i] if i < 6 else 0.0)
        else:
            row = BETWEEN[i]
            weight = h * part * (row[0] + part * (row[1] + part * (row[2] + part * row[3])))
        x, y, theta = x + weight * k[i, 0], y + weight * k[i, 1], theta + weight * k[i, 2]
    return x, y, theta
