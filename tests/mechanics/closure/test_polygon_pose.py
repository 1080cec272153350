"""Poses of a squeezed polygon against Shapely's distances."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, MultiPoint, Polygon
from shapely.geometry.polygon import orient

from palmar.geometry.polygon import turned
from palmar.mechanics.closure.polygon_pose import squeezed_pose
from palmar.mechanics.closure.sizing import Grip

POLYGONS = st.lists(st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)), min_size=4, max_size=9)


@settings(max_examples=150, deadline=None)
@given(
    points=POLYGONS,
    orientation=st.floats(-pi, pi),
    half_palm=st.floats(0.3, 1.5),
    half_thickness=st.sampled_from([0.0, 0.05]),
    lift=st.sampled_from([0.0, 0.2]),
)
def test_both_fingers_touch_and_the_polygon_is_at_its_height(
    points: list[tuple[float, float]], orientation: float, half_palm: float, half_thickness: float, lift: float
) -> None:
    hull = MultiPoint(points).convex_hull
    if not isinstance(hull, Polygon) or hull.area < 0.01:
        return
    corners = orient(hull).exterior.coords[:-1]
    pose = squeezed_pose(corners, orientation, Grip(half_palm, 1.0, half_thickness), lift)
    if pose is None or pose.psi < 0.01:
        return
    placed = Polygon(turned(corners, orientation) + pose.at)
    assert placed.bounds[1] == pytest.approx(lift, abs=1e-12)
    for side in (1.0, -1.0):
        tip = (side * (half_palm + cos(pose.psi)), sin(pose.psi))
        finger = LineString([(side * half_palm, 0.0), tip])
        assert finger.distance(placed) == pytest.approx(half_thickness, abs=1e-7)


def test_a_square_lies_in_the_middle() -> None:
    square = [(-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2)]
    pose = squeezed_pose(square, 0.0, Grip(0.5, 1.0))
    assert pose is not None
    assert pose.at == pytest.approx((0.0, 0.2), abs=1e-12)
    assert pose.psi == pytest.approx(pi - np.arctan2(0.4, 0.3))
