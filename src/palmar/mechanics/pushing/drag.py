"""How one contact with friction drags a disk sideways: a single function for every hand, finger and friction.

Let the hand's surface at the contact move at u along the contact normal and at t u along the tangent, and let the
contact stick. The disk's pressure is symmetric about its centre, so the centre moves in the direction of the force; let
gamma be the angle between that and the normal. With k the speed of the disk's rim over that of its centre and
lambda(k) = friction moment / (R friction force) of the limit surface at that motion,

    tan gamma + k / cos gamma = t,      sin gamma = lambda(k).

No length and no friction enters: gamma = Gamma(t), rising, depends on the kind of pressure alone. A contact with
friction angle alpha slides where Gamma(t) > alpha, and then gamma = alpha. Derived in docs/derivations/tip_phase.md.
"""

from __future__ import annotations

from functools import lru_cache
from math import hypot, sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing import limit_surface
from palmar.mechanics.pushing.interpolation import between
from palmar.mechanics.pushing.limit_surface import (
    ELLIPSOID,
    UNIFORM_DISK,
    LimitSurface,
    disk_surface,
    ellipsoid_surface,
)

Floats = NDArray[np.float64]
NODES, FEWER_NODES = 2049, 513
"""Nodes of the table of a closed-form limit surface, and of one that is a sum over points."""


def drag_table(surface: LimitSurface, radius: float) -> Floats:
    """tan(Gamma) / t at equal steps of t / (1 + t) from 0 to 1, for a disk of ``radius`` (m) on this limit surface.

    The surface must be symmetric about the disk's centre. Closed-form surfaces are tabulated once.
    """
    if surface.kind in (UNIFORM_DISK, ELLIPSOID):
        return _closed_form_table(surface.kind, surface.length / radius)
    return _table(surface, radius, FEWER_NODES)


@lru_cache(maxsize=16)
def _closed_form_table(kind: int, length: float) -> Floats:
    return _table(disk_surface(1.0) if kind == UNIFORM_DISK else ellipsoid_surface(length), 1.0, NODES)


def _table(surface: LimitSurface, radius: float, nodes: int) -> Floats:
    ratios = np.empty(nodes)
    _fill(surface, float(radius), ratios)
    return ratios


@compiled
def _fill(surface: LimitSurface, radius: float, ratios: Floats) -> None:
    """Each node from the k at its t; at the ends the limits for t -> 0 and t -> infinity."""
    last = len(ratios) - 1
    for i in range(1, last):
        share = i / last
        t = share / (1.0 - share)
        k = _rim_speed(surface, radius, t)
        leaning = _moment_share(surface, radius, k)
        ratios[i] = leaning / sqrt(max(1.0 - leaning * leaning, 1e-300)) / t
    small = 1e-6
    ratios[0] = 1.0 / (1.0 + small / _moment_share(surface, radius, small))
    ratios[last] = 3.0 * (ratios[last - 1] - ratios[last - 2]) + ratios[last - 3]


@compiled
def _moment_share(surface: LimitSurface, radius: float, k: float) -> float:
    """lambda(k)."""
    fx, fy, moment = limit_surface.wrench(surface, 1.0, 0.0, k / radius)
    return moment / (radius * hypot(fx, fy))


@compiled
def _excess(surface: LimitSurface, radius: float, k: float, t: float) -> float:
    """Sideways speed of the disk's rim over what the hand's surface has; grows with k."""
    leaning = _moment_share(surface, radius, k)
    if leaning >= 1.0:
        return np.inf
    return (leaning + k) / sqrt(1.0 - leaning * leaning) - t


@compiled
def _rim_speed(surface: LimitSurface, radius: float, t: float) -> float:
    """k at which the contact sticks: false position in [0, t] (Illinois), halving while an end is infinite."""
    low, high = 0.0, t
    f_low, f_high = -t, _excess(surface, radius, t, t)
    for _ in range(200):
        k = 0.5 * (low + high) if f_high == np.inf else high - f_high * (high - low) / (f_high - f_low)
        f = _excess(surface, radius, k, t)
        if abs(f) <= 1e-14 * t or high - low <= 1e-15 * high:
            return k
        if f > 0.0:
            high, f_high, f_low = k, f, 0.5 * f_low
        else:
            low, f_low = k, f
            if f_high != np.inf:
                f_high *= 0.5
    return 0.5 * (low + high)


@compiled
def sticking_lean(table: Floats, t: float) -> float:
    """tan Gamma(t), t >= 0."""
    return t * between(table, t / (1.0 + t) * (len(table) - 1))


@compiled
def lean(table: Floats, friction: float, t: float) -> float:
    """tan gamma of a contact with this friction: sticking, or at the edge of its cone."""
    return min(sticking_lean(table, t), friction)


@compiled
def slipping_from(table: Floats, friction: float) -> float:
    """t from which the contact slides; by bisection in t / (1 + t)."""
    low, high = 0.0, 1.0 - 1e-12
    for _ in range(60):
        middle = 0.5 * (low + high)
        if sticking_lean(table, middle / (1.0 - middle)) < friction:
            low = middle
        else:
            high = middle
    return high / (1.0 - high)
