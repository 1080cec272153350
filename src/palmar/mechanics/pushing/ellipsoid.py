"""Ellipsoidal limit surface: f_x^2 + f_y^2 + (moment / c)^2 = 1, with c the largest moment over the largest force.

It approximates the friction of a patch whose centre of pressure is the reference point; the metric is constant up to
scale, so a contact problem on it is solved in one step. For the uniform disk c = 2R/3. The exact load of that disk
differs from this ellipsoid's by up to 5 % along a given direction of load.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.metric import Metric, Triple

Floats = NDArray[np.float64]


@compiled
def metric_of(c: float, vx: float, vy: float, omega: float) -> Metric:
    """diag(1, 1, c^2) over the power lost at this twist (not zero): secant and tangent metric in one."""
    scale = 1.0 / sqrt(vx * vx + vy * vy + (c * omega) ** 2)
    return scale, 0.0, scale, 0.0, 0.0, c * c * scale


@compiled
def wrench(c: float, vx: float, vy: float, omega: float) -> Triple:
    """Friction overcome at the twist (vx, vy, omega), not zero; on the unit ellipsoid."""
    scale = 1.0 / sqrt(vx * vx + vy * vy + (c * omega) ** 2)
    return vx * scale, vy * scale, c * c * omega * scale


@compiled
def twist(c: float, fx: float, fy: float, moment: float) -> Triple:
    """The motion, up to scale, under a wrench; its power lost is the factor by which the wrench exceeds the surface."""
    return fx, fy, moment / (c * c)


def characteristic_length(points: Floats, weights: Floats) -> float:
    """c = moment about the reference point when the object only turns, for pressure at points (N, 2), weights (N,)."""
    return float(np.hypot(points[:, 0], points[:, 1]) @ weights)
