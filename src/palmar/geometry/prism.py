"""A planar set swept along the third axis: a closed surface of triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, Polygon

from palmar.geometry.planar_set import areal

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
GRID = 1e-6
"""Of the corners (m)."""


@dataclass(frozen=True)
class Mesh:
    """Corners (V, 3), m, and triangles (T, 3) of their numbers, counter-clockwise seen from outside."""

    corners: Floats
    triangles: Integers

    @property
    def volume(self) -> float:
        """Enclosed volume (m^3): the sum of the signed tetrahedra to the origin."""
        a, b, c = (self.corners[self.triangles[:, k]] for k in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def prism(base: MultiPolygon, low: float, high: float) -> Mesh:
    """The set between the heights ``low`` and ``high`` (m); each of its parts is a closed surface of its own.

    Corners are rounded to ``GRID``, so that files in single precision keep them apart.
    """
    corners: list[Floats] = [np.zeros((0, 3))]
    triangles: list[Integers] = [np.zeros((0, 3), np.int64)]
    count = 0
    for part in areal(shapely.set_precision(base, GRID)).geoms:
        points, caps, edges = _flat(part)
        n = len(points)
        for z in (low, high):
            corners.append(np.column_stack([points, np.full(n, z)]))
        begin, end = edges.T
        walls = np.concatenate([np.stack([begin, end, end + n], 1), np.stack([begin, end + n, begin + n], 1)])
        triangles += [count + caps[:, ::-1], count + n + caps, count + walls]
        count += 2 * n
    return Mesh(np.concatenate(corners), np.concatenate(triangles))


def _flat(part: Polygon) -> tuple[Floats, Integers, Integers]:
    """Corners (N, 2) of a polygon, counter-clockwise triangles over it (T, 3), edges (E, 2), the inside to their left."""
    turned = shapely.geometry.polygon.orient(part)
    rings = [np.asarray(each.coords)[:-1] for each in (turned.exterior, *turned.interiors)]
    points = np.concatenate(rings)
    number = {(x, y): k for k, (x, y) in enumerate(points.tolist())}
    edges = []
    for ring in rings:
        here = np.array([number[x, y] for x, y in ring.tolist()])
        edges.append(np.stack([here, np.roll(here, -1)], axis=1))
    pieces = shapely.get_parts(shapely.constrained_delaunay_triangles(turned))
    found = np.array([[number[x, y] for x, y in list(each.exterior.coords)[:3]] for each in pieces], np.int64)
    a, b, c = (points[found[:, k]] for k in range(3))
    clockwise = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) < (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    found[clockwise] = found[clockwise][:, ::-1]
    return points, found, np.concatenate(edges)
