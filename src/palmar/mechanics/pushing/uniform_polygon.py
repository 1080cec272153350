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

from math import log, sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.metric import Metric, with_load

Floats = NDArray[np.float64]
Means = tuple[float, float, float, float, float, float, float]
FAR = 60.0
"""Centres of rotation beyond this many characteristic lengths are left to sampled points."""


def outline(vertices: Floats) -> Floats:
    """Per edge of the counter-clockwise ``vertices`` (V, 2): begin (x, y), direction (x, y), length; (V, 5)."""
    begin = np.roll(vertices, 1, axis=0)
    edges = vertices - begin
    lengths = np.hypot(edges[:, :1], edges[:, 1:])
    return np.ascontiguousarray(np.hstack([begin, edges / lengths, lengths]))


@compiled
def means_about(edges: Floats, cx: float, cy: float) -> Means:
    """Means over the polygon: distance from c, unit vector from c (x, y), 1/distance, and the Hessian of the first.

    ``edges`` as from ``outline``; returns (D, gx, gy, inverse distance, D_xx, D_xy, D_yy).
    """
    distance, gx, gy, inverse, xx, xy, yy, area = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    x, y = edges[0, 0] - cx, edges[0, 1] - cy
    r1 = sqrt(x * x + y * y)
    for i in range(len(edges)):
        x, y, tx, ty, length = edges[i, 0] - cx, edges[i, 1] - cy, edges[i, 2], edges[i, 3], edges[i, 4]
        d, s1 = x * ty - y * tx, x * tx + y * ty
        s2 = s1 + length
        r2 = sqrt(d * d + s2 * s2)
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
        r1 = r2
    share = 1.0 / area
    return distance * share, gx * share, gy * share, inverse * share, xx * share, xy * share, yy * share


@compiled
def secant_metric(edges: Floats, vx: float, vy: float, omega: float) -> Metric:
    """Integral of J^T J / |velocity| over the polygon, about the outline's origin; omega is not zero."""
    cx, cy = -vy / omega, vx / omega
    distance, gx, gy, inverse, _, _, _ = means_about(edges, cx, cy)
    x, y = gx + cx * inverse, gy + cy * inverse
    square = distance + gx * cx + gy * cy + cx * x + cy * y
    scale = 1.0 / abs(omega)
    return inverse * scale, 0.0, inverse * scale, -y * scale, x * scale, square * scale


@compiled
def tangent_metric(edges: Floats, vx: float, vy: float, omega: float) -> Metric:
    """Hessian of Phi^2 / 2, divided by Phi, about the outline's origin; omega is not zero."""
    cx, cy = -vy / omega, vx / omega
    distance, gx, gy, _, c_xx, c_xy, c_yy = means_about(edges, cx, cy)
    scale, sign = 1.0 / abs(omega), 1.0 if omega > 0.0 else -1.0
    xx, xy, yy = c_yy * scale, -c_xy * scale, c_xx * scale  # the centre moves by a quarter turn of v / omega
    ux, uy = vx / omega, vy / omega
    xw, yw = -(xx * ux + xy * uy), -(xy * ux + yy * uy)
    hessian = xx, xy, yy, xw, yw, -(xw * ux + yw * uy)
    moment = distance + gx * cx + gy * cy
    return with_load(hessian, -sign * gy, sign * gx, sign * moment, distance * abs(omega))
