"""Why force fed back to a lagging drive goes unstable: section 4.3.2, after Eppinger.

A finger of mass m (at the contact) presses on something through a contact of stiffness k and damping c, and the sensor feels
F = k x + c x'. The naive controller asks the drive for f + g (f - F), and the drive follows with a lag T:

    m x'' + F = u,    T u' + u = f + g (f - F).

Its characteristic polynomial T m s^3 + (m + T c) s^2 + (T k + c (1 + g)) s + k (1 + g) has positive coefficients, and by
Routh and Hurwitz all roots are to the left if and only if (m + T c)(T k + c (1 + g)) > T m k (1 + g):

    1 + g < T k (m + T c) / (T m k - c m - T c^2),    or any g where the denominator is not positive.

In w_n = sqrt(k / m), zeta = c / (2 sqrt(k m)) and the lag l = T w_n that is

    1 + g < l (1 + 2 zeta l) / (l - 2 zeta - 4 zeta^2 l):

without damping no gain is stable, whatever the lag; the worst lag is 1 / ((1 - 2 zeta) w_n), where 1 + g stays below
1 / (1 - 2 zeta)^2; from zeta = 1/2 on every gain is stable. At the limit the finger hammers at
sqrt((T k + c (1 + g)) / (T m)).

Functions broadcast; SI.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def characteristic_polynomial(
    gain: ArrayLike, mass: ArrayLike, damping: ArrayLike, stiffness: ArrayLike, lag: ArrayLike
) -> Floats:
    """Coefficients of s^3, s^2, s, 1 along the last axis."""
    g, m, c, k, t = _together(gain, mass, damping, stiffness, lag)
    return np.stack([t * m, m + t * c, t * k + c * (1.0 + g), k * (1.0 + g)], axis=-1)


def gain_limit(mass: ArrayLike, damping: ArrayLike, stiffness: ArrayLike, lag: ArrayLike) -> Floats:
    """Force gain below which the loop is stable; inf where it always is."""
    m, c, k, t = _together(mass, damping, stiffness, lag)
    rest = t * m * k - c * m - t * c * c
    # As T k (m + T c) / rest - 1 the small gains of light damping would cancel.
    return np.where(rest > 0.0, c * (t * t * k + m + t * c) / np.where(rest > 0.0, rest, 1.0), inf)


def worst_lag(mass: ArrayLike, damping: ArrayLike, stiffness: ArrayLike) -> Floats:
    """The lag (s) that allows the least gain; inf where every gain is stable at any lag."""
    m, c, k = _together(mass, damping, stiffness)
    natural = np.sqrt(k / m)
    rest = 1.0 - c / np.sqrt(k * m)
    return np.where(rest > 0.0, 1.0 / (natural * np.where(rest > 0.0, rest, 1.0)), inf)


def hammering(mass: ArrayLike, damping: ArrayLike, stiffness: ArrayLike, lag: ArrayLike) -> Floats:
    """Angular frequency (rad/s) of the oscillation that neither grows nor decays at the limit; inf without one."""
    m, c, k, t = _together(mass, damping, stiffness, lag)
    return np.sqrt((t * k + c * (1.0 + gain_limit(m, c, k, t))) / (t * m))


def _together(*values: ArrayLike) -> tuple[Floats, ...]:
    return np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in values))
