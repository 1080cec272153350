"""One impact of a disk with a finger: section 4.1.2, equations 4.5 to 4.7.

The finger is a uniform rod of mass m_f and length L that turns freely about its joint during the impact, moment of
inertia I = m_f L^2 / 3; the disk of mass m is struck without friction at distance X from the joint. v is the disk's
velocity along the finger's pushing normal, the component along the finger stays. Angular momentum about the joint and
the definition of restitution,

    I w' + m X v' = I w + m X v,        v' - X w' = e (X w - v),

give both rates after. All functions broadcast their arguments: m, kg, m/s, rad/s.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


class After(NamedTuple):
    """What an impact leaves: the disk's velocity (m/s) along the normal and the finger's rate (rad/s)."""

    speed: Floats
    rate: Floats


def finite_finger(
    distance: ArrayLike,
    rate: ArrayLike,
    speed: ArrayLike,
    mass: ArrayLike,
    finger_mass: ArrayLike,
    finger_length: ArrayLike,
    restitution: ArrayLike,
) -> After:
    """Equation 4.5 with the right sign: v' = [m_f L^2 (1 + e) X w + v (3 m X^2 - e m_f L^2)] / (m_f L^2 + 3 m X^2)."""
    x, w, v, m, mf, length, e = _together(distance, rate, speed, mass, finger_mass, finger_length, restitution)
    rod, disk = mf * length**2, 3.0 * m * x**2
    after = (rod * (1.0 + e) * x * w + v * (disk - e * rod)) / (rod + disk)
    # The rate from the same impulse: what the disk gains about the joint, the finger loses.
    lost = 3.0 * m * x * (1.0 + e) * (x * w - v) / (rod + disk)
    return After(after, w - lost)


def finite_finger_published(
    distance: ArrayLike,
    rate: ArrayLike,
    speed: ArrayLike,
    mass: ArrayLike,
    finger_mass: ArrayLike,
    finger_length: ArrayLike,
    restitution: ArrayLike,
) -> Floats:
    """Equation 4.5 as printed: v' = [m_f L^2 (1 + e) X w - v (3 m X^2 + e m_f L^2)] / (m_f L^2 + 3 m X^2).

    Erratum: the term 3 m X^2 v has the wrong sign. The two agree for m_f -> infinity and for v = 0; as m_f -> 0 the
    printed one turns a disk round, v' = -v, that meets a finger without any mass.
    """
    x, w, v, m, mf, length, e = _together(distance, rate, speed, mass, finger_mass, finger_length, restitution)
    rod, disk = mf * length**2, 3.0 * m * x**2
    return np.asarray((rod * (1.0 + e) * x * w - v * (disk + e * rod)) / (rod + disk))


def heavy_finger(distance: ArrayLike, rate: ArrayLike, speed: ArrayLike, restitution: ArrayLike) -> Floats:
    """Equation 4.6, the limit of a finger that nothing slows: v' = (1 + e) X w - e v (m/s)."""
    x, w, v, e = _together(distance, rate, speed, restitution)
    return np.asarray((1.0 + e) * x * w - e * v)


def at_rest(distance: ArrayLike, rate: ArrayLike, restitution: ArrayLike = 1.0) -> Floats:
    """Equation 4.7, a disk at rest before a heavy finger: v' = (1 + e) X w (m/s), for e = 1 twice the finger's speed.

    Erratum: 4.7 as printed lacks this factor of 2, which the source's own example uses.
    """
    return heavy_finger(distance, rate, 0.0, restitution)


def restored_restitution(
    distance: ArrayLike, mass: ArrayLike, finger_mass: ArrayLike, finger_length: ArrayLike, restitution: ArrayLike
) -> Floats:
    """Restitution that a heavy finger would need for the same v', where the drive restores the rate after each impact.

    (e I - m X^2) / (I + m X^2), never below 0: a disk that the restored finger catches up with again and again moves
    off with the finger.
    """
    x, m, mf, length, e = _together(distance, mass, finger_mass, finger_length, restitution)
    rod, disk = mf * length**2, 3.0 * m * x**2
    return np.asarray(np.maximum((e * rod - disk) / (rod + disk), 0.0))


def _together(*values: ArrayLike) -> tuple[Floats, ...]:
    return np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in values))
