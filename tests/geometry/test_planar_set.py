"""Planar sets: views, coordinates, growth and the inscribed circle."""

import numpy as np
import pytest
import shapely
from shapely import MultiPolygon, Polygon

from palmar.geometry.planar_set import EMPTY, areal, coordinates, grown, inscribed_circle, outline, seen_from_object

BOX = MultiPolygon([shapely.box(0.0, 1.0, 4.0, 3.0)])


def test_the_view_from_the_object_is_the_point_reflection():
    assert shapely.normalize(seen_from_object(BOX)) == shapely.normalize(
        MultiPolygon([shapely.box(-4.0, -3.0, 0.0, -1.0)])
    )


def test_coordinates_close_their_rings_and_wind_counter_clockwise():
    (ring,) = coordinates(MultiPolygon([Polygon([(0, 0), (0, 1), (1, 0)])]))[0]
    assert ring[0] == ring[-1]
    assert shapely.LinearRing(ring).is_ccw
    assert coordinates(EMPTY) == []


def test_only_areas_are_kept():
    mixed = shapely.GeometryCollection(
        [shapely.Point(0, 0), shapely.box(0, 0, 1, 1), shapely.LineString([(0, 0), (1, 1)])]
    )
    assert areal(mixed).area == 1.0
    bow_tie = outline(np.array([(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]))
    assert bow_tie.area == pytest.approx(0.5)


def test_a_grown_set_lies_inside_the_true_sum_by_at_most_the_bound():
    bigger, bound = grown(BOX, 0.5, 1e-4)
    assert bound <= 1e-4
    true_area = 8.0 + 0.5 * 12.0 + np.pi * 0.25
    assert true_area - np.pi * 2 * 0.5 * bound <= bigger.area <= true_area


def test_the_inscribed_circle_is_the_largest_and_prefers_the_axis():
    wide = MultiPolygon([shapely.box(-4.0, 1.0, 4.0, 3.0)])
    circle = inscribed_circle(wide, 1e-6)
    assert circle.radius == pytest.approx(1.0, abs=1e-6)
    assert circle.centre == pytest.approx((0.0, 2.0), abs=1e-5)


def test_the_inscribed_circle_ignores_the_seam_between_touching_parts():
    halves = MultiPolygon([shapely.box(-1.0, 0.0, 0.0, 2.0), shapely.box(0.0, 0.0, 1.0, 2.0)])
    circle = inscribed_circle(halves, 1e-6)
    assert circle.radius == pytest.approx(1.0, abs=1e-5)
