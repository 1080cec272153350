"""Maps of what 4-jointed hands hold: every case of section 5.1 over the lengths of both links.

Dimensionless: distal link Q, proximal link P and half palm 1 - Q - P are shares of half the hand's length.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.closure.four_jointed_5_1 import CASES, four_jointed_radii
from palmar.mechanics.closure.four_jointed_cradle import folds

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ClosureMap:
    """Smallest and largest radius by case (and "overall") for flat arrays of hands; NaN where none is held."""

    distal: Floats
    proximal: Floats
    radius_min: dict[str, Floats]
    radius_max: dict[str, Floats]


def closure_map(distal: Floats, proximal: Floats) -> ClosureMap:
    """The map at given points; NaN where the links leave no palm (Q + P >= 1, to rounding)."""
    palm = 1.0 - distal - proximal
    exists = (palm > 1e-12) & (distal >= 0.0) & (proximal >= 0.0)
    w, p, q = palm[exists], proximal[exists], distal[exists]
    radii = four_jointed_radii(w, p, q)
    smallest, largest = {}, {}
    for name in (*CASES, "overall"):
        each = getattr(radii, name)
        low = np.where(folds(w, p, q), 0.0, each.min) if name == "distal_proximal" else each.min
        smallest[name], largest[name] = _spread(low, exists), _spread(each.max, exists)
    return ClosureMap(distal, proximal, smallest, largest)


def grid_map(count: int) -> ClosureMap:
    """The map over ``count`` x ``count`` points, both links from 0 to 1."""
    shares = np.linspace(0.0, 1.0, count)
    distal, proximal = np.meshgrid(shares, shares)
    return closure_map(distal.ravel(), proximal.ravel())


def _spread(values: Floats, exists: NDArray[np.bool_]) -> Floats:
    result = np.full(exists.shape, np.nan)
    result[exists] = values
    return result
