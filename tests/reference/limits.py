"""The radii one 2-jointed hand can hold, as intervals, found by asking the brute-force decision only.

`palmar` gives these limits in closed form; here they come from a scan of radii and a bisection wherever
neighbouring radii get different answers.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .disk_holding import holds_structurally, holds_with_friction

Intervals = list[tuple[float, float]]
Decision = Callable[[NDArray[np.float64]], NDArray[np.bool_]]

SMALLEST_SHARE = 1e-6
BISECTIONS = 50


class HeldRadii(NamedTuple):
    """Intervals of held radii in metres, ascending; empty where the hand holds no disk."""

    structural: Intervals
    frictional: Intervals


def held_intervals(decision: Decision, radii: NDArray[np.float64]) -> Intervals:
    """Intervals where the decision says yes, their ends bisected between neighbouring radii.

    An interval or a gap narrower than the spacing of `radii` can be missed. One that starts at the smallest
    radius asked is given the lower end 0, one that reaches the largest has the upper end inf.
    """
    held = decision(radii)
    before = np.flatnonzero(held[:-1] != held[1:])
    low, high = radii[before], radii[before + 1]
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        like_low = decision(middle) == held[before]
        low, high = np.where(like_low, middle, low), np.where(like_low, high, middle)
    ends = [float(end) for end in 0.5 * (low + high)]
    if held[0]:
        ends.insert(0, 0.0)
    if held[-1]:
        ends.append(math.inf)
    return list(zip(ends[::2], ends[1::2], strict=True))


def scan_limits(
    half_palm: float,
    finger_length: float,
    friction_angle: float,
    half_thickness: float = 0.0,
    *,
    crossing: bool = True,
    psi_limits: tuple[float, float] = (0.0, math.pi),
    samples: int = 2000,
) -> HeldRadii:
    """Held radii of one hand; lengths in metres, angles in radians, hand as in `holds_with_friction`.

    Half of the `samples` are spaced evenly and half geometrically, from a millionth of the largest upwards.
    The largest radius worth asking: a contact is no higher than the finger's tip can be, and no lower than
    the friction angle below the equator of a disk that is not below the palm, so R - R sin(alpha) <= L + h
    sin(alpha).
    """
    sine = math.sin(friction_angle)
    largest = 1.01 * (finger_length + half_thickness) / (1.0 - sine)
    even = np.linspace(0.0, largest, samples // 2 + 1)[1:]
    radii = np.union1d(even, np.geomspace(SMALLEST_SHARE * largest, largest, samples - samples // 2))

    def structural(radius: NDArray[np.float64]) -> NDArray[np.bool_]:
        return holds_structurally(
            radius, half_palm, finger_length, half_thickness, crossing=crossing, psi_limits=psi_limits
        )

    def frictional(radius: NDArray[np.float64]) -> NDArray[np.bool_]:
        return holds_with_friction(
            radius,
            half_palm,
            finger_length,
            friction_angle,
            half_thickness,
            crossing=crossing,
            psi_limits=psi_limits,
        )

    return HeldRadii(held_intervals(structural, radii), held_intervals(frictional, radii))
