"""Force of an impact through a soft contact: section 4.3.2, after Johnson (energy) and Kahng and Amirouche (damping).

Two bodies of reduced mass M approach at the speed v and touch through a spring, alone or beside a damper. With the
compression d, M d'' + c d' + k d = 0 from d = 0, d' = v; w_n = sqrt(k / M), zeta = c / (2 sqrt(k M)),
theta = arccos zeta. The force F = k d + c d' = -M d'' is, for zeta < 1,

    F(t) = v sqrt(k M) e^(-zeta w_n t) sin(2 theta - w_d t) / sin theta,      w_d = w_n sin theta,

and never pulls: contact ends at F = 0. From it follow the peak, the duration and the restitution below. A power law
F = k d^n (n = 3/2 for spheres after Hertz) has the peak and the duration that its energy gives.

Functions broadcast; SI. Both bodies are rigid but for the contact: contact lasts long against their own vibrations.
"""

from __future__ import annotations

from math import inf, pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
HALVINGS = 80


def effective_mass(mass: ArrayLike, distance: ArrayLike = 0.0, finger_inertia: ArrayLike = inf) -> Floats:
    """M = 1 / (1 / m + X^2 / I) (kg) of a disk and a finger (kg m^2 about its joint) struck at X (m); m if it is heavy."""
    m, x, inertia = _together(mass, distance, finger_inertia)
    return np.asarray(1.0 / (1.0 / m + x**2 / inertia))


def peak_force(mass: ArrayLike, speed: ArrayLike, stiffness: ArrayLike, damping_ratio: ArrayLike = 0.0) -> Floats:
    """Largest contact force (N): v sqrt(k M) times ``peak_factor``; ``mass`` is the effective one."""
    m, v, k, zeta = _together(mass, speed, stiffness, damping_ratio)
    return np.asarray(v * np.sqrt(k * m) * peak_factor(zeta))


def peak_factor(damping_ratio: ArrayLike) -> Floats:
    """Peak over that of the spring alone: exp(-zeta (3 theta - pi) / sin theta) up to zeta = 1/2, from there 2 zeta.

    F' = 0 at w_d t = 3 theta - pi; a contact damped more than by half is hardest at the first touch, F(0) = c v.
    """
    zeta = np.asarray(damping_ratio, dtype=float)
    light = np.minimum(zeta, 0.5)
    theta = np.arccos(light)
    return np.where(zeta < 0.5, np.exp(-light * (3.0 * theta - pi) / np.sin(theta)), 2.0 * zeta)


def contact_duration(mass: ArrayLike, stiffness: ArrayLike, damping_ratio: ArrayLike = 0.0) -> Floats:
    """Time (s) to F = 0: 2 theta / w_d; pi sqrt(M / k) for the spring alone."""
    m, k, zeta = _together(mass, stiffness, damping_ratio)
    return np.asarray(2.0 * np.sqrt(m / k) * _turn(zeta))


def restitution(damping_ratio: ArrayLike) -> Floats:
    """e = exp(-2 zeta theta / sin theta): what such a contact gives back of the approach speed."""
    zeta = np.asarray(damping_ratio, dtype=float)
    return np.exp(-2.0 * zeta * _turn(zeta))


def damping_ratio_for(wanted: ArrayLike) -> Floats:
    """The zeta whose ``restitution`` is the one wanted; it falls monotonically from 1 and never reaches 0 (inf)."""
    given = np.asarray(wanted, dtype=float)
    e = np.maximum(given, 1e-12)
    low, high = np.zeros(e.shape), np.full(e.shape, 1.0)
    while np.any(restitution(high) > e):
        high = 2.0 * high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        above = restitution(middle) > e
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    return np.where(given > 0.0, 0.5 * (low + high), inf)


def _turn(zeta: Floats) -> Floats:
    """theta / sin theta = arccos(zeta) / sqrt(1 - zeta^2), beyond zeta = 1 arcosh(zeta) / sqrt(zeta^2 - 1)."""
    near = np.abs(zeta - 1.0) < 1e-6
    light, heavy = np.where(near, 0.0, np.minimum(zeta, 1.0)), np.where(near, 2.0, np.maximum(zeta, 1.0))
    under = np.arccos(light) / np.where(light < 1.0, np.sqrt(1.0 - light**2), 1.0)
    over = np.arccosh(heavy) / np.where(heavy > 1.0, np.sqrt(heavy**2 - 1.0), 1.0)
    return np.where(near, 1.0 - (zeta - 1.0) / 3.0, np.where(zeta < 1.0, under, over))


def compression(mass: ArrayLike, speed: ArrayLike, stiffness: ArrayLike, damping_ratio: ArrayLike = 0.0) -> Floats:
    """Greatest compression (m), which a pad's thickness must allow: (v / w_n) exp(-zeta theta / sin theta)."""
    m, v, k, zeta = _together(mass, speed, stiffness, damping_ratio)
    return np.asarray(v * np.sqrt(m / k) * np.exp(-zeta * _turn(zeta)))


def stiffness_for(force_limit: ArrayLike, mass: ArrayLike, speed: ArrayLike, damping_ratio: ArrayLike = 0.0) -> Floats:
    """Stiffness (N/m) of the whole contact that keeps the peak at the limit (N): F^2 / (M v^2 peak_factor^2)."""
    force, m, v, zeta = _together(force_limit, mass, speed, damping_ratio)
    return np.asarray((force / (v * peak_factor(zeta))) ** 2 / m)


def pad_stiffness(whole: ArrayLike, bare: ArrayLike) -> Floats:
    """Stiffness (N/m) of a pad before a contact of stiffness ``bare`` that makes it ``whole``; inf where none is needed."""
    k, hard = _together(whole, bare)
    needed = k < hard
    return np.where(needed, k * hard / np.where(needed, hard - k, 1.0), inf)


def power_law_peak(mass: ArrayLike, speed: ArrayLike, stiffness: ArrayLike, exponent: ArrayLike = 1.5) -> Floats:
    """Peak (N) of F = k d^n from M v^2 / 2 = k d^(n+1) / (n + 1); k in N/m^n."""
    k, n = _together(stiffness, exponent)
    return np.asarray(k * power_law_compression(mass, speed, k, n) ** n)


def power_law_compression(mass: ArrayLike, speed: ArrayLike, stiffness: ArrayLike, exponent: ArrayLike = 1.5) -> Floats:
    """Greatest compression (m) under F = k d^n."""
    m, v, k, n = _together(mass, speed, stiffness, exponent)
    return np.asarray(((n + 1.0) * m * v**2 / (2.0 * k)) ** (1.0 / (n + 1.0)))


def power_law_duration(mass: ArrayLike, speed: ArrayLike, stiffness: ArrayLike, exponent: ArrayLike = 1.5) -> Floats:
    """Duration (s) under F = k d^n: 2 (d_max / v) int_0^1 dx / sqrt(1 - x^(n+1)); 2.94 d_max / v for n = 3/2."""
    from scipy.special import gamma

    v, n = _together(speed, exponent)
    share = 1.0 / (n + 1.0)
    integral = np.sqrt(pi) * gamma(1.0 + share) / gamma(0.5 + share)
    return np.asarray(2.0 * power_law_compression(mass, speed, stiffness, n) / v * integral)


def triggered_peak(
    mass: ArrayLike,
    freed_mass: ArrayLike,
    speed: ArrayLike,
    stiffness: ArrayLike,
    threshold: ArrayLike,
    delay: ArrayLike,
) -> Floats:
    """Peak force (N) where the driven finger is let go a ``delay`` (s) after the force has passed ``threshold`` (N).

    Until then the disk (``mass``) meets a finger that nothing slows, F = v sqrt(k m) sin w t; afterwards the finger
    yields, the effective mass is ``freed_mass``, and the energy left gives sqrt(F^2 + k M (v cos w t)^2). Nothing is fed
    back, so nothing can become unstable; after the quarter period it comes too late and the peak is v sqrt(k m).
    """
    m, freed, v, k, least, late = _together(mass, freed_mass, speed, stiffness, threshold, delay)
    hardest = v * np.sqrt(k * m)
    phase = np.arcsin(np.minimum(least / hardest, 1.0)) + late * np.sqrt(k / m)
    phase = np.minimum(phase, 0.5 * pi)
    return np.asarray(hardest * np.sqrt(np.sin(phase) ** 2 + freed / m * np.cos(phase) ** 2))


def _together(*values: ArrayLike) -> tuple[Floats, ...]:
    return np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in values))
