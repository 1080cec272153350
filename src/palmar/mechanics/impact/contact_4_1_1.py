"""A disk in contact with a finger that turns at a constant rate: section 4.1.1, equations 4.1 to 4.4.

With the centre at p = r d + R n (d along the finger, n its pushing normal, w its rate) the acceleration is

    p'' = (r'' - w^2 r) d + (2 r' w - R w^2) n ,

so the normal force is N = m (2 r' w - R w^2) whatever the friction, and the law along the finger is r'' = w^2 r + T / m
with T = 0 (frictionless), T from the disk's spin (rolling), or T = -+ mu N (sliding).

**Contact holds while N >= 0, that is r' >= R w / 2**, which the source does not check. Where N = 0 all three laws give
r'' > 0, so N never falls through 0 again: a disk either leaves at once or stays until it runs off the fingertip. One that
does not move along the finger (r' = 0, the source's cosh solutions) leaves at once; one at rest in space that the finger
picks up has r' = R w and stays.

Functions broadcast their arguments: s, rad/s, m, m/s, kg. Times count from when the distance is ``distance`` (r0) and
its rate ``speed`` (r0'). The finger closes, w > 0.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
ROLLING = np.sqrt(2.0 / 3.0)
"""Exponent of a rolling uniform disk, in finger rates."""
HALVINGS = 60


class Along(NamedTuple):
    """Distance r (m) of the contact from the joint and its rate r' (m/s)."""

    distance: Floats
    speed: Floats


def frictionless(time: ArrayLike, rate: ArrayLike, distance: ArrayLike, speed: ArrayLike = 0.0) -> Along:
    """Equation 4.1, r = r0 cosh wt, with an initial speed: r0 cosh wt + (r0' / w) sinh wt."""
    return _hyperbolic(time, rate, 1.0, distance, speed)


def rolling(time: ArrayLike, rate: ArrayLike, distance: ArrayLike, speed: ArrayLike = 0.0) -> Along:
    """Equation 4.2, a uniform disk that does not slip: as 4.1 with the exponent w sqrt(2/3)."""
    return _hyperbolic(time, rate, ROLLING, distance, speed)


def _hyperbolic(time: ArrayLike, rate: ArrayLike, factor: float, distance: ArrayLike, speed: ArrayLike) -> Along:
    t, w, r0, v0 = _together(time, rate, distance, speed)
    k = factor * w
    c, s = np.cosh(k * t), np.sinh(k * t)
    return Along(r0 * c + v0 / k * s, r0 * k * s + v0 * c)


class Exponents(NamedTuple):
    """r(t) = c1 e^(m1 t) + c2 e^(m2 t) - offset (equations 4.3 and 4.4; m, 1/s, m)."""

    c1: Floats
    c2: Floats
    m1: Floats
    m2: Floats
    offset: Floats


def sliding_exponents(
    rate: ArrayLike, distance: ArrayLike, speed: ArrayLike, friction: ArrayLike, radius: ArrayLike
) -> Exponents:
    """The constants of 4.3 from the initial distance and speed; ``friction`` below 0 for a disk that slips inwards.

    c1 + c2 = r0 + mu R and m1 c1 + m2 c2 = r0', with m = w (-mu -+ sqrt(mu^2 + 1)).
    """
    w, r0, v0, mu, radius = _together(rate, distance, speed, friction, radius)
    root = np.sqrt(mu**2 + 1.0)
    m1, m2 = -w * (mu + root), w * (root - mu)
    total = r0 + mu * radius
    c2 = (v0 - m1 * total) / (m2 - m1)
    return Exponents(total - c2, c2, m1, m2, mu * radius)


def sliding(
    time: ArrayLike,
    rate: ArrayLike,
    distance: ArrayLike,
    speed: ArrayLike,
    friction: ArrayLike,
    radius: ArrayLike,
) -> Along:
    """Equation 4.3: r'' = w^2 r - mu (2 r' w - R w^2), slip outwards; ``friction`` below 0: slip inwards."""
    c1, c2, m1, m2, offset = sliding_exponents(rate, distance, speed, friction, radius)
    t = np.asarray(time, dtype=float)
    one, two = c1 * np.exp(m1 * t), c2 * np.exp(m2 * t)
    return Along(one + two - offset, m1 * one + m2 * two)


def sliding_spin(
    time: ArrayLike, rate: ArrayLike, moved: ArrayLike, spin: ArrayLike, friction: ArrayLike, radius: ArrayLike
) -> Floats:
    """Spin (rad/s) of a uniform disk that has slid by ``moved`` = r - r0 (m): s0 - 2 mu (2 w (r - r0) - R w^2 t) / R."""
    t, w, dr, s0, mu, radius = _together(time, rate, moved, spin, friction, radius)
    return np.asarray(s0 - 2.0 * mu * (2.0 * w * dr - radius * w**2 * t) / radius)


def slip(rate: ArrayLike, speed: ArrayLike, spin: ArrayLike, radius: ArrayLike) -> Floats:
    """Velocity (m/s) of the disk's surface along the finger at the contact: r' - R w + R s; 0 while it rolls."""
    w, v, s, radius = _together(rate, speed, spin, radius)
    return np.asarray(v + radius * (s - w))


def normal_force(rate: ArrayLike, speed: ArrayLike, radius: ArrayLike, mass: ArrayLike) -> Floats:
    """N = m (2 r' w - R w^2) (N), frictionless, rolling or sliding alike; below 0 the disk has left the finger."""
    w, v, radius, m = _together(rate, speed, radius, mass)
    return np.asarray(m * (2.0 * v * w - radius * w**2))


def in_contact(rate: ArrayLike, speed: ArrayLike, radius: ArrayLike) -> NDArray[np.bool_]:
    """Whether N >= 0: r' >= R w / 2."""
    w, v, radius = _together(rate, speed, radius)
    return np.asarray(v >= 0.5 * radius * w)


def rolling_friction(rate: ArrayLike, distance: ArrayLike, speed: ArrayLike, radius: ArrayLike) -> Floats:
    """Least friction that keeps a disk rolling: |T| / N = (r w^2 / 3) / (2 r' w - R w^2); inf where contact is lost."""
    w, r, v, radius = _together(rate, distance, speed, radius)
    pressed = 2.0 * v * w - radius * w**2
    held = pressed > 0.0
    return np.where(held, np.abs(r) * w**2 / 3.0 / np.where(held, pressed, 1.0), np.inf)


def separation_time(
    rate: ArrayLike, distance: ArrayLike, speed: ArrayLike, radius: ArrayLike, length: ArrayLike
) -> Floats:
    """When a frictionless disk leaves the finger (s): 0 where N < 0 or r0 >= L, else when r = L."""
    return _left_at(rate, 1.0, distance, speed, radius, length)


def rolling_separation_time(
    rate: ArrayLike, distance: ArrayLike, speed: ArrayLike, radius: ArrayLike, length: ArrayLike
) -> Floats:
    """As ``separation_time``, for a disk that rolls all the way."""
    return _left_at(rate, ROLLING, distance, speed, radius, length)


def _left_at(
    rate: ArrayLike, factor: float, distance: ArrayLike, speed: ArrayLike, radius: ArrayLike, length: ArrayLike
) -> Floats:
    """r0 cosh kt + (r0' / k) sinh kt = L is a quadratic in e^(kt)."""
    w, r0, v0, radius, length = _together(rate, distance, speed, radius, length)
    k = factor * w
    b, stays = v0 / k, (v0 >= 0.5 * radius * w) & (r0 < length)
    root = np.sqrt(np.where(stays, length**2 - r0**2 + b**2, 0.0))
    return np.where(stays, np.log(np.where(stays, (length + root) / np.where(stays, r0 + b, 1.0), 1.0)) / k, 0.0)


def sliding_separation_time(
    rate: ArrayLike,
    distance: ArrayLike,
    speed: ArrayLike,
    friction: ArrayLike,
    radius: ArrayLike,
    length: ArrayLike,
) -> Floats:
    """As ``separation_time``, for a disk that slides all the way. r' never falls below R w / 2, which brackets the time."""
    w, r0, v0, mu, radius, length = _together(rate, distance, speed, friction, radius, length)
    stays = (v0 >= 0.5 * radius * w) & (r0 < length)
    low, high = np.zeros(w.shape), np.where(stays, 2.0 * (length - r0) / (radius * w), 0.0)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        on = sliding(middle, w, r0, v0, mu, radius).distance < length
        low, high = np.where(on, middle, low), np.where(on, high, middle)
    return np.asarray(0.5 * (low + high))


def _together(*values: ArrayLike) -> tuple[Floats, ...]:
    return np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in values))
