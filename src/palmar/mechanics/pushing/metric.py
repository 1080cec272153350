"""A metric: the symmetric positive definite 3x3 matrix that maps an object's twist to the friction it overcomes.

A twist is (vx, vy, omega), a wrench (fx, fy, moment), both about the same reference point of the object. The entries
are kept as a tuple (xx, xy, yy, xw, yw, ww), w standing for omega: kernels pass them without allocating.
"""

from __future__ import annotations

from palmar.mechanics.compiled import inlined

Metric = tuple[float, float, float, float, float, float]
Triple = tuple[float, float, float]


@inlined
def times(metric: Metric, x: float, y: float, w: float) -> Triple:
    """metric @ (x, y, w)."""
    xx, xy, yy, xw, yw, ww = metric
    return xx * x + xy * y + xw * w, xy * x + yy * y + yw * w, xw * x + yw * y + ww * w


@inlined
def squared(metric: Metric, x: float, y: float, w: float) -> float:
    """(x, y, w) metric (x, y, w)."""
    fx, fy, moment = times(metric, x, y, w)
    return fx * x + fy * y + moment * w


@inlined
def inverse(metric: Metric) -> Metric:
    """The inverse matrix, by cofactors."""
    xx, xy, yy, xw, yw, ww = metric
    c_xx, c_xy, c_xw = yy * ww - yw * yw, xw * yw - xy * ww, xy * yw - xw * yy
    scale = 1.0 / (xx * c_xx + xy * c_xy + xw * c_xw)
    c_yy, c_yw, c_ww = xx * ww - xw * xw, xy * xw - xx * yw, xx * yy - xy * xy
    return c_xx * scale, c_xy * scale, c_yy * scale, c_xw * scale, c_yw * scale, c_ww * scale


@inlined
def with_load(hessian: Metric, fx: float, fy: float, moment: float, power: float) -> Metric:
    """Hessian of power^2 / 2 divided by power, from the Hessian and the gradient (fx, fy, moment) of the power."""
    xx, xy, yy, xw, yw, ww = hessian
    gx, gy, gw = fx / power, fy / power, moment / power
    return xx + fx * gx, xy + fx * gy, yy + fy * gy, xw + fx * gw, yw + fy * gw, ww + moment * gw
