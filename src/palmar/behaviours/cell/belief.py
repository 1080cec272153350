"""Where the axis of a standing cylinder may be: a set of places on a grid, shrunk by what the hand feels.

A finger that comes down on the cylinder's top says that the axis is within radius + tip radius of the tip; one that comes
down beside it says that it is not. The next approach goes to the middle of what is left (of its least enclosing circle).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
ACROSS = 61
"""Grid points across the set at the start."""
UNFELT = 0.2
"""Share of that distance by which an untouched tip may be nearer: one on the very rim slides off unfelt."""
SLACK = 0.003
"""How far (m) a touch may be off what the geometry says: the arm's error and what the touch moved."""


@dataclass(frozen=True)
class Belief:
    """Possible places (n, 2) of the axis (m)."""

    places: Floats

    @cached_property
    def middle(self) -> Floats:
        """Centre of the least enclosing circle (m), by Badoiu and Clarkson's iteration: off by less than 2 %."""
        centre = self.places.mean(axis=0)
        for k in range(1, 60):
            away = self.places[np.linalg.norm(self.places - centre, axis=1).argmax()]
            centre = centre + (away - centre) / (k + 1)
        middle: Floats = centre
        return middle

    @property
    def radius(self) -> float:
        """How far (m) the axis may be from the middle."""
        return float(np.linalg.norm(self.places - self.middle, axis=1).max())


def around(place: tuple[float, float], error: float) -> Belief:
    """All places within ``error`` (m) of one."""
    line = np.linspace(-error, error, ACROSS)
    grid = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    return Belief(np.asarray(place) + grid[np.hypot(*grid.T) <= error + 1e-12])


def after_touch(belief: Belief, tips: Floats, touched: tuple[bool, ...], radius: float, tip_radius: float) -> Belief:
    """After tips (3, 2) in m came down level with the top of a cylinder, some of them touching it.

    If what was felt contradicts the set (the cylinder was moved), only what was felt counts.
    """
    reach = radius + tip_radius
    keep = _agrees(belief.places, tips, touched, reach)
    if keep.any():
        return Belief(belief.places[keep])
    wide = around(tuple(tips[np.array(touched)].mean(axis=0)), 2.0 * reach)
    keep = _agrees(wide.places, tips, touched, reach)
    return Belief(wide.places[keep]) if keep.any() else wide


def _agrees(places: Floats, tips: Floats, touched: tuple[bool, ...], reach: float) -> NDArray[np.bool_]:
    apart = np.linalg.norm(places[:, None] - tips, axis=-1)
    agrees = np.where(np.array(touched), apart <= reach + SLACK, apart >= (1.0 - UNFELT) * reach)
    return np.asarray(agrees.all(axis=1))
