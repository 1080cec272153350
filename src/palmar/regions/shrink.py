"""A region shrunk by an uncertainty: the nominal places from which the whole uncertainty lies inside (Minkowski erosion).

With U the set of errors about the nominal place, the places are {p : p + U in R}, what R minus the sum of its outline and
the mirrored -U leaves. For convex U that sum is the union of the hulls swept along the outline's edges; any other
U is a union of triangles, all of which must fit.
"""

from __future__ import annotations

from itertools import pairwise
from math import pi

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, Polygon, affinity
from shapely.geometry.base import BaseGeometry

from palmar.geometry.planar_set import Circle, areal

CONVEX = 1e-9
"""A set whose convex hull is larger by at most this share counts as convex."""
ROUND = 0.99
"""A regular polygon that fills this share of the circle around it is taken for that circle."""


def shrunk(region: MultiPolygon, uncertainty: BaseGeometry) -> MultiPolygon:
    """The places (m) about which the uncertainty, a set of errors (m), lies in the region; exact for polygons."""
    whole = shapely.union_all(list(region.geoms))
    return areal(shapely.intersection_all([_places(whole, piece) for piece in convex_pieces(uncertainty)]))


def fits(region: MultiPolygon, uncertainty: BaseGeometry, at: tuple[float, float], slack: float = 0.0) -> bool:
    """Whether the uncertainty about a place lies in the region, up to ``slack`` (m)."""
    whole = shapely.union_all(list(region.geoms))
    if slack > 0.0:
        whole = whole.buffer(slack)
    return bool(whole.covers(affinity.translate(uncertainty, *at)))


def enclosing_disk(uncertainty: BaseGeometry) -> Circle | None:
    """The circle through all corners of a set that is as good as a disk, None for any other set."""
    if uncertainty.geom_type != "Polygon":
        return None
    middle = uncertainty.centroid
    corners = shapely.get_coordinates(uncertainty)
    distances = np.hypot(corners[:, 0] - middle.x, corners[:, 1] - middle.y)
    radius = float(distances.max())
    if distances.min() < radius * (1.0 - CONVEX) or uncertainty.area < ROUND * pi * radius**2:
        return None
    return Circle((middle.x, middle.y), radius)


def convex_pieces(uncertainty: BaseGeometry) -> list[Polygon]:
    """Convex polygons that together cover the set and nothing else."""
    hull = uncertainty.convex_hull
    if hull.area <= uncertainty.area * (1.0 + CONVEX):
        return [areal(hull).geoms[0]]
    pieces = [shapely.constrained_delaunay_triangles(part) for part in areal(uncertainty).geoms]
    return [triangle for piece in pieces for triangle in shapely.get_parts(piece)]


def _places(whole: BaseGeometry, piece: Polygon) -> BaseGeometry:
    """Places about which a convex piece lies in the set: it does not reach over the outline, and its middle is inside."""
    middle = np.asarray(piece.centroid.coords[0])
    mirrored = -(np.asarray(piece.exterior.coords)[:-1] - middle)
    outline = np.asarray([edge for line in _lines(whole) for edge in pairwise(line)])
    swept = np.concatenate([outline[:, :1] + mirrored, outline[:, 1:] + mirrored], axis=1)
    rim = shapely.union_all(shapely.convex_hull(shapely.multipoints(list(swept))))
    return affinity.translate(whole.difference(rim), *(-middle))


def _lines(whole: BaseGeometry) -> list[NDArray[np.float64]]:
    boundary = whole.boundary
    return [np.asarray(part.coords) for part in shapely.get_parts(boundary)]
