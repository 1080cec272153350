"""Convex outlines: accepted, cleaned or refused; centroid against Shapely."""

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from palmar.geometry.polygon import area_centroid, checked_convex, turned

points = st.lists(st.tuples(st.floats(-1, 1), st.floats(-1, 1)), min_size=3, max_size=20)


@given(points, st.booleans())
def test_convex_hulls_are_accepted_in_either_direction_and_kept_counter_clockwise(given_points, clockwise):
    hull = shapely.convex_hull(shapely.MultiPoint(given_points))
    assume(hull.geom_type == "Polygon" and hull.area > 1e-3)
    ring = list(shapely.geometry.polygon.orient(hull, -1.0 if clockwise else 1.0).exterior.coords)[:-1]
    corners = checked_convex(ring)
    assert shapely.LinearRing(corners).is_ccw
    assert shapely.Polygon(corners).area == pytest.approx(hull.area, rel=1e-9)
    assert area_centroid(corners) == pytest.approx((hull.centroid.x, hull.centroid.y), abs=1e-9)


def test_a_pentagram_turns_twice_and_is_refused():
    star = [(np.cos(4 * np.pi * k / 5), np.sin(4 * np.pi * k / 5)) for k in range(5)]
    with pytest.raises(ValueError, match="convex"):
        checked_convex(star)


def test_turning_moves_vertices_counter_clockwise():
    assert turned([(1.0, 0.0)], np.pi / 2) == pytest.approx(np.array([[0.0, 1.0]]), abs=1e-15)
