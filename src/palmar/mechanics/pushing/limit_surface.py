"""One limit surface of any kind, as the kernels take it: motion -> friction, and friction -> motion.

Friction force is scaled to 1 for a translation (mu m g = 1): quasi-static motion does not depend on that scale.
The power lost at the twist nu is Phi(nu), convex and of degree 1; the wrench is its gradient W. Two metrics B satisfy
B nu = W: the secant metric, a majoriser of Phi, and the tangent metric, the Hessian of Phi^2/2 over Phi. Solving with
the metric of the last guess for the next is a descent (secant) or Newton's method (tangent).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing import ellipsoid, sampled_pressure, uniform_disk, uniform_polygon
from palmar.mechanics.pushing.metric import Metric, Triple, inverse, squared, times
from palmar.mechanics.pushing.pressure_cells import Cells, triangle_rule

Floats = NDArray[np.float64]
ELLIPSOID, UNIFORM_DISK, UNIFORM_POLYGON, SAMPLED = 0, 1, 2, 3


class LimitSurface(NamedTuple):
    """The kind, a length c (m): largest moment over largest force, and what the kind needs (else empty arrays)."""

    kind: int
    length: float
    edges: Floats
    points: Floats
    weights: Floats
    spreads: Floats


_NONE, _NO_POINTS, _NO_EDGES = np.empty(0), np.empty((0, 2)), np.empty((0, 5))


def ellipsoid_surface(length: float) -> LimitSurface:
    """Ellipsoid with c = ``length`` (m) about the centre of pressure."""
    return LimitSurface(ELLIPSOID, float(length), _NO_EDGES, _NO_POINTS, _NONE, _NONE)


def disk_surface(radius: float) -> LimitSurface:
    """Uniform disk of ``radius`` (m) about its centre, exact."""
    return LimitSurface(UNIFORM_DISK, 2.0 * float(radius) / 3.0, _NO_EDGES, _NO_POINTS, _NONE, _NONE)


def polygon_surface(vertices: ArrayLike) -> LimitSurface:
    """Uniform convex polygon, counter-clockwise ``vertices`` (V, 2) in m about the reference point, exact."""
    corners = np.ascontiguousarray(vertices, dtype=float)
    points, weights, spreads = triangle_rule(corners)
    edges = uniform_polygon.outline(corners)
    length = float(uniform_polygon.means_about(edges, 0.0, 0.0)[0])
    return LimitSurface(UNIFORM_POLYGON, length, edges, points, weights, spreads)


def sampled_surface(cells: Cells) -> LimitSurface:
    """Pressure on points about the reference point: points (N, 2) in m, weights (N,) with sum 1, spreads (N,) in m."""
    points, weights, spreads = (np.ascontiguousarray(each, dtype=float) for each in cells)
    length = float(np.sqrt(points[:, 0] ** 2 + points[:, 1] ** 2 + spreads**2) @ weights)
    return LimitSurface(SAMPLED, length, _NO_EDGES, points, weights, spreads)


@inlined
def tangent_metric(surface: LimitSurface, vx: float, vy: float, omega: float) -> Metric:
    """Hessian of Phi^2/2 over Phi at a twist that is not zero."""
    if surface.kind == ELLIPSOID:
        return ellipsoid.metric_of(surface.length, vx, vy, omega)
    if surface.kind == UNIFORM_DISK:
        return uniform_disk.tangent_metric(1.5 * surface.length, vx, vy, omega)
    if _near(surface, vx, vy, omega):
        return uniform_polygon.tangent_metric(surface.edges, vx, vy, omega)
    return sampled_pressure.tangent_metric(surface.points, surface.weights, surface.spreads, vx, vy, omega)


@compiled
def secant_metric(surface: LimitSurface, vx: float, vy: float, omega: float) -> Metric:
    """Integral of J^T J / |velocity| over the pressure, at a twist that is not zero."""
    if surface.kind == ELLIPSOID:
        return ellipsoid.metric_of(surface.length, vx, vy, omega)
    if surface.kind == UNIFORM_DISK:
        return uniform_disk.secant_metric(1.5 * surface.length, vx, vy, omega)
    if _near(surface, vx, vy, omega):
        return uniform_polygon.secant_metric(surface.edges, vx, vy, omega)
    return sampled_pressure.secant_metric(surface.points, surface.weights, surface.spreads, vx, vy, omega)


@inlined
def _near(surface: LimitSurface, vx: float, vy: float, omega: float) -> bool:
    """Whether the closed form of the polygon is to be used: the centre of rotation is not far away."""
    if surface.kind != UNIFORM_POLYGON:
        return False
    reach = uniform_polygon.FAR * surface.length * abs(omega)
    return vx * vx + vy * vy < reach * reach


@compiled
def wrench(surface: LimitSurface, vx: float, vy: float, omega: float) -> Triple:
    """Friction overcome (fx, fy, moment) at a twist, total friction force 1; zero at rest, where it is undetermined."""
    if vx == 0.0 and vy == 0.0 and omega == 0.0:
        return 0.0, 0.0, 0.0
    return times(secant_metric(surface, vx, vy, omega), vx, vy, omega)


@compiled
def twist(surface: LimitSurface, fx: float, fy: float, moment: float) -> Triple:
    """The motion nu under a wrench, scaled so that the wrench is Phi(nu) W(nu); Phi(nu) > 1 if it is overloaded.

    nu minimises Phi^2/2 - wrench . nu: Newton's method, and a secant step (a descent for certain) where that fails.
    """
    c = surface.length
    if fx == 0.0 and fy == 0.0 and moment == 0.0:
        return 0.0, 0.0, 0.0
    x, y, w = fx, fy, moment / (c * c)
    for _ in range(200):
        value = 0.5 * _power(surface, x, y, w) ** 2 - (fx * x + fy * y + moment * w)
        nx, ny, nw = _newton_point(surface, x, y, w, fx, fy, moment, value)
        change = abs(nx - x) + abs(ny - y) + c * abs(nw - w)
        x, y, w = nx, ny, nw
        if change <= 1e-13 * (abs(x) + abs(y) + c * abs(w)):
            break
    return x, y, w


@compiled
def _newton_point(
    surface: LimitSurface, x: float, y: float, w: float, fx: float, fy: float, moment: float, value: float
) -> Triple:
    """The next iterate from (x, y, w) with the objective ``value``: along Newton's step if it descends, else secant."""
    scale = 1.0 / _power(surface, x, y, w)
    gx, gy, gw = times(inverse(tangent_metric(surface, x, y, w)), fx * scale, fy * scale, moment * scale)
    step = 1.0
    for _ in range(4):
        tx, ty, tw = x + step * (gx - x), y + step * (gy - y), w + step * (gw - w)
        if 0.5 * _power(surface, tx, ty, tw) ** 2 - (fx * tx + fy * ty + moment * tw) <= value:
            return tx, ty, tw
        step *= 0.25
    return times(inverse(secant_metric(surface, x, y, w)), fx * scale, fy * scale, moment * scale)


@compiled
def _power(surface: LimitSurface, x: float, y: float, w: float) -> float:
    return squared(secant_metric(surface, x, y, w), x, y, w)
