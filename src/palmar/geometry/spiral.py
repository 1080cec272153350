"""Curves carried by a turning line: p(phi) = base + (a + b phi) t(phi) + c n(phi).

t = (cos phi, sin phi) runs along the line, n = (-sin phi, cos phi) across it. With c = 0 this is an Archimedean
spiral; with c = b it is the involute of a circle of radius b, whose tangent is n and whose radius of curvature is
a + b phi. Flattening is certified: the polyline through points at equal steps of phi leaves the curve by at most
max |p''| dphi^2 / 8, and p'' = -(a + b phi) t + (2 b - c) n.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, hypot, sqrt

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Spiral:
    """p(phi) for phi in [start, end] (rad); ``along`` = a, ``rate`` = b and ``across`` = c in m."""

    base: tuple[float, float]
    along: float
    rate: float
    across: float
    start: float
    end: float

    def at(self, phi: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (N, 2) at the angles ``phi`` (N,)."""
        cosine, sine = np.cos(phi), np.sin(phi)
        reach = self.along + self.rate * phi
        x = self.base[0] + reach * cosine - self.across * sine
        y = self.base[1] + reach * sine + self.across * cosine
        return np.stack([x, y], axis=-1)

    @property
    def sharpest(self) -> float:
        """max |p''| over the curve (m): |a + b phi| is largest at an end, the other component is constant."""
        reach = max(abs(self.along + self.rate * self.start), abs(self.along + self.rate * self.end))
        return hypot(reach, 2.0 * self.rate - self.across)

    def flattened(self, tolerance: float) -> tuple[NDArray[np.float64], float]:
        """A polyline (N, 2) on the curve and the proven bound (m) of its distance from it, at most ``tolerance``."""
        span = self.end - self.start
        steps = max(1, ceil(span * sqrt(self.sharpest / (8.0 * tolerance))))
        bound = self.sharpest * (span / steps) ** 2 / 8.0
        return self.at(np.linspace(self.start, self.end, steps + 1)), bound
