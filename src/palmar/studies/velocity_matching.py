"""Matching the hand's velocity to a tracked disk: section 4.3.1, how much position error is left and how speed eats it.

A hand that flies along with the disk closes on one at rest, so any error within the region's largest circle (radius c)
is tolerated. Closing takes the time T from the start to where the tips stand a disk apart. What uses c up at the disk's
speed v, in the plane of the circle:

- **spread**: the tracker's position and velocity errors (standard deviations s, q per axis, independent, Gaussian); a
  velocity error moves the disk for the delay d it is extrapolated over and for T: sigma^2 = s^2 + q^2 (d + T)^2. The disk
  lies within sigma sqrt(-2 ln(1 - p)) of where it is thought to be with the probability p;
- **lag**: v d, where the hand steers for a place that is d old instead of extrapolating it;
- **drift**: (v - v_m) T, where the hand cannot go faster than v_m. Within its reach S it must speed up, keep the pace
  while closing, and stop, v^2 / a + v T <= S, so v_m = min(limit, 2 S / (T + sqrt(T^2 + 4 S / a))).

The tolerated error is c less these: constant up to v_m (with extrapolation), from there falling by T per unit of speed.
A relative velocity also changes the impacts, which this linear account leaves out; docs/derivations/zero_gravity.md says
how far simulation bears it out.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, inf, log, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.errors import InputError, NotCoveredError
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.regions.region import Region

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Tracking:
    """What is known of the disk: standard deviations of position (m) and velocity (m/s) per axis, age of the data (s)."""

    position_sigma: float
    velocity_sigma: float
    delay: float
    extrapolates: bool = True
    """Whether the place is carried forward over the delay by the velocity measured."""

    def __post_init__(self) -> None:
        for name in ("position_sigma", "velocity_sigma", "delay"):
            if not 0.0 <= getattr(self, name) < inf:
                raise InputError(name, repr(getattr(self, name)), "must be finite and not negative")


@dataclass(frozen=True)
class Carriage:
    """What the hand can do along the disk's path: reach (m), acceleration (m/s^2) and speed (m/s); inf: no limit."""

    reach: float = inf
    acceleration: float = inf
    speed: float = inf

    def __post_init__(self) -> None:
        for name in ("reach", "acceleration", "speed"):
            if not getattr(self, name) > 0.0:
                raise InputError(name, repr(getattr(self, name)), "must be positive")

    def matched_speed(self, closing_time: float) -> float:
        """v_m (m/s): the fastest pace kept for ``closing_time`` (s) between a start and a stop within reach."""
        if self.reach == inf:
            return self.speed
        pause = 4.0 * self.reach / self.acceleration
        return min(self.speed, 2.0 * self.reach / (closing_time + sqrt(closing_time**2 + pause)))


@dataclass(frozen=True)
class Matching:
    """Per speed of the disk (m/s): what uses the circle up and what is left (m; below 0: too much), chance to lie in it."""

    speed: Floats
    spread: float
    lag: Floats
    drift: Floats
    tolerated: Floats
    chance: Floats


def closing_time(case: Case) -> float:
    """T (s): from the case's opening to where the tips of its straight fingers leave just a disk's room, at its rate."""
    if not isinstance(case.object, Disk):
        raise NotCoveredError('object.shape = "polygon": matching velocities is worked out for disks')
    hand = case.hand
    cosine = (case.object.radius + hand.half_thickness - hand.half_palm) / hand.finger_length
    if abs(cosine) > 1.0 or acos(cosine) <= hand.open:
        raise NotCoveredError("the fingertips never close to the disk's diameter, so no closing time is known")
    return (acos(cosine) - hand.open) / hand.finger_rate


def velocity_matching(
    case: Case, region: Region, tracking: Tracking, carriage: Carriage, speed: ArrayLike, confidence: float = 0.99
) -> Matching:
    """The error still tolerated (m) at each ``speed`` (m/s) when the tracker's own error is taken at ``confidence``.

    Raises NotCoveredError for an empty region and for objects other than disks.
    """
    allowed, duration = _circle(region), closing_time(case)
    v = np.asarray(speed, dtype=float)
    sigma = _sigma(tracking, duration)
    spread = sigma * _radius_of(confidence)
    lag = np.zeros(v.shape) if tracking.extrapolates else v * tracking.delay
    drift = np.maximum(v - carriage.matched_speed(duration), 0.0) * duration
    rest = allowed - lag - drift
    with np.errstate(divide="ignore"):
        chance = np.where(rest > 0.0, 1.0 - np.exp(-0.5 * (np.maximum(rest, 0.0) / sigma) ** 2) if sigma else 1.0, 0.0)
    return Matching(v, spread, lag, drift, rest - spread, chance)


def fastest(case: Case, region: Region, tracking: Tracking, carriage: Carriage, confidence: float = 0.99) -> float:
    """Speed (m/s) up to which any error is tolerated; 0 where the tracker alone uses it up, inf without a limit."""
    allowed, duration = _circle(region), closing_time(case)
    left = allowed - _sigma(tracking, duration) * _radius_of(confidence)
    if left <= 0.0:
        return 0.0
    matched, late = carriage.matched_speed(duration), 0.0 if tracking.extrapolates else tracking.delay
    if late * matched >= left:
        return left / late
    return (left + matched * duration) / (late + duration)


def _circle(region: Region) -> float:
    if region.allowed_error is None:
        raise NotCoveredError(f"no start is caught, so no error is allowed: {region.reason}")
    return region.allowed_error.radius


def _sigma(tracking: Tracking, duration: float) -> float:
    return sqrt(tracking.position_sigma**2 + (tracking.velocity_sigma * (tracking.delay + duration)) ** 2)


def _radius_of(confidence: float) -> float:
    """Radius, in standard deviations, of the circle that holds a round Gaussian with this probability."""
    if not 0.0 <= confidence < 1.0:
        raise InputError("confidence", repr(confidence), "must be from 0 to below 1")
    return sqrt(-2.0 * log(1.0 - confidence))
