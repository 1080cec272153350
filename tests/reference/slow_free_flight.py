"""A disk in free space between two closing fingers, carried by small steps: slow, plain, and independent.

Lines for palm and fingers, no friction, fingers that nothing slows, one radian of finger per unit of time. In every step
the distance of the centre from each of the three segments is looked at; where it has fallen below the radius, the step is
halved until the touch is found, and the velocity along the line from the nearest point to the centre is reflected in that
point's own velocity. Nothing here uses the equations of flight or impact of section 4.
"""

from __future__ import annotations

from math import acos, cos, hypot, sin

import numba
import numpy as np

STEP, DEPTH = 5e-4, 1e-6
"""Radians of finger a step; how deep, in finger lengths, a touch may go before it is found."""


@numba.njit(cache=True)
def nearest(body: int, x: float, y: float, psi: float, d: float, length: float):
    """Nearest point of palm (0), right (1) or left finger (2), and its velocity."""
    ax, ay, bx, by, rate = -d, 0.0, d, 0.0, 0.0
    if body > 0:
        side = 1.0 if body == 1 else -1.0
        ax, bx, by, rate = side * d, side * (d + length * cos(psi)), length * sin(psi), side
    ex, ey = bx - ax, by - ay
    part = min(max(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey), 0.0), 1.0)
    return ax + part * ex, ay + part * ey, -rate * part * ey, rate * part * ex


@numba.njit(cache=True)
def gap(body: int, x: float, y: float, psi: float, d: float, length: float, radius: float):
    px, py, _, _ = nearest(body, x, y, psi, d, length)
    return hypot(x - px, y - py) - radius


@numba.njit(cache=True)
def carried(x: float, y: float, psi: float, last: float, hand, e: float, step: float, vx: float = 0.0, vy: float = 0.0):
    """Centre, velocity and count of impacts when the fingers stand at ``last``; hand = (D, L, R)."""
    d, length, radius = hand
    hits, left = 0, 0.0
    while psi < last:
        left = step if left <= 0.0 else left
        # A fast disk must not pass through a line between two looks.
        left = min(left, last - psi, 0.2 * radius / (hypot(vx, vy) + length))
        for _ in range(20):
            struck = False
            for body in range(3):
                px, py, ux, uy = nearest(body, x, y, psi, d, length)
                away = hypot(x - px, y - py)
                nx, ny = (x - px) / away, (y - py) / away
                speed = (vx - ux) * nx + (vy - uy) * ny
                if away - radius <= 1e-12 * length and speed < -1e-12 * length:
                    bounce = e if speed < -1e-7 * length else 0.0
                    vx -= (1.0 + bounce) * speed * nx
                    vy -= (1.0 + bounce) * speed * ny
                    x += max(radius - away, 0.0) * nx
                    y += max(radius - away, 0.0) * ny
                    struck = True
                    hits += 1
            if not struck:
                break
        part = left
        for body in range(3):
            if gap(body, x + part * vx, y + part * vy, psi + part, d, length, radius) < -DEPTH * length:
                low, high = 0.0, part
                while high - low > 1e-13 and high > low:
                    middle = 0.5 * (low + high)
                    deep = gap(body, x + middle * vx, y + middle * vy, psi + middle, d, length, radius)
                    if deep < -DEPTH * length:
                        high = middle
                    else:
                        low = middle
                        if deep < 0.0:
                            break
                part = max(low, 1e-9)
        x, y, psi, left = x + part * vx, y + part * vy, psi + part, left - part
    return x, y, vx, vy, hits


@numba.njit(cache=True)
def _many(starts, first, last, hand, e, step, ends):
    for i in range(len(starts)):
        x, y, vx, vy, hits = carried(starts[i, 0], starts[i, 1], first, last, hand, e, step, starts[i, 2], starts[i, 3])
        ends[i, 0], ends[i, 1], ends[i, 2], ends[i, 3], ends[i, 4] = x, y, vx, vy, hits


def verdict_angle(d: float, length: float, radius: float) -> float:
    """Finger angle at which the tips stand 2 R apart: who is below their line then cannot leave any more."""
    return acos(-(d - radius) / length)


def caught(
    starts: np.ndarray, d: float, length: float, radius: float, e: float, opening: float = 0.0, step: float = STEP
):
    """For each start (N, 2), or with velocity (N, 4): whether it is between palm, fingers and tip line at the verdict."""
    last = verdict_angle(d, length, radius)
    ends = np.empty((len(starts), 5))
    full = np.zeros((len(starts), 4))
    full[:, : starts.shape[1]] = starts
    _many(full, opening, last, (d, length, radius), e, step, ends)
    x, y = np.abs(ends[:, 0]), ends[:, 1]
    # Inside of the right finger's line: the distance along its normal is positive.
    inside = -(x - d) * sin(last) + y * cos(last) > 0.0
    return (y > 0.0) & (y < length * sin(last)) & inside, ends
