"""Why force fed back to a lagging drive goes unstable: section 4.3.2, after Eppinger.

A finger of mass m (at the contact) with damping b presses on something through a contact of stiffness k, F = k x. The
naive controller asks the drive for f + g (f - F), and the drive follows with a lag T:

    m x'' + b x' + k x = u,    T u' + u = f + g (f - k x).

Its characteristic polynomial T m s^3 + (m + T b) s^2 + (b + T k) s + k (1 + g) has positive coefficients, and by Routh
and Hurwitz all roots are to the left if and only if (m + T b)(b + T k) > T m k (1 + g):

    g < b / (T k) + T b / m + b^2 / (m k).

In w_n = sqrt(k / m), zeta = b / (2 sqrt(k m)) and the lag l = T w_n that is g < 2 zeta (1 / l + l + 2 zeta): without
damping no gain is stable, whatever the lag, and the worst lag is one over w_n, where the gain stays below
4 zeta (1 + zeta). At the limit the finger hammers at sqrt((b + T k) / (T m)).

Functions broadcast; SI.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def characteristic_polynomial(
    gain: ArrayLike, mass: ArrayLike, damping: ArrayLike, stiffness: ArrayLike, lag: ArrayLike
) -> Floats:
    """Coefficients of s^3, s^2, s, 1 along the last axis."""
    g, m, b, k, t = _together(gain, mass, damping, stiffness, lag)
    return np.stack([t * m, m + t * b, b + t * k, k * (1.0 + g)], axis=-1)


def gain_limit(mass: ArrayLike, damping: ArrayLike, stiffness: ArrayLike, lag: ArrayLike) -> Floats:
    """Force gain below which the loop is stable."""
    m, b, k, t = _together(mass, damping, stiffness, lag)
    return np.asarray(b / (t * k) + t * b / m + b**2 / (m * k))


def worst_lag(mass: ArrayLike, stiffness: ArrayLike) -> Floats:
    """The lag (s) that allows the least gain: sqrt(m / k)."""
    m, k = _together(mass, stiffness)
    return np.sqrt(m / k)


def hammering(mass: ArrayLike, damping: ArrayLike, stiffness: ArrayLike, lag: ArrayLike) -> Floats:
    """Angular frequency (rad/s) of the oscillation that neither grows nor decays at the limit."""
    m, b, k, t = _together(mass, damping, stiffness, lag)
    return np.sqrt((b + t * k) / (t * m))


def _together(*values: ArrayLike) -> tuple[Floats, ...]:
    return np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in values))
