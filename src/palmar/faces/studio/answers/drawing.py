"""Hand and object as the page draws them: points in mm, in the frame of the hand."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import ceil, degrees, log10
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, MultiPolygon, Point
from shapely.geometry.base import BaseGeometry

from palmar.faces.plots.hand import finger_points, object_reach
from palmar.geometry.planar_set import areal, coordinates
from palmar.geometry.polygon import turned
from palmar.models.case import Case
from palmar.models.hand import Hand
from palmar.models.objects import Disk

MM = 1e3
THIN, ROUND = 1e-4, 1e-5
"""How far an outline may be moved, and where coordinates end, as shares of the finger's length."""
QUARTER = 16
Floats = NDArray[np.float64]


def drawing(case: Case) -> dict[str, Any]:
    """The open hand, the object at its start, a wall, and the box (mm) around all of these."""
    hand, joints = case.hand, case.open_joints
    right, left = finger_points(hand, joints), finger_points(hand, joints, left=True)
    sides = [_outline(hand, each) for each in (right, left)]
    at, theta = case.start.at, case.start.theta
    outline = _object_outline(case) + np.array(at)
    wall = case.support.wall
    boxes = [outline, *(each + s * hand.half_thickness for each in (right, left) for s in (-1.0, 1.0))]
    thing: dict[str, Any] = {"shape": case.object.shape, "at_mm": millimetres(at), "theta_deg": degrees(theta)}
    if isinstance(case.object, Disk):
        thing["radius_mm"] = MM * case.object.radius
    else:
        thing["vertices_mm"] = millimetres(case.object.vertices)
    return {
        "hand": {
            "half_palm_mm": MM * hand.half_palm,
            "palm_mm": millimetres([[-hand.half_palm, 0.0], [hand.half_palm, 0.0]]),
            "right_mm": millimetres(right),
            "left_mm": millimetres(left),
            "thickness_mm": MM * hand.finger_thickness,
            "right_outline_mm": sides[0],
            "left_outline_mm": sides[1],
            "open_deg": [degrees(each) for each in joints],
            "reach_mm": MM * hand.finger_length,
        },
        "object": {**thing, "outline_mm": millimetres(outline)},
        "wall_mm": None if wall is None else MM * wall,
        "bounds_mm": bounds(boxes, wall),
    }


def bounds(sets: Iterable[Floats], wall: float | None = None) -> list[float]:
    """The box [left, bottom, right, top] (mm) around sets of points (m)."""
    points = np.concatenate(list(sets))
    (left, bottom), (right, top) = points.min(axis=0), points.max(axis=0)
    return [MM * float(each) for each in (left, bottom, right, top if wall is None else max(top, wall))]


def millimetres(points: Sequence[Any] | Floats) -> Any:
    """Points (m) of any nesting in mm, to the nanometre."""
    rounded: Any = np.round(MM * np.asarray(points, dtype=float), 6).tolist()
    return rounded


def shown(region: BaseGeometry, length: float) -> list[list[list[list[float]]]]:
    """A set (m) as multipolygon coordinates (mm), thinned to what a screen shows of a hand of this finger length (m)."""
    thin: MultiPolygon = areal(region.simplify(THIN * length, preserve_topology=False))
    digits = max(0, ceil(-log10(ROUND * MM * length)))
    return [[np.round(MM * np.asarray(ring), digits).tolist() for ring in polygon] for polygon in coordinates(thin)]


def finger_lines(hand: Hand, right: Sequence[float], left: Sequence[float]) -> tuple[Floats, Floats]:
    """Joints and tip (links + 1, 2) in m of both fingers at joint angles (rad)."""
    return finger_points(hand, right), finger_points(hand, left, left=True)


def _outline(hand: Hand, points: Floats) -> list[list[float]] | None:
    """The capsules' outline (mm) of a thick finger."""
    if hand.finger_thickness == 0.0:
        return None
    outline: list[list[float]] = millimetres(
        shapely.get_coordinates(LineString(points).buffer(hand.half_thickness, quad_segs=QUARTER).exterior)
    )
    return outline


def _object_outline(case: Case) -> Floats:
    """The object's outline (m) about its origin, turned as at the start, closed."""
    if isinstance(case.object, Disk):
        return shapely.get_coordinates(Point(0.0, 0.0).buffer(object_reach(case.object), quad_segs=QUARTER).exterior)
    corners = turned(case.object.vertices, case.start.theta)
    return np.concatenate([corners, corners[:1]])
