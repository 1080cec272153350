"""Limit surface of a convex polygon with uniform pressure, exact.

With the centre of rotation at c, the power lost to friction is |omega| times the mean distance D(c) of c from the
polygon's points, and force and moment follow from D and its gradient. All are sums over the edges: for an edge at
distance d from c (positive inside) with outward normal n, direction t, ends at s1, s2 along t and r1, r2 from c,

    L = ln((r2 + s2) / (r1 + s1)),  I = (s2 r2 - s1 r1 + d^2 L) / 2,
    int rho dA = sum d I / 3,  int (p - c)/rho dA = sum n I,  int dA/rho = sum d L,
    d/dc of the second integral, negated = sum n (t (r2 - r1) + n d L)^T.

For a centre of rotation far away these sums cancel; there the integrand is smooth, and points are exact.
Derived in docs/derivations/limit_surface.md.
"""

from __future__ import annotations

from math import hypot, log

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.compiled import compiled
from palmar.mechanics.pushing.metric import Metric, with_load

Floats = NDArray[np.float64]
Means = tuple[float, float, float, float, float, float, float]
FAR = 60.0
"""Centres of rotation beyond this many characteristic lengths are left to sampled points."""


@compiled
def means_about(vertices: Floats, cx: float, cy: float) -> Means:
    """Means over the polygon: distance from c, unit vector from c (x, y), 1/distance, and the Hessian of the first.

    ``vertices`` (V, 2) counter-clockwise; returns (D, gx, gy, inverse distance, D_xx, D_xy, D_yy).
    """
    distance, gx, gy, inverse, xx, xy, yy, area = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    last = len(vertices) - 1
    x1, y1 = vertices[last, 0] - cx, vertices[last, 1] - cy
    r1 = hypot(x1, y1)
    for i in range(len(vertices)):
        x2, y2 = vertices[i, 0] - cx, vertices[i, 1] - cy
        r2, length = hypot(x2, y2), hypot(x2 - x1, y2 - y1)
        tx, ty = (x2 - x1) / length, (y2 - y1) / length
        d, s1, s2 = x1 * ty - y1 * tx, x1 * tx + y1 * ty, x2 * tx + y2 * ty
        short = r1 + r2 - length
        d_log = d * log((r1 + r2 + length) / short) if short > 0.0 else 0.0
        along = 0.5 * (s2 * r2 - s1 * r1 + d * d_log)
        area += 0.5 * d * length
        distance += d * along / 3.0
        inverse += d_log
        gx, gy = gx + ty * along, gy - tx * along
        xx += ty * (tx * (r2 - r1) + ty * d_log)
        xy += ty * (ty * (r2 - r1) - tx * d_log)
        yy -= tx * (ty * (r2 - r1) - tx * d_log)
        x1, y1, r1 = x2, y2, r2
    return distance / area, gx / area, gy / area, inverse / area, xx / area, xy / area, yy / area


@compiled
def secant_metric(vertices: Floats, vx: float, vy: float, omega: float) -> Metric:
    """Integral of J^T J / |velocity| over the polygon, about the vertices' origin; omega is not zero."""
    cx, cy = -vy / omega, vx / omega
    distance, gx, gy, inverse, _, _, _ = means_about(vertices, cx, cy)
    x, y = gx + cx * inverse, gy + cy * inverse
    square = distance + gx * cx + gy * cy + cx * x + cy * y
    scale = 1.0 / abs(omega)
    return inverse * scale, 0.0, inverse * scale, -y * scale, x * scale, square * scale


@compiled
def tangent_metric(vertices: Floats, vx: float, vy: float, omega: float) -> Metric:
    """Hessian of Phi^2 / 2, divided by Phi, about the vertices' origin; omega is not zero."""
    cx, cy = -vy / omega, vx / omega
    distance, gx, gy, _, c_xx, c_xy, c_yy = means_about(vertices, cx, cy)
    scale, sign = 1.0 / abs(omega), 1.0 if omega > 0.0 else -1.0
    xx, xy, yy = c_yy * scale, -c_xy * scale, c_xx * scale  # the centre moves by a quarter turn of v / omega
    ux, uy = vx / omega, vy / omega
    xw, yw = -(xx * ux + xy * uy), -(xy * ux + yy * uy)
    hessian = xx, xy, yy, xw, yw, -(xw * ux + yw * uy)
    moment = distance + gx * cx + gy * cy
    return with_load(hessian, -sign * gy, sign * gx, sign * moment, distance * abs(omega))
