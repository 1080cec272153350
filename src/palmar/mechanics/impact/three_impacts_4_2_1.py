"""Flight between impacts and the capture by three of them: section 4.2.1, equations 4.8 and 4.9.

Everything is per radian of a heavy finger that closes at a constant rate, so velocities are lengths (m/rad) and the rate
drops out. In the frame of the finger at an impact, u along it and n along its pushing normal, the disk's centre leaves
(X, R) with (u_t, u_n). After the finger has turned by phi it is touched again where

    g(phi) = u_n phi cos phi - (X + u_t phi) sin phi - R (1 - cos phi) = 0,                       (4.8)

at the distance X' = (X + u_t phi) cos phi + (R + u_n phi) sin phi. For u_t >= 0, u_n > X, X >= 0, the only flights here,
g / cos phi is concave on (0, pi/2), rises at 0 and falls to minus infinity: there is exactly one such phi.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, pi
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
HALVINGS = 60


class Flight(NamedTuple):
    """From one impact to the next: turn phi (rad), distance X' (m), velocity before it in the finger's new frame (m/rad)."""

    turn: Floats
    distance: Floats
    along: Floats
    normal: Floats


def flight(distance: ArrayLike, along: ArrayLike, normal: ArrayLike, radius: ArrayLike) -> Flight:
    """Equation 4.8: the flight that leaves the finger at ``distance`` (m) with velocity (``along``, ``normal``) (m/rad).

    NaN where the disk does not leave (normal <= distance) or moves towards the joint (along < 0): there the first
    contact need not be the one on the finger's line.
    """
    x, ut, un, r = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (distance, along, normal, radius)))
    low, high = np.zeros(x.shape), np.full(x.shape, 0.5 * pi)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        free = _gap(middle, x, ut, un, r) > 0.0
        low, high = np.where(free, middle, low), np.where(free, high, middle)
    turn = np.where((un > x) & (ut >= 0.0) & (x >= 0.0), 0.5 * (low + high), np.nan)
    c, s = np.cos(turn), np.sin(turn)
    return Flight(turn, (x + ut * turn) * c + (r + un * turn) * s, ut * c + un * s, un * c - ut * s)


def _gap(phi: Floats, x: Floats, ut: Floats, un: Floats, r: Floats) -> Floats:
    """Distance of the centre from the finger's line, less R; without cancellation for small phi."""
    sine = np.sin(phi)
    return np.asarray(un * phi * np.cos(phi) - (x + ut * phi) * sine - 2.0 * r * np.sin(0.5 * phi) ** 2)


def struck(distance: ArrayLike, normal: ArrayLike, restitution: ArrayLike = 1.0) -> Floats:
    """Normal velocity (m/rad) after a heavy finger has struck: (1 + e) X' - e u_n, 4.9 with the sign of a moving wall."""
    x, un, e = (np.asarray(each, dtype=float) for each in (distance, normal, restitution))
    return np.asarray((1.0 + e) * x - e * un)


def struck_published(distance: ArrayLike, normal: ArrayLike) -> Floats:
    """Equation 4.9 as printed, e = 1: 2 X' + u_n.

    Erratum: in the finger's frame the velocity u_n - X' must change sign, which 2 X' - u_n does; the printed sum makes
    a disk that runs away from the finger faster by being struck.
    """
    return np.asarray(2.0 * np.asarray(distance, dtype=float) + np.asarray(normal, dtype=float))


class ThreeImpacts(NamedTuple):
    """Distances (m) of three impacts in a row and the turns (rad) between them, for a disk at rest and e = 1."""

    first: Floats
    second: Floats
    third: Floats
    turn_to_second: Floats
    turn_to_third: Floats


def three_impacts(distance: ArrayLike, radius: ArrayLike, *, published: bool = False) -> ThreeImpacts:
    """The impacts that follow a first one at ``distance`` (m); ``published``: with 4.9 as printed."""
    x = np.asarray(distance, dtype=float)
    one = flight(x, np.zeros(x.shape), 2.0 * x, radius)
    again = struck_published(one.distance, one.normal) if published else struck(one.distance, one.normal)
    two = flight(one.distance, one.along, again, radius)
    return ThreeImpacts(x, one.distance, two.distance, one.turn, two.turn)


@dataclass(frozen=True)
class Construction:
    """The three contacts polar about the right base joint: distances (m) X1, X2, L and angles (rad) phi0 + ...

    ``first_angle`` is phi0, below 0 where the first contact would lie behind the open finger; ``end`` is the finger
    angle arccos((R - D) / L) at which the tips stand 2 R apart.
    """

    first: float
    second: float
    third: float
    first_angle: float
    turn_to_second: float
    turn_to_third: float

    @property
    def second_angle(self) -> float:
        """phi0 + phi1 (rad)."""
        return self.first_angle + self.turn_to_second

    @property
    def end(self) -> float:
        """phi0 + phi1 + phi2 (rad)."""
        return self.second_angle + self.turn_to_third


def first_distance(finger_length: ArrayLike, radius: ArrayLike, *, published: bool = False) -> Floats:
    """X1 (m) whose third contact is at the tip, X3 = L (steps 1 to 6 of section 4.2.1).

    X3 / R is a function of X1 / R alone that grows from 0 without bound (by 5 X1 at first, with 4.9 as printed by 13 X1;
    tests follow it over fourteen decades), so X1 exists, and is one, for every L and R.
    """
    length, r = np.broadcast_arrays(np.asarray(finger_length, dtype=float), np.asarray(radius, dtype=float))
    low, high = np.zeros(length.shape), length
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        beyond = three_impacts(middle, r, published=published).third > length
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return np.asarray(0.5 * (low + high))


def construction(
    half_palm: float, finger_length: float, radius: float, *, published: bool = False
) -> Construction | None:
    """The three contacts of section 4.2.1 (lengths m), None where the tips never stand 2 R apart: |D - R| > L."""
    cosine = (half_palm - radius) / finger_length
    if abs(cosine) > 1.0:
        return None
    found = three_impacts(first_distance(finger_length, radius, published=published), radius, published=published)
    turns = float(found.turn_to_second), float(found.turn_to_third)
    first_angle = pi - sum(turns) - acos(cosine)
    return Construction(float(found.first), float(found.second), finger_length, first_angle, *turns)
