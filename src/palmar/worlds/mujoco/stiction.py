"""Stiction under an object: the slower a point of the base slides, the more friction it has.

Each point has the friction mu (1 + (s - 1) exp(-v / v_s)) at speed v (Stribeck's form). What that adds to the secant metric
is an integral of the same kind with another weight; here over the cells of the pressure. Unlike friction that is the same at
all speeds it depends on how fast the object moves: points near the centre of rotation resist more.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.limit_surface import UNIFORM_DISK, LimitSurface
from palmar.mechanics.pushing.metric import Metric
from palmar.mechanics.pushing.pressure_cells import disk_cells

Floats = NDArray[np.float64]
LEAST = 1e-9
"""Slower points (m/s) count as this fast."""


@dataclass(frozen=True)
class Stiction:
    """``more``: s - 1; ``speed``: v_s (m/s); cells of the pressure as in ``pressure_cells``."""

    more: float
    speed: float
    points: Floats
    weights: Floats
    spreads: Floats

    def added_to(self, metric: Metric, vx: float, vy: float, omega: float) -> Metric:
        """The secant metric with what stiction adds, at a twist (m/s, rad/s) in the object's frame."""
        x, y = self.points.T
        speeds = np.maximum(np.hypot(vx - omega * y, vy + omega * x), np.maximum(np.abs(omega) * self.spreads, LEAST))
        share = self.more * self.weights * np.exp(-speeds / self.speed) / speeds
        total, up, across = float(share.sum()), float(share @ y), float(share @ x)
        xx, xy, yy, xw, yw, ww = metric
        around = float(share @ (x * x + y * y + self.spreads**2))
        return xx + total, xy, yy + total, xw - up, yw + across, ww + around


def stiction_of(surface: LimitSurface, ratio: float, speed: float) -> Stiction | None:
    """Of static over kinetic friction ``ratio``; None where there is none."""
    if ratio == 1.0:
        return None
    cells = surface.points, surface.weights, surface.spreads
    if surface.kind == UNIFORM_DISK:
        cells = disk_cells(1.5 * surface.length)
    return Stiction(ratio - 1.0, speed, *(np.asarray(each, dtype=float) for each in cells))
