"""The closest points of two segments."""

from __future__ import annotations

from math import hypot, inf, sqrt

from palmar.mechanics.compiled import compiled, inlined


@inlined
def length_of(x: float, y: float) -> float:
    """Length of (x, y); the library's hypot takes as long as all else once kernels come from the cache."""
    return sqrt(x * x + y * y)


@inlined
def nearest_on(ax: float, ay: float, bx: float, by: float, x: float, y: float) -> tuple[float, float]:
    """The point of the segment a-b that is nearest to (x, y)."""
    dx, dy = bx - ax, by - ay
    along = min(max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
    return ax + along * dx, ay + along * dy


@compiled
def closest_points(
    ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float
) -> tuple[float, float, float, float, float]:
    """(distance, point of a-b, point of c-d); where they cross, 0 and the crossing point twice."""
    ux, uy, wx, wy = bx - ax, by - ay, dx - cx, dy - cy
    cross = ux * wy - uy * wx
    if cross != 0.0:
        s = ((cx - ax) * wy - (cy - ay) * wx) / cross
        r = ((cx - ax) * uy - (cy - ay) * ux) / cross
        if 0.0 <= s <= 1.0 and 0.0 <= r <= 1.0:
            return 0.0, ax + s * ux, ay + s * uy, ax + s * ux, ay + s * uy
    best, px, py, qx, qy = inf, ax, ay, cx, cy
    for k in range(4):
        if k < 2:
            fx, fy = (cx, cy) if k == 0 else (dx, dy)
            ex, ey = nearest_on(ax, ay, bx, by, fx, fy)
        else:
            ex, ey = (ax, ay) if k == 2 else (bx, by)
            fx, fy = nearest_on(cx, cy, dx, dy, ex, ey)
        apart = hypot(fx - ex, fy - ey)
        if apart < best:
            best, px, py, qx, qy = apart, ex, ey, fx, fy
    return best, px, py, qx, qy
