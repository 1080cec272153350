"""All that a hand may touch of disks that stay where they are while it comes, closes and goes back."""

from __future__ import annotations

from itertools import pairwise
from math import cos, pi

import numpy as np
import shapely
from shapely import LineString
from shapely.geometry.base import BaseGeometry

from palmar.models.hand import Hand

SECTOR = 0.1
"""Angle (rad) of a triangle around a part of a finger's sector."""


def may_be_touched(hand: Hand, radius: float, opening: float, last: float, depth: float) -> BaseGeometry:
    """All centres (m) that a hand may touch that comes straight up, closes from ``opening`` to ``last`` (rad) and goes back.

    Sectors of the fingers and the palm, grown, and all below them down to ``depth`` (m) under the palm.
    """
    lines = [LineString([(-hand.half_palm, 0.0), (hand.half_palm, 0.0)])]
    sectors: list[BaseGeometry] = []
    steps = 1 + int(abs(last - opening) / SECTOR)
    step = abs(last - opening) / steps
    reach = hand.finger_length / cos(0.5 * step)
    for side in (1.0, -1.0):
        angles = np.linspace(opening, last, steps + 1)
        rim = np.stack([side * (hand.half_palm + reach * np.cos(angles)), reach * np.sin(angles)], axis=1)
        base = side * hand.half_palm, 0.0
        sectors += [shapely.MultiPoint([base, *rim[k : k + 2]]).convex_hull for k in range(steps)]
    touched = shapely.union_all([*lines, *sectors]).buffer((radius + hand.half_thickness) / cos(pi / 64.0))
    below = [
        shapely.MultiPoint([(x, y), (x_next, y_next), (x, -depth), (x_next, -depth)]).convex_hull
        for each in shapely.get_parts(touched)
        for (x, y), (x_next, y_next) in pairwise(shapely.get_coordinates(each.exterior))
    ]
    return shapely.union_all([touched, *below])
