"""Limit surface of any pressure given on points: friction as the sum over points that each carry a share of the weight.

Point i stands at p_i from the reference point and carries the weight w_i (sum 1). It may stand for a small cell: its
spread s_i is the root of half the trace of the cell's covariance, and the speed averaged over the cell is taken as
sqrt(|v_i|^2 + (s_i omega)^2), right to second order in the cell's size. A spread of 0 is a true point. With a_i the
vector (v_i, s_i omega) and J_i its derivative with respect to the twist,

    power Phi = sum w_i |a_i|,   wrench = sum w_i J_i^T a_i / |a_i|,   secant metric M = sum w_i J_i^T J_i / |a_i|.

M is positive definite unless all weight sits in one true point. A true point at the very centre of rotation has
|a_i| = 0, and its friction can be anything up to w_i: there, and only there, |a_i| is replaced by 1e-9 of the twist's
size, which pins the point.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.metric import Metric, with_load

Floats = NDArray[np.float64]
PINNED = 1e-9


@compiled
def secant_metric(points: Floats, weights: Floats, spreads: Floats, vx: float, vy: float, omega: float) -> Metric:
    """M above, at a twist that is not zero; points (N, 2), weights and spreads (N,)."""
    total, x_sum, y_sum, ww = 0.0, 0.0, 0.0, 0.0
    for i in range(len(weights)):
        x, y = points[i, 0], points[i, 1]
        speed = _speed(x, y, spreads[i], vx, vy, omega)
        share = weights[i] / speed
        total += share
        x_sum += share * x
        y_sum += share * y
        ww += share * (x * x + y * y + spreads[i] ** 2)
    return total, 0.0, total, -y_sum, x_sum, ww


@compiled
def tangent_metric(points: Floats, weights: Floats, spreads: Floats, vx: float, vy: float, omega: float) -> Metric:
    """Hessian of Phi^2 / 2, divided by Phi, at a twist that is not zero."""
    total, x_sum, y_sum, ww = 0.0, 0.0, 0.0, 0.0
    xx, xy, yy, xw, yw, rr = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    fx, fy, moment, power = 0.0, 0.0, 0.0, 0.0
    for i in range(len(weights)):
        x, y, spread = points[i, 0], points[i, 1], spreads[i]
        speed = _speed(x, y, spread, vx, vy, omega)
        weight = weights[i]
        share = weight / speed
        gx, gy = (vx - omega * y) / speed, (vy + omega * x) / speed
        gw = x * gy - y * gx + spread * spread * omega / speed
        fx, fy, moment, power = fx + weight * gx, fy + weight * gy, moment + weight * gw, power + weight * speed
        total, x_sum, y_sum = total + share, x_sum + share * x, y_sum + share * y
        ww += share * (x * x + y * y + spread * spread)
        xx, xy, yy = xx + share * gx * gx, xy + share * gx * gy, yy + share * gy * gy
        xw, yw, rr = xw + share * gx * gw, yw + share * gy * gw, rr + share * gw * gw
    hessian = total - xx, -xy, total - yy, -y_sum - xw, x_sum - yw, ww - rr
    return with_load(hessian, fx, fy, moment, power)


@compiled
def _speed(x: float, y: float, spread: float, vx: float, vy: float, omega: float) -> float:
    """|a_i|, kept off zero."""
    ux, uy, turning = vx - omega * y, vy + omega * x, spread * omega
    least = PINNED * (abs(vx) + abs(vy) + abs(omega) * sqrt(x * x + y * y))
    return max(sqrt(ux * ux + uy * uy + turning * turning), least)
