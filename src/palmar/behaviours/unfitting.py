"""Beliefs that fit into no closing region: some of their places alone fit at no place of the hand.

Put at q the hand sees the places p_i at p_i - q. All are in the region R if and only if -q is in every R - p_i; if these
sets share nothing, the belief does not fit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from shapely import MultiPolygon, affinity
from shapely.geometry.base import BaseGeometry

from palmar.geometry.planar_set import areal

COARSE = (2e-2, 1e-3)
"""Shares of the region's size by which its outline may move outwards to be simpler, tried one after the other."""
EXTREMES = 16
"""Directions in which the farthest places of a belief are asked for."""


@dataclass(frozen=True)
class Outer:
    """Sets around a region, from simple to close, and its width and height (m)."""

    around: tuple[MultiPolygon, ...]
    size: tuple[float, float]


def outer_of(region: MultiPolygon, slack: float) -> Outer:
    """Sets around a region grown by ``slack`` (m)."""
    if region.is_empty:
        return Outer((), (0.0, 0.0))
    left, bottom, right, top = region.bounds
    size = max(right - left, top - bottom)
    around = []
    for share in COARSE:
        simpler = areal(region.buffer(share * size).simplify(0.9 * share * size))
        around.append(areal(simpler.buffer(1.1 * slack, join_style="mitre")))
    return Outer(tuple(around), (right - left + 2.0 * slack, top - bottom + 2.0 * slack))


def surely_unfit(outer: Outer, belief: BaseGeometry) -> bool:
    """Whether it is proved that the belief lies in the region wherever the hand is put."""
    if not outer.around:
        return not belief.is_empty
    if belief.is_empty:
        return False
    left, bottom, right, top = belief.bounds
    if right - left > outer.size[0] or top - bottom > outer.size[1]:
        return True
    return any(_share_nothing(each, belief) for each in outer.around)


def _share_nothing(around: MultiPolygon, belief: BaseGeometry) -> bool:
    corners = shapely.get_coordinates(shapely.convex_hull(belief))
    angles = 2.0 * np.pi * np.arange(EXTREMES) / EXTREMES
    # Opposite directions after each other: these exclude the most.
    order = np.arange(EXTREMES).reshape(2, -1).T.ravel()
    chosen = np.argmax(corners @ np.stack([np.cos(angles), np.sin(angles)]), axis=0)[order]
    shared: BaseGeometry | None = None
    for x, y in corners[list(dict.fromkeys(chosen.tolist()))]:
        here = affinity.translate(around, -float(x), -float(y))
        shared = here if shared is None else shapely.intersection(shared, here)
        if shared.area == 0.0:
            return True
    return False
