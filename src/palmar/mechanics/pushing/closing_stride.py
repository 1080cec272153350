"""One stride of an object that closing links push: Runge and Kutta's method with a sure look-out for new contacts.

The pair of Dormand and Prince, orders 5 and 4, and the fourth-order interpolant between (Shampine). The contacts that
touch at the begin of the stride stay the same within it; which of them carry load, stick or slide is solved anew at
every stage. The interpolant is then searched for the first moment at which another candidate's gap has fallen to zero:
an interval is left only where bounds on the closing speed (links not in touch) or on the change of the closing speed
(further points of links in touch) rule a contact out, or where it is shorter than ``FINEST``.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.closing_jam import to_the_jam
from palmar.mechanics.pushing.closing_motion import (
    FENCE,
    KINK,
    LEFT,
    OMEGA,
    RIGHT,
    THETA,
    TIME,
    VX,
    VY,
    Bench,
    Scale,
    X,
    Y,
    continued_twist,
    write_contacts,
)  # fmt: skip
from palmar.mechanics.pushing.compiled import compiled
from palmar.mechanics.pushing.hand_pose import HandMotion, place_links
from palmar.mechanics.pushing.metric import Triple
from palmar.mechanics.pushing.polygon_contacts import Body, range_left, scan

Floats = NDArray[np.float64]
FINEST = 1e-3
"""Intervals (rad) in which a further contact that came and went would go unnoticed."""
LONGEST_SEARCH = 0.05
"""A contact's begin is located from a bracket not longer than this (rad)."""
KINK_FACTOR = 50.0
"""Factor on the error estimate of a stride within which a contact begins or ends to slide."""
FIRST_STRIDE, LONGEST_STRIDE, SHORTEST_STRIDE = 0.1, 0.5, 1e-7
NEAR_KINK = 2e-4
"""A contact that is to begin or end to slide is approached by halving as near as this (rad)."""
NEAR_JAM = 3e-5
"""A jam nearer than this (rad) is located by bisection along the last twist."""
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


@compiled
def stages(hand: HandMotion, body: Body, at: Bench, count: int, skin: float, h: float) -> int:
    """Fill the stages of a stride h from the state; returns 0, or the stage that has no motion (see ``at.trial``).

    The first stage is the state's own twist.
    """
    s, k = at.state, at.stages
    k[0, 0], k[0, 1], k[0, 2] = s[VX], s[VY], s[OMEGA]
    for i in range(1, 7):
        x, y, theta = s[X], s[Y], s[THETA]
        for j in range(i):
            weight = h * STAGES[i, j]
            x, y, theta = x + weight * k[j, 0], y + weight * k[j, 1], theta + weight * k[j, 2]
        time = s[TIME] + SHARE[i] * h
        speed = write_contacts(hand, body, at, count, skin, time, s[RIGHT], s[LEFT], x, y, theta)
        guess = k[i - 1, 0], k[i - 1, 1], k[i - 1, 2]
        if continued_twist(body, at, count, speed, guess) <= 0:
            at.trial[0], at.trial[1], at.trial[2], at.trial[3] = x, y, theta, time
            return i
        motion = at.space.motions[0]
        k[i, 0], k[i, 1], k[i, 2] = motion[0], motion[1], motion[2]
    return 0


@compiled
def error_of(at: Bench, count: int, reach: float, touch: float, h: float) -> float:
    """Error of the stride (m): estimated for position and angle times ``reach``, known for gaps under load."""
    k = at.stages
    ex, ey, turn = 0.0, 0.0, 0.0
    for i in range(7):
        ex, ey, turn = ex + ERROR[i] * k[i, 0], ey + ERROR[i] * k[i, 1], turn + ERROR[i] * k[i, 2]
    error = h * max(max(abs(ex), abs(ey)), reach * abs(turn))
    for c in range(count):
        if at.loads[c, 0] > 0.0:
            error = max(error, abs(at.gaps[c]) - touch)
    return error


@compiled
def stride(hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale, h: float) -> tuple[float, float]:
    """(length of a stride of the error allowed, stages filled; proposal for the next); 0 if it is jammed first."""
    s = at.state
    skin, touch, allowed = scale
    a, b, c = at.edges[0], at.edges[1], at.edges[2]
    for _ in range(80):
        at.edges[0], at.edges[1], at.edges[2] = a, b, c
        if s[FENCE] - s[TIME] < NEAR_JAM and to_the_jam(hand, body, at, count, skin):
            return 0.0, FIRST_STRIDE
        h = min(h, 0.6 * (s[FENCE] - s[TIME]))
        if s[TIME] + NEAR_KINK < s[KINK]:
            h = min(h, 0.6 * (s[KINK] - s[TIME]))
        failed = stages(hand, body, at, count, skin, h)
        if failed > 0:
            s[FENCE] = at.trial[3]
            continue
        kinked = at.edges[0] != a or at.edges[1] != b or at.edges[2] != c
        error = error_of(at, count, body.reach, touch, h) * (KINK_FACTOR if kinked else 1.0)
        factor = 5.0 if error <= 2e-4 * allowed else 0.9 * (allowed / error) ** 0.2
        if error <= allowed or h <= SHORTEST_STRIDE:
            if kinked:
                s[KINK] = inf
            return h, min(max(h * factor, SHORTEST_STRIDE), LONGEST_STRIDE)
        if kinked:
            s[KINK] = s[TIME] + h
        h = max(h * max(factor, 0.15), SHORTEST_STRIDE) if not kinked or h < 2.0 * NEAR_KINK else h
    return h, h


@compiled
def pose_after(at: Bench, h: float, part: float) -> Triple:
    """Pose at the fraction ``part`` of the stride."""
    s, k = at.state, at.stages
    x, y, theta = s[X], s[Y], s[THETA]
    for i in range(7):
        if part == 1.0:
            weight = h * (STAGES[6, i] if i < 6 else 0.0)
        else:
            row = BETWEEN[i]
            weight = h * part * (row[0] + part * (row[1] + part * (row[2] + part * row[3])))
        x, y, theta = x + weight * k[i, 0], y + weight * k[i, 1], theta + weight * k[i, 2]
    return x, y, theta


@compiled
def gaps_after(
    hand: HandMotion, body: Body, at: Bench, count: int, skin: float, touch: float, h: float, part: float
) -> tuple[float, float]:
    """Least gaps at the fraction ``part``: of links not in touch, and of further candidates of those in touch."""
    x, y, theta = pose_after(at, h, part)
    place_links(hand, at.state[TIME] + part * h, at.state[RIGHT], at.state[LEFT], at.links)
    free, near, _ = scan(body, at.links, len(hand.links), skin, x, y, theta, at.active, count, touch, at.found)
    return free, near


@compiled
def closing_speed(hand: HandMotion, at: Bench, reach: float) -> float:
    """Bound (m/rad) on how fast a link and the object approach in the stride whose stages are filled; links placed."""
    speed, turn = 0.0, 0.0
    for i in range(7):
        k = at.stages[i]
        speed, turn = max(speed, abs(k[0]) + abs(k[1])), max(turn, abs(k[2]))
    fastest = abs(hand.vx) + abs(hand.vy)
    for link in range(1, 2 * len(hand.links) + 1):
        row = at.links[link]
        length = abs(row[2] - row[0]) + abs(row[3] - row[1]) + row[7]
        fastest = max(fastest, abs(row[5]) + abs(row[6]) + abs(row[4]) * length)
    return fastest + 1.1 * (speed + reach * turn)


@compiled
def first_touch(hand: HandMotion, body: Body, at: Bench, count: int, skin: float, touch: float, h: float) -> float:
    """Fraction of the stride h at which the first new contact touches (gap between 0 and ``touch``); 1 if none does."""
    free, near = gaps_after(hand, body, at, count, skin, touch, h, 0.0)
    speed = closing_speed(hand, at, body.reach)
    bend = 0.5 * speed * (1.0 + speed / body.reach * 0.25)
    level = 0.5 * touch
    if min(free, near) <= level:
        return 1.0
    a, step = 0.0, 1.0
    while a < 1.0:
        b = min(a + step, 1.0)
        next_free, next_near = gaps_after(hand, body, at, count, skin, touch, h, b)
        span = (b - a) * h
        if min(next_free, next_near) <= level:
            if span <= LONGEST_SEARCH:
                return _locate(hand, body, at, count, skin, touch, h, a, b, min(free, near), min(next_free, next_near))
            step = 0.5 * (b - a)
            continue
        clear = free + next_free > speed * span and min(near, next_near) > bend * span * span
        if clear or span <= FINEST:
            a, free, near = b, next_free, next_near
            step = 2.0 * step if clear else step
        else:
            step = 0.3 * (b - a)
    return 1.0


@compiled
def first_change(hand: HandMotion, body: Body, at: Bench, count: int, slack: float, h: float, part: float) -> float:
    """Fraction of the stride, at most ``part``, at which an active contact is out of its range by ``slack``."""
    low, high = 0.0, part
    if _least_range(hand, body, at, count, h, part) > -slack:
        return part
    for _ in range(60):
        middle = 0.5 * (low + high)
        least = _least_range(hand, body, at, count, h, middle)
        if least > -slack:
            low = middle
        else:
            high = middle
            if least > -3.0 * slack:
                return high
    return high


@compiled
def _least_range(hand: HandMotion, body: Body, at: Bench, count: int, h: float, part: float) -> float:
    x, y, theta = pose_after(at, h, part)
    place_links(hand, at.state[TIME] + part * h, at.state[RIGHT], at.state[LEFT], at.links)
    least = inf
    for k in range(count):
        least = min(least, range_left(body, at.links, at.active[k], at.sides[k], x, y, theta))
    return least


@compiled
def _locate(
    hand: HandMotion, body: Body, at: Bench, count: int, skin: float, touch: float, h: float,
    a: float, b: float, at_a: float, at_b: float,
) -> float:  # fmt: skip
    """Where in [a, b] the least gap falls to half of ``touch``: false position, halving where that does not shrink."""
    level, width = 0.5 * touch, inf
    for k in range(80):
        part = a + (b - a) * (at_a - level) / (at_a - at_b)
        if k % 3 == 2 and b - a > 0.25 * width:
            part = 0.5 * (a + b)
        if k % 3 == 0:
            width = b - a
        free, near = gaps_after(hand, body, at, count, skin, touch, h, part)
        gap = min(free, near)
        if abs(gap - level) <= 0.4 * touch or b - a <= 1e-15:
            return part
        if gap > level:
            a, at_a = part, gap
        else:
            b, at_b = part, gap
    return b
