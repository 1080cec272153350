"""Planar sets as Shapely polygons: clean-up, mirror images, exchange of coordinates, inscribed circle."""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, ceil, cos, pi

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, Polygon, affinity
from shapely.geometry.base import BaseGeometry

Coordinates = list[list[list[list[float]]]]
"""GeoJSON MultiPolygon coordinates: polygons of rings of [x, y], the first ring the outline."""

EMPTY = MultiPolygon()


@dataclass(frozen=True)
class Circle:
    """Centre (x, y) and radius, m."""

    centre: tuple[float, float]
    radius: float


def areal(geometry: BaseGeometry) -> MultiPolygon:
    """Only the two-dimensional parts of a geometry."""
    if isinstance(geometry, Polygon):
        return MultiPolygon([geometry]) if geometry.area > 0.0 else EMPTY
    parts = [part for part in shapely.get_parts(geometry) if isinstance(part, Polygon) and part.area > 0.0]
    nested = [piece for part in shapely.get_parts(geometry) if isinstance(part, MultiPolygon) for piece in part.geoms]
    return MultiPolygon(parts + nested)


def outline(points: NDArray[np.float64]) -> MultiPolygon:
    """The set enclosed by a closed polyline (N, 2); crossings of the line with itself are resolved."""
    shape = Polygon(points)
    return areal(shape if shape.is_valid else shapely.make_valid(shape, method="structure"))


def with_mirror_image(half: BaseGeometry) -> MultiPolygon:
    """A set together with its mirror image in the y axis."""
    whole = _stitched(half)
    if whole is not None:
        return MultiPolygon([whole])
    return areal(shapely.union(half, affinity.scale(half, xfact=-1.0, origin=(0.0, 0.0))))


def _stitched(half: BaseGeometry) -> Polygon | None:
    """A polygon right of the y axis that lies on it with one edge, joined to its mirror image there; None for others."""
    parts = half.geoms if isinstance(half, MultiPolygon) else [half]
    if len(parts) != 1 or not isinstance(parts[0], Polygon) or parts[0].is_empty or parts[0].interiors:
        return None
    ring = shapely.get_coordinates(parts[0].exterior)[:-1]
    on = ring[:, 0] == 0.0
    ends = np.flatnonzero(on & ~np.concatenate([on[1:], on[:1]]))
    if len(ends) != 1 or on.sum() < 2 or ring[:, 0].min() < 0.0:
        return None
    # From the last corner on the axis around to the first one.
    begin = int(ends[0])
    chain = np.concatenate([ring[begin:], ring[:begin]])[: len(ring) - int(on.sum()) + 2]
    return Polygon(np.concatenate([chain, chain[-2:0:-1] * np.array([-1.0, 1.0])]))


def seen_from_object(region: MultiPolygon) -> MultiPolygon:
    """Object positions in the hand frame -> hand positions relative to the object, for the same hand orientation."""
    return areal(affinity.scale(region, xfact=-1.0, yfact=-1.0, origin=(0.0, 0.0)))


def grown(region: MultiPolygon, distance: float, tolerance: float) -> tuple[MultiPolygon, float]:
    """Minkowski sum with a disk of radius ``distance`` (m), and the bound (m) by which flattened arcs lie inside it."""
    quarter = max(1, ceil(pi / (4.0 * acos(max(1.0 - tolerance / distance, 0.0)))))
    return areal(region.buffer(distance, quad_segs=quarter)), distance * (1.0 - cos(pi / (4.0 * quarter)))


def coordinates(region: MultiPolygon) -> Coordinates:
    """GeoJSON MultiPolygon coordinates, outlines counter-clockwise, holes clockwise."""
    rings = [shapely.geometry.polygon.orient(polygon) for polygon in region.geoms]
    return [
        [[[float(x), float(y)] for x, y in ring.coords] for ring in (polygon.exterior, *polygon.interiors)]
        for polygon in rings
    ]


def inscribed_circle(region: MultiPolygon, tolerance: float) -> Circle:
    """A largest circle inside a set that is not empty; its radius is within ``tolerance`` (m) of the largest.

    Where circles tie, one on the y axis is preferred: the sets here are mirror-symmetric.
    """
    seam_free = areal(shapely.union_all(list(region.geoms)))
    spokes = shapely.maximum_inscribed_circle(seam_free, tolerance)
    found = shapely.get_point(spokes, 0)
    centred = shapely.Point(0.0, found.y)
    edge = seam_free.boundary
    on_axis = seam_free.contains(centred) and edge.distance(centred) >= edge.distance(found) - tolerance
    centre = centred if on_axis else found
    return Circle((float(centre.x), float(centre.y)), float(edge.distance(centre)))


def uniform_places(area: MultiPolygon, count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Places (count, 2) uniform over a set that is not empty, by rejection from its bounding box."""
    left, low, right, high = area.bounds
    found: list[NDArray[np.float64]] = []
    shapely.prepare(area)
    while sum(map(len, found)) < count:
        tried = np.column_stack([rng.uniform(left, right, count), rng.uniform(low, high, count)])
        found.append(tried[shapely.contains_xy(area, tried)])
    return np.concatenate(found)[:count]
