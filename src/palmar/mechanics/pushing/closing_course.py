"""The course of an object within one stride: a polynomial in time of the fourth degree, or an arc about a link's joint.

With u the fraction of the stride, pose(u) = pose(0) + u (c0 + u (c1 + u (c2 + u c3))), Shampine's interpolant of Dormand
and Prince's stages; its derivative is the twist up to the third order.
"""

from __future__ import annotations

from math import cos, sin

import numpy as np

from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing.closing_motion import (
    OMEGA,
    THETA,
    TIME,
    VX,
    VY,
    Bench,
    X,
    Y,
)  # fmt: skip
from palmar.mechanics.pushing.metric import Triple

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
def fit_course(at: Bench, h: float) -> None:
    """Write the coefficients for the stages of a stride h, (4, 3)."""
    k, course = at.stages, at.course
    for j in range(4):
        x, y, theta = 0.0, 0.0, 0.0
        for i in range(7):
            weight = BETWEEN[i, j]
            x, y, theta = x + weight * k[i, 0], y + weight * k[i, 1], theta + weight * k[i, 2]
        course[j, 0], course[j, 1], course[j, 2] = h * x, h * y, h * theta


@inlined
def pose_after(at: Bench, h: float, part: float) -> Triple:
    """Pose at the fraction ``part`` of the stride."""
    s, c, pivot = at.state, at.course, at.pivot
    x, y, theta = s[X], s[Y], s[THETA]
    if pivot[0] > 0.0:
        angle = pivot[3] * h * part
        cosine, sine, dx, dy = cos(angle), sin(angle), x - pivot[1], y - pivot[2]
        return pivot[1] + cosine * dx - sine * dy, pivot[2] + sine * dx + cosine * dy, theta + angle
    return (
        x + part * (c[0, 0] + part * (c[1, 0] + part * (c[2, 0] + part * c[3, 0]))),
        y + part * (c[0, 1] + part * (c[1, 1] + part * (c[2, 1] + part * c[3, 1]))),
        theta + part * (c[0, 2] + part * (c[1, 2] + part * (c[2, 2] + part * c[3, 2]))),
    )


@inlined
def twist_after(at: Bench, h: float, part: float) -> Triple:
    """Twist at the fraction ``part`` of a stride that is no arc."""
    c, share = at.course, 1.0 / h
    return (
        share * (c[0, 0] + part * (2.0 * c[1, 0] + part * (3.0 * c[2, 0] + part * 4.0 * c[3, 0]))),
        share * (c[0, 1] + part * (2.0 * c[1, 1] + part * (3.0 * c[2, 1] + part * 4.0 * c[3, 1]))),
        share * (c[0, 2] + part * (2.0 * c[1, 2] + part * (3.0 * c[2, 2] + part * 4.0 * c[3, 2]))),
    )


@compiled
def go_on(at: Bench, h: float, part: float, last: float) -> None:
    """Take the state to the fraction ``part`` of the stride, and its twist and the trend of that as far as known."""
    s, c, trend = at.state, at.course, at.trend
    x, y, theta = pose_after(at, h, part)
    time = s[TIME] + part * h
    s[TIME] = last if part == 1.0 and last - time <= 1e-12 else min(time, last)
    s[X], s[Y], s[THETA] = x, y, theta
    trend[:] = 0.0
    if at.pivot[0] > 0.0:
        s[VX], s[VY] = -s[OMEGA] * (y - at.pivot[2]), s[OMEGA] * (x - at.pivot[1])
    elif part < 1.0:
        s[VX], s[VY], s[OMEGA] = twist_after(at, h, part)
    else:
        k, square = at.stages, 1.0 / (h * h)
        s[VX], s[VY], s[OMEGA] = k[6, 0], k[6, 1], k[6, 2]
        for j in range(3):
            trend[j] = square * (2.0 * c[1, j] + 6.0 * c[2, j] + 12.0 * c[3, j])
