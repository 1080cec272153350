"""The inverse of chapter 2: palm widths, finger lengths or frictions with which a given range of radii is held.

For one varied dimension the margin min(R_max - r_largest, r_smallest - R_min) is continuous wherever a hold exists; the
dimensions that suffice are where it is not negative. Its sign changes are bracketed on a fine grid, to which the
dimensions at which one radius limit is met exactly are added in closed form, and bisected to rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from math import atan, cos, inf, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.closure.disk_2_2 import Radii, frictional_radii, structural_radii

Floats = NDArray[np.float64]

SHORTEST, LONGEST = 1e-6, 1e3
"""Search reach for a length, in multiples of the sum of all given lengths."""
LARGEST_FRICTION_ANGLE = atan(100.0)
_GRID = 4001
_ROUNDING = 1e-12


class Dimension(Enum):
    """What may be varied to make a hand hold a range of radii."""

    HALF_PALM = "half_palm"
    FINGER_LENGTH = "finger_length"
    FRICTION_ANGLE = "friction_angle"


@dataclass(frozen=True)
class Grip:
    """Everything the closure of a 2-jointed hand depends on, SI; ``friction_angle`` None = structural closure."""

    half_palm: float
    finger_length: float
    half_thickness: float = 0.0
    friction_angle: float | None = None
    crossing: bool = True
    psi_limits: tuple[float, float] = (0.0, pi)

    def radii(self, dimension: Dimension | None = None, values: Floats | None = None) -> Radii:
        """Held radii, for each of ``values`` in place of one dimension."""
        given: dict[str, float | Floats | None] = {each.value: getattr(self, each.value) for each in Dimension}
        if dimension is not None:
            given[dimension.value] = values
        d, length, alpha = (given[each.value] for each in Dimension)
        assert d is not None
        assert length is not None
        if alpha is None:
            return structural_radii(d, length, self.half_thickness, crossing=self.crossing, psi_limits=self.psi_limits)
        return frictional_radii(
            d, length, alpha, self.half_thickness, crossing=self.crossing, psi_limits=self.psi_limits
        )  # fmt: skip


def sufficient(grip: Grip, dimension: Dimension, smallest: float, largest: float) -> list[tuple[float, float]]:
    """Intervals of one dimension (m, or rad for friction) in which every radius of [smallest, largest] is held.

    Ends of 0 and ``inf`` mean: however small, however large (found from ``SHORTEST`` to ``LONGEST`` times the lengths
    given). The value that ``grip`` holds for that dimension is ignored. Empty where nothing suffices.
    """
    scale = grip.half_palm + grip.finger_length + grip.half_thickness + largest

    def margin(values: Floats) -> Floats:
        radii = grip.radii(dimension, values)
        slack = np.fmin(radii.max - largest, smallest - radii.min)
        return np.where(np.isnan(radii.max), -inf, slack) + _ROUNDING * scale

    if dimension is Dimension.FRICTION_ANGLE:
        top = LARGEST_FRICTION_ANGLE
        grid = np.linspace(0.0, top, _GRID)
    else:
        top = LONGEST * scale
        low = max(grip.half_thickness * (1.0 + 1e-9), SHORTEST * scale)
        grid = np.geomspace(low, top, _GRID)
    grid = np.unique(np.concatenate([grid, _critical(grip, dimension, smallest, largest, float(grid[0]), top)]))
    found = _intervals(margin, grid)
    if dimension is Dimension.FRICTION_ANGLE:
        return found
    bottom = float(grid[0])
    return [(0.0 if start <= bottom else start, inf if end >= top else end) for start, end in found]


def _critical(grip: Grip, dimension: Dimension, smallest: float, largest: float, low: float, top: float) -> Floats:
    """Values at which a radius limit is met exactly, so that no thin interval is stepped over."""
    alpha = grip.friction_angle or 0.0
    h = grip.half_thickness
    found: list[float] = []
    for radius in (smallest, largest):
        rho, rise = radius + h, radius - (radius + h) * sin(alpha)
        if dimension is Dimension.HALF_PALM:
            found += [rho, rho * cos(alpha) - grip.finger_length * sin(alpha)]
            if grip.finger_length >= abs(rise):
                reach = sqrt(grip.finger_length**2 - rise**2)
                found += [rho * cos(alpha) - reach, rho * cos(alpha) + reach]
        elif dimension is Dimension.FINGER_LENGTH:
            found += [sqrt((grip.half_palm - rho * cos(alpha)) ** 2 + rise**2)]
            found += [(rho * cos(alpha) - grip.half_palm) / sin(alpha)] if alpha > 0.0 else []
    values = np.array(found, dtype=float)
    return values[(values > low) & (values < top)]


def _intervals(margin: Callable[[Floats], Floats], grid: Floats) -> list[tuple[float, float]]:
    good = margin(grid) >= 0.0
    starts = [0] if good[0] else []
    ups = np.flatnonzero(~good[:-1] & good[1:])
    downs = np.flatnonzero(good[:-1] & ~good[1:])
    lows = [float(grid[0])] * len(starts) + list(_bisected(margin, grid[ups], grid[ups + 1]))
    highs = list(_bisected(margin, grid[downs + 1], grid[downs])) + ([float(grid[-1])] if good[-1] else [])
    return list(zip(lows, highs, strict=True))


def _bisected(margin: Callable[[Floats], Floats], outside: Floats, inside: Floats) -> list[float]:
    """The last good value next to each sign change."""
    for _ in range(100 if len(outside) else 0):
        middle = 0.5 * (outside + inside)
        good = margin(middle) >= 0.0
        outside, inside = np.where(good, outside, middle), np.where(good, middle, inside)
    return [float(each) for each in inside]


def why_none(grip: Grip, dimension: Dimension, smallest: float, largest: float) -> str:
    """Which end of the range of radii no value serves: 'smallest', 'largest', or 'both' if only not both at once."""
    if not sufficient(grip, dimension, largest, largest):
        return "largest"
    return "both" if sufficient(grip, dimension, smallest, smallest) else "smallest"


def slopes(grip: Grip, dimension: Dimension) -> tuple[Radii, Radii]:
    """One-sided derivatives of (R_min, R_max) with respect to one dimension: (on decreasing it, on increasing it).

    m per m, or m per rad. By differences of 1e-6 of the value; they differ at a kink, where another limit takes over.
    """
    value = getattr(grip, dimension.value)
    step = 1e-6 * value
    at = grip.radii(dimension, np.array([value - step, value, value + step]))
    below, above = (Radii(np.diff(at.min)[i] / step, np.diff(at.max)[i] / step) for i in (0, 1))
    return below, above
