"""What a ring encloses beside the y axis and above a level, without the general and slower overlay of polygons."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import Polygon
from shapely.geometry.base import BaseGeometry

from palmar.geometry.planar_set import EMPTY

Floats = NDArray[np.float64]


def in_quadrant(ring: Floats, level: float, snap: float) -> BaseGeometry:
    """The part with x >= 0 and y >= ``level`` (m) of what a closed line (N, 2), m, encloses.

    Corners within ``snap`` (m) of the two lines are put on them. Crossings of the ring with itself are resolved.
    """
    for axis, floor in ((0, 0.0), (1, level)):
        ring = _above(ring, axis, floor, snap)
        if len(ring) < 3:
            return EMPTY
    shape = Polygon(ring)
    # Clipped rings of several pieces hang together along a line; making them valid parts them.
    return shape if shape.is_valid else shapely.make_valid(shape, method="structure")


def _above(ring: Floats, axis: int, floor: float, snap: float) -> Floats:
    """The ring cut at one line (Sutherland and Hodgman): corners on or above it, and where its edges cross it."""
    height = ring[:, axis] - floor
    height[np.abs(height) <= snap] = 0.0
    lowest = float(height.min())
    if lowest > 0.0:
        return ring
    ring = ring.copy()
    ring[height == 0.0, axis] = floor
    if lowest == 0.0:
        return ring
    after = np.concatenate([height[1:], height[:1]])
    crossed = np.flatnonzero(height * after < 0.0)
    share = height[crossed] / (height[crossed] - after[crossed])
    begins, ends = ring[crossed], ring[(crossed + 1) % len(ring)]
    met = begins + share[:, None] * (ends - begins)
    met[:, axis] = floor
    kept = np.flatnonzero(height >= 0.0)
    order = np.argsort(np.concatenate([kept, crossed + 0.5]), kind="stable")
    cut: Floats = np.concatenate([ring[kept], met])[order]
    return cut
