"""Interpolation in tables of kernels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled


@compiled
def between(values: NDArray[np.float64], position: float) -> float:
    """Cubic interpolation in a table at equal steps, ``position`` counted in steps from its first entry."""
    k = min(max(int(position), 1), len(values) - 3)
    t = position - k
    a, b, c, d = values[k - 1], values[k], values[k + 1], values[k + 2]
    slope, bend, twist = c - b / 2.0 - a / 3.0 - d / 6.0, 0.5 * (a + c) - b, (d - a) / 6.0 + 0.5 * (b - c)
    return b + t * (slope + t * (bend + t * twist))
