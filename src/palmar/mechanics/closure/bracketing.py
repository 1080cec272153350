"""Root searches in many brackets at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from palmar.mechanics.closure.polygon_outline import Bools, Floats, Indices

HALVINGS = 50
STEPS = 3 * HALVINGS
ROUNDING = 5e-15
"""Places closer than this are one."""


def halved(
    holds: Callable[[Floats], Bools], low: Floats, high: Floats, halvings: int = HALVINGS
) -> tuple[Floats, Floats]:
    """Ends of a small bracket in each [low, high] around the place where a condition passes from true to false."""
    low, high = low.copy(), high.copy()
    for _ in range(halvings if low.size else 0):
        middle = 0.5 * (low + high)
        true = holds(middle)
        low, high = np.where(true, middle, low), np.where(true, high, middle)
    return low, high


def falling_zero(function: Callable[[Indices, Floats], tuple[Floats, Floats]], low: Floats, high: Floats) -> Floats:
    """Where functions pass from >= 0 at low to below 0 at high.

    ``function`` takes the numbers of some of them and a place for each, and returns values and slopes. Newton steps
    kept inside the bracket; every third step halves it.
    """
    found, low, high = high.copy(), low.copy(), high.copy()
    left, place = np.arange(low.size), 0.5 * (low + high)
    for step in range(STEPS):
        if left.size == 0:
            break
        value, slope = function(left, place)
        low, high = np.where(value >= 0.0, place, low), np.where(value >= 0.0, high, place)
        newton = place - value / np.where(slope < 0.0, slope, -np.inf)
        inside = (newton > low) & (newton < high) & (slope < 0.0)
        arrived = (slope < 0.0) & (np.abs(newton - place) < ROUNDING)
        open_ = ~arrived & (high - low >= ROUNDING)
        found[left] = place
        place = np.where(inside & (step % 3 < 2), newton, 0.5 * (low + high))
        left, place, low, high = left[open_], place[open_], low[open_], high[open_]
    return found
