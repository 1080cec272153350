"""Regions shrunk by an uncertainty, against sets whose answer is known and against trial."""

import numpy as np
import pytest
import shapely
from shapely import MultiPolygon, Point, Polygon, affinity, box

from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.regions.shrink import enclosing_disk, fits, shrunk

ANGLE = Polygon([(0, 0), (1, 0), (1, 0.2), (0.2, 0.2), (0.2, 1), (0, 1)])


def test_a_box_shrinks_by_a_box():
    found = shrunk(MultiPolygon([box(0, 0, 4, 3)]), box(-0.5, -0.5, 1.0, 0.5))
    assert found.equals(box(0.5, 0.5, 3.0, 2.5))


def test_an_angle_may_stand_around_a_hole():
    room = MultiPolygon([box(0, 0, 4, 3) - box(2.0, 1.0, 2.1, 1.1)])
    found = shrunk(room, ANGLE)
    assert found.covers(Point(1.75, 0.75))
    assert not found.covers(Point(1.95, 0.75))


def test_a_disk_is_a_negative_buffer():
    region = build_region(open_case("testbed_table")[1]).centre
    disk = Point(0.0, 0.0).buffer(0.03, quad_segs=16)
    expected = region.buffer(-0.03, quad_segs=64)
    assert shrunk(region, disk).area == pytest.approx(expected.area, rel=2e-3)
    assert enclosing_disk(disk).radius == pytest.approx(0.03)
    assert enclosing_disk(box(0, 0, 1, 1)) is None


@pytest.mark.parametrize("errors", [affinity.scale(ANGLE, 0.1, 0.1, origin=(0, 0)), box(-0.04, -0.02, 0.04, 0.02)])
def test_every_place_left_fits_and_none_beyond(errors):
    region = build_region(open_case("testbed_table")[1]).centre
    left = shrunk(region, errors)
    rng = np.random.default_rng(3)
    places = np.column_stack([rng.uniform(-0.35, 0.35, 300), rng.uniform(0.0, 0.4, 300)])
    for place in places:
        assert fits(region, errors, tuple(place), 1e-9) or not left.covers(Point(place))
        assert left.buffer(1e-9).covers(Point(place)) or not fits(region, errors, tuple(place))
    assert shapely.contains_xy(left, places).sum() > 30
