"""One stride of an object that closing links push: Runge and Kutta's method.

The pair of Dormand and Prince, orders 5 and 4; ``closing_course`` is what goes on between. Within a stride the
contacts that touch at its begin stay the same, and so does their mode: which of them carry load, stick or slide. So the
stages are smooth, also past the point where the mode ceases to be admissible or another contact begins; the stride is
cut there afterwards (``closing_kink``, ``closing_touch``).

An object that turns with a link (an edge flush on it that sticks, say) keeps doing so, with the loads that it has,
until something else touches it: such a stride is an arc, without an error.
"""

from __future__ import annotations

from math import hypot

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing.closing_course import fit_course
from palmar.mechanics.pushing.closing_motion import (
    LEFT,
    LOOSE,
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
from palmar.mechanics.pushing.contact_solve import TIGHT
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion, finger_of, stands
from palmar.mechanics.pushing.polygon_contacts import TOUCH, Body, Scale, link_of
from palmar.mechanics.pushing.single_contact import in_tables, single_twist

Floats = NDArray[np.float64]
FIRST_STRIDE, LONGEST_STRIDE, LONGEST_ARC, SHORTEST_STRIDE = 0.1, 0.5, 1.0, 1e-7
OVER = 1e-7
"""Margin below zero from which a mode counts as inadmissible: above the slack with which a new mode is found."""
DRIFT = 5.0
"""Gaps, in units of the gap that touches, by which two contacts under load may drift in a stride: where they nearly
oppose each other or meet a third, closing gaps again moves the object by many times as much."""
MOST_GROWTH = 2.5
"""Factor from one stride to the next. It is small because the rate at which two tips pinch an object grows without bound."""
EARLY, FINE = 2, 1e-5
"""Last stage at which the end of the mode stops a stride longer than FINE (rad)."""
BEYOND = 1.1
"""Length of a stride that is tried again, in units of the time to where its mode ends: not much is lost past that."""
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
AHEAD = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [-1 / 2, 3 / 2, 0.0, 0.0, 0.0, 0.0],
        [-5 / 3, 0.0, 8 / 3, 0.0, 0.0, 0.0],
        [53 / 243, 0.0, -128 / 243, 106 / 81, 0.0, 0.0],
        [7 / 24, 0.0, -100 / 159, 0.0, 567 / 424, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    ]
)
"""Each stage's twist as extrapolated from those before, by the polynomial through those named: where Newton begins."""


@inlined
def stages(
    hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale, h: float
) -> tuple[bool, int]:  # fmt: skip
    """Fill the stages of a stride h from the state, the first being the state's own twist; and the mode's margins there.

    Returns (whether they are filled, the first at which the mode is not admissible, or 7). They are not where one of
    them has no motion, and where the mode ends so early that a shorter stride is to be tried.
    """
    s, k = at.state, at.stages
    k[0, 0], k[0, 1], k[0, 2], k[0, 3] = s[VX], s[VY], s[OMEGA], 1.0
    over, at.frame[3] = 7, (LOOSE * TOUCH * scale.error / scale.touch) ** 2
    tabulated = in_tables(body, at, count)
    for i in range(1, 7):
        x, y, theta = s[X], s[Y], s[THETA]
        vx, vy, omega = 0.0, 0.0, 0.0
        for j in range(i):
            weight, ahead = h * STAGES[i, j], AHEAD[i, j]
            x, y, theta = x + weight * k[j, 0], y + weight * k[j, 1], theta + weight * k[j, 2]
            vx, vy, omega = vx + ahead * k[j, 0], vy + ahead * k[j, 1], omega + ahead * k[j, 2]
        if i == 1:
            step = SHARE[1] * h
            vx, vy, omega = vx + step * at.trend[0], vy + step * at.trend[1], omega + step * at.trend[2]
        speed = write_contacts(
            hand, body, at, count, scale.skin, s[TIME] + SHARE[i] * h, s[RIGHT], s[LEFT], x, y, theta
        )
        moves, margin = False, 0.0
        if tabulated:
            moves, margin = single_twist(body, at, speed)
        if not moves:
            moves, margin = mode_twist(body, at, count, speed, (vx, vy, omega))
        if not moves:
            return False, over
        motion = at.space.motions[0]
        k[i, 0], k[i, 1], k[i, 2], k[i, 3] = motion[0], motion[1], motion[2], margin
        if margin < -OVER and over == 7:
            over = i
            if i <= EARLY and h > FINE:
                return False, i
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
    """(length of a stride of the error allowed, stages and course filled; proposal for the next; ``over`` of ``stages``).

    Where the mode has no motion right after the state, the shortest stride with the state's twist is taken.
    """
    base = scale.touch
    for c in range(count):
        base = max(base, abs(at.gaps[c]) if at.loads[c, 0] != 0.0 else 0.0)
    while True:
        filled, over = stages(hand, body, at, count, scale, h)
        if not filled:
            if h <= SHORTEST_STRIDE:
                for i in range(1, 7):
                    at.stages[i, 0], at.stages[i, 1], at.stages[i, 2] = (
                        at.stages[0, 0],
                        at.stages[0, 1],
                        at.stages[0, 2],
                    )
                fit_course(at, SHORTEST_STRIDE)
                return SHORTEST_STRIDE, SHORTEST_STRIDE, 7
            h = max(h * (0.2 if over == 7 else min(max(BEYOND * _end_of_mode(at, over), 0.1), 0.5)), SHORTEST_STRIDE)
            continue
        error = error_of(at, count, body.reach, scale, base, h)
        factor = MOST_GROWTH if error <= 4e-3 * scale.error else 0.85 * (scale.error / error) ** 0.2
        if error <= scale.error or h <= SHORTEST_STRIDE:
            fit_course(at, h)
            if count > 1:
                factor = min(factor, max(_share_of_pinch(at, body.reach), 0.2))
            return h, min(max(h * factor, SHORTEST_STRIDE), LONGEST_STRIDE), over
        if over < 7:
            factor = min(factor, BEYOND * _end_of_mode(at, over))
        for j in range(3):
            at.trend[j] = (at.stages[1, j] - at.stages[0, j]) / (SHARE[1] * h)
        h = max(h * max(factor, 0.15), SHORTEST_STRIDE)


@inlined
def _share_of_pinch(at: Bench, reach: float) -> float:
    """Half the time left, in strides, if the speed grows as in a pinch, with the root of the time to its end; else much."""
    first, last = at.stages[0], at.stages[6]
    before = first[0] * first[0] + first[1] * first[1] + reach * reach * first[2] * first[2]
    growth = last[0] * last[0] + last[1] * last[1] + reach * reach * last[2] * last[2] - before
    return 0.5 * before / growth if growth > 0.0 else MOST_GROWTH


@inlined
def _end_of_mode(at: Bench, over: int) -> float:
    """About the fraction of the stride at which its mode ceases to be admissible, before the stage ``over``."""
    before, after = at.stages[over - 1, 3], at.stages[over, 3]
    a, b = SHARE[over - 1], SHARE[over]
    return b + (b - a) * after / (max(before, 0.0) - after)


@compiled
def turns_along(hand: HandMotion, body: Body, at: Bench, count: int) -> bool:
    """Whether all contacts are on one base link that moves and the object turns with it; then notes the pivot."""
    s, pivot = at.state, at.pivot
    pivot[0] = 0.0
    link = link_of(at.active[0])
    finger = finger_of(hand, link)
    if finger < 0 or (link - 1) % len(hand.links) > 0 or not stands(hand):
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
