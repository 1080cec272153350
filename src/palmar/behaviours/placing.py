"""Where to put the hand so that every place of a belief lies in its region.

A hand put at q sees the belief B as B - q. The region is made simpler from inside, the belief replaced by a polygon of few
corners around its convex hull, and the one shrunk by the other (``regions.shrink``); the place with the largest margin is
then checked with B and the region themselves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPoint, MultiPolygon, affinity
from shapely.geometry.base import BaseGeometry

from palmar.geometry.planar_set import areal, inscribed_circle
from palmar.regions.shrink import shrunk

Floats = NDArray[np.float64]
MOST_CORNERS = 12
"""Of the polygon around a belief."""
SIMPLER = 4e-3
"""Share of the region's size by which its outline may move inwards to be simpler."""
ROUNDING = 1e-12
CENTRED = 0.01
"""Share of the region's size to which the largest margin is found."""


@dataclass(frozen=True)
class Place:
    """Where to put the hand (m, in the frame of the belief), and by how much the belief may be shifted from there."""

    x: float
    y: float
    margin: float


@dataclass(frozen=True)
class Target:
    """A region to put a belief into, a simpler one inside it, and its width and height (m)."""

    region: MultiPolygon
    simple: MultiPolygon
    extent: tuple[float, float]


def target(region: MultiPolygon) -> Target:
    """Prepare a region for ``place``."""
    if region.is_empty:
        return Target(region, region, (0.0, 0.0))
    left, bottom, right, top = region.bounds
    step = SIMPLER * max(right - left, top - bottom)
    simple = areal(region.buffer(-step, join_style="mitre").simplify(0.9 * step))
    shapely.prepare(region)
    return Target(region, simple, (right - left, top - bottom))


def place(goal: Target, belief: BaseGeometry) -> Place | None:
    """The place that leaves the belief the largest margin within the region; None where none was found."""
    left, bottom, right, top = belief.bounds
    if goal.simple.is_empty or right - left > goal.extent[0] or top - bottom > goal.extent[1]:
        return None
    free = shrunk(goal.simple, around(belief))
    if free.is_empty:
        return None
    room = inscribed_circle(free, CENTRED * max(goal.extent))
    x, y = room.centre
    if not goal.region.covers(affinity.translate(belief, x, y)):
        return None
    return Place(-x, -y, room.radius)


def around(belief: BaseGeometry) -> BaseGeometry:
    """A convex polygon of few corners around the belief."""
    hull = shapely.convex_hull(belief)
    corners = shapely.get_coordinates(hull)[:-1]
    if len(corners) <= MOST_CORNERS:
        return hull
    angles = 2.0 * np.pi * np.arange(MOST_CORNERS) / MOST_CORNERS
    normals = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    reach = (corners @ normals.T).max(axis=0) + ROUNDING * np.abs(corners).max()
    beside, next_reach = np.roll(normals, -1, axis=0), np.roll(reach, -1)
    cross = normals[:, 0] * beside[:, 1] - normals[:, 1] * beside[:, 0]
    x = (reach * beside[:, 1] - next_reach * normals[:, 1]) / cross
    y = (normals[:, 0] * next_reach - beside[:, 0] * reach) / cross
    return MultiPoint(np.stack([x, y], axis=1)).convex_hull
