"""A round pusher moves in a straight line and carries a slider along: where does the slider end?

Quasi-static: the slider moves only while it is pushed. While the pusher's path is s long (m), the pose changes as
pose' = the twist of ``solve_motion`` for the one contact. The path is followed with the pair of Bogacki and Shampine,
orders 3 and 2, the step chosen so that the difference of the two stays below the tolerance; after each step the slider
is shifted along the contact's normal until the gap is zero again. Before the touch the gap is a convex function of s,
so Newton's method cannot step over the touch; after a separation the pusher does not come back.

Assumptions: the pusher does not turn; pressure, friction of the table and of the pusher are constant.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import cos, hypot, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.batch import in_parts
from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.contact_solve import Workspace, workspace
from palmar.mechanics.pushing.metric import Triple
from palmar.mechanics.pushing.motion_solve import solve_motion
from palmar.mechanics.pushing.slider import Slider, nearest

Floats = NDArray[np.float64]
TOLERANCE = 1e-7
"""Default error per step (m). The pose at the end is then right to about 1e-6 m, measured in docs/results/pushes.md."""
MOST_STEPS = 20_000
ROWS_PER_TASK = 32
SINGLE = np.array([1])
"""One contact, as a variable: for the literal 1 numba would compile the solvers a second time."""


class PushOutcome(Enum):
    """How a push ended; the value is the kernel's code."""

    MISSED = 0
    """The pusher did not touch the slider."""
    PUSHED = 1
    """The slider was moved, in contact until the end or left behind."""
    UNDECIDED = 2
    """No answer: the bound on steps was reached, or the contact problem had no solution."""


class Pusher(NamedTuple):
    """Radius (m) of the round pusher and its friction against the slider."""

    radius: float
    friction: float


@dataclass(frozen=True)
class Pushed:
    """Final poses (N, 3) of the object's frame; outcomes; whether Coulomb's law admitted several motions on the way."""

    poses: Floats
    outcomes: tuple[PushOutcome, ...]
    ambiguous: NDArray[np.bool_]


def push(
    slider: Slider,
    pusher: Pusher,
    starts: Floats,
    paths: Floats,
    tolerance: float = TOLERANCE,
    threads: int | None = None,
) -> Pushed:
    """Push once per row: start poses (N, 3) x, y, theta of the object's frame, pusher centres (N, 4) from x, y to x, y.

    Rows are independent, so the result does not depend on ``threads``.
    """
    poses = np.ascontiguousarray(starts, dtype=float).copy()
    lines = np.ascontiguousarray(paths, dtype=float)
    codes, several = np.zeros(len(poses), dtype=np.int64), np.zeros(len(poses), dtype=np.bool_)

    def part(rows: slice) -> None:
        push_rows(slider, pusher, poses[rows], lines[rows], tolerance, codes[rows], several[rows], workspace())

    in_parts(part, len(poses), ROWS_PER_TASK, threads)
    return Pushed(poses, tuple(PushOutcome(int(code)) for code in codes), several)


@compiled
def push_rows(
    slider: Slider, pusher: Pusher, poses: Floats, paths: Floats, tolerance: float,
    codes: NDArray[np.int64], several: NDArray[np.bool_], space: Workspace,
) -> None:  # fmt: skip
    """Advance every pose of the object's frame in place. The workspace is made outside: such a kernel makes no arrays."""
    cx, cy = slider.centre
    for i in range(len(poses)):
        c, s = cos(poses[i, 2]), sin(poses[i, 2])
        start = poses[i, 0] + c * cx - s * cy, poses[i, 1] + s * cx + c * cy, poses[i, 2]
        line = paths[i, 0], paths[i, 1], paths[i, 2], paths[i, 3]
        (x, y, theta), codes[i], several[i] = push_one(slider, pusher, start, line, tolerance, space)
        c, s = cos(theta), sin(theta)
        poses[i, 0], poses[i, 1], poses[i, 2] = x - c * cx + s * cy, y - s * cx - c * cy, theta


@compiled
def push_one(
    slider: Slider, pusher: Pusher, pose: Triple, path: tuple[float, float, float, float], tolerance: float,
    space: Workspace,
) -> tuple[Triple, int, bool]:  # fmt: skip
    """One push; ``pose`` is that of the centre of pressure. Returns the last pose, the outcome's code, ambiguity."""
    px, py = moved_out(slider, pusher.radius, pose, path[0], path[1])
    length = hypot(path[2] - px, path[3] - py)
    if length == 0.0:
        return pose, 0, False
    line = px, py, (path[2] - px) / length, (path[3] - py) / length
    s = first_touch(slider, pusher.radius, pose, line, length)
    if s >= length:
        return pose, 0, False
    size = slider.surface.length
    rate, several = _rate(slider, pusher, pose, line, s, (0.0, 0.0, 0.0), space)
    step, most = 0.02 * size, 0.25 * (size + pusher.radius)
    for _ in range(MOST_STEPS):
        if several < 1:
            return pose, 2, False
        h = min(step, most, length - s)
        second, _ = _rate(slider, pusher, _ahead(pose, rate, 0.5 * h), line, s + 0.5 * h, rate, space)
        third, _ = _rate(slider, pusher, _ahead(pose, second, 0.75 * h), line, s + 0.75 * h, second, space)
        mean = _mixed(2.0 / 9.0, rate, 1.0 / 3.0, second, 4.0 / 9.0, third)
        there = _ahead(pose, mean, h)
        fourth, number = _rate(slider, pusher, there, line, s + h, third, space)
        error = h * _difference(rate, second, third, fourth, size)
        step = h * min(max(0.9 * (tolerance / (error + 1e-300)) ** (1.0 / 3.0), 0.2), 4.0)
        if error > tolerance and h > 1e-9 * size:
            continue
        s, rate, several = s + h, fourth, max(number, several) if number > 0 else number
        at_rest = rate[0] == 0.0 and rate[1] == 0.0 and rate[2] == 0.0
        pose = there if at_rest else _closed_up(slider, pusher.radius, there, line, s)
        if at_rest or s >= length * (1.0 - 1e-12):
            return pose, 1, several > 1
    return pose, 2, several > 1


@compiled
def moved_out(slider: Slider, radius: float, pose: Triple, px: float, py: float) -> tuple[float, float]:
    """The pusher's centre, moved the shortest way out of the slider if it overlaps; the slider stays."""
    gap, nx, ny = _gap(slider, radius, pose, px, py)
    return (px - gap * nx, py - gap * ny) if gap < 0.0 else (px, py)


@compiled
def first_touch(
    slider: Slider, radius: float, pose: Triple, line: tuple[float, float, float, float], length: float
) -> float:
    """Path (m) at which the pusher touches the resting slider; at least ``length`` if it does not."""
    s = 0.0
    for _ in range(100):
        gap, nx, ny = _gap(slider, radius, pose, line[0] + s * line[2], line[1] + s * line[3])
        slope = nx * line[2] + ny * line[3]
        if slope >= 0.0:
            return length
        if gap <= 1e-12 * slider.surface.length:
            return s
        s -= gap / slope
        if s >= length:
            return length
    return s


@compiled
def _gap(slider: Slider, radius: float, pose: Triple, px: float, py: float) -> Triple:
    """Gap to a pusher centred at p (m), and the outward normal of the slider there, in the table's frame."""
    c, s = cos(pose[2]), sin(pose[2])
    dx, dy = px - pose[0], py - pose[1]
    distance, _, _, nx, ny = nearest(slider, c * dx + s * dy, c * dy - s * dx)
    return distance - radius, c * nx - s * ny, s * nx + c * ny


@compiled
def _rate(
    slider: Slider, pusher: Pusher, pose: Triple, line: tuple[float, float, float, float], s: float, guess: Triple,
    space: Workspace,
) -> tuple[Triple, int]:  # fmt: skip
    """Change of the pose per path with the pusher at ``s``, taken to touch, and the number of admissible motions."""
    cosine, sine = cos(pose[2]), sin(pose[2])
    dx, dy = line[0] + s * line[2] - pose[0], line[1] + s * line[3] - pose[1]
    _, rx, ry, nx, ny = nearest(slider, cosine * dx + sine * dy, cosine * dy - sine * dx)
    row = space.contacts[0]
    row[0], row[1], row[2], row[3] = rx, ry, -nx, -ny
    row[4], row[5], row[6] = cosine * line[2] + sine * line[3], cosine * line[3] - sine * line[2], pusher.friction
    gx, gy = cosine * guess[0] + sine * guess[1], cosine * guess[1] - sine * guess[0]
    number = solve_motion(slider.surface, space.contacts, int(SINGLE[0]), (gx, gy, guess[2]), space)
    vx, vy, omega = space.motions[0, 0], space.motions[0, 1], space.motions[0, 2]
    return (cosine * vx - sine * vy, sine * vx + cosine * vy, omega), number


@compiled
def _closed_up(
    slider: Slider, radius: float, pose: Triple, line: tuple[float, float, float, float], s: float
) -> Triple:
    """The slider shifted along the normal until the gap is zero."""
    gap, nx, ny = _gap(slider, radius, pose, line[0] + s * line[2], line[1] + s * line[3])
    return pose[0] + gap * nx, pose[1] + gap * ny, pose[2]


@compiled
def _ahead(pose: Triple, rate: Triple, h: float) -> Triple:
    return pose[0] + h * rate[0], pose[1] + h * rate[1], pose[2] + h * rate[2]


@compiled
def _mixed(a: float, first: Triple, b: float, second: Triple, c: float, third: Triple) -> Triple:
    return (
        a * first[0] + b * second[0] + c * third[0],
        a * first[1] + b * second[1] + c * third[1],
        a * first[2] + b * second[2] + c * third[2],
    )


@compiled
def _difference(first: Triple, second: Triple, third: Triple, fourth: Triple, size: float) -> float:
    """Difference per step of the two orders, angles times ``size``."""
    worst = 0.0
    for k in range(3):
        apart = -5.0 / 72.0 * first[k] + second[k] / 12.0 + third[k] / 9.0 - fourth[k] / 8.0
        worst = max(worst, abs(apart) * (size if k == 2 else 1.0))
    return worst
