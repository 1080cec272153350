"""Rings cut at two lines against the general overlay of polygons."""

import numpy as np
import pytest
import shapely
from shapely import Polygon, affinity

from palmar.geometry.planar_set import with_mirror_image
from palmar.geometry.quadrant import in_quadrant


def overlay(ring, level):
    whole = shapely.make_valid(Polygon(ring), method="structure")
    return shapely.intersection(whole, shapely.box(0.0, level, 10.0, 10.0))


@pytest.mark.parametrize("seed", range(40))
def test_a_cut_ring_encloses_what_the_overlay_says(seed):
    rng = np.random.default_rng(seed)
    around = np.sort(rng.uniform(0.0, 2.0 * np.pi, 30))
    out = rng.uniform(0.2, 1.5, 30)
    ring = np.column_stack([out * np.cos(around), out * np.sin(around)]) + rng.uniform(-0.7, 0.7, 2)
    found = in_quadrant(ring.copy(), 0.1, 1e-12)
    assert found.is_valid
    assert found.symmetric_difference(overlay(ring, 0.1)).area < 1e-12


def test_what_lies_outside_is_empty_and_what_lies_inside_is_kept():
    ring = np.array([[1.0, 1.0], [2.0, 1.0], [2.0, 2.0]])
    assert in_quadrant(ring - 5.0, 0.1, 1e-12).is_empty
    assert in_quadrant(ring, 0.1, 1e-12).equals(Polygon(ring))


def test_corners_almost_on_the_axis_are_put_on_it():
    ring = np.array([[-1e-17, 0.5], [1.0, 0.5], [1.0, 1.0], [1e-17, 1.0]])
    assert in_quadrant(ring, 0.1, 1e-12).bounds == (0.0, 0.5, 1.0, 1.0)


@pytest.mark.parametrize(
    "ring",
    [
        [(0, 1), (2, 1), (3, 2), (0, 3)],
        [(0, 1), (0, 2), (0, 3), (2, 3), (1, 1)],
        [(1, 1), (2, 1), (2, 2), (1, 2)],
        [(0, 1), (2, 2), (2, 3)],
        [(0, 1), (2, 1), (2, 4), (0, 4), (0, 3), (1, 3), (1, 2), (0, 2)],
    ],
)
def test_a_half_and_its_mirror_image_are_their_union(ring):
    for turned in range(len(ring)):
        for way in (1, -1):
            half = Polygon((ring[turned:] + ring[:turned])[::way])
            found = with_mirror_image(half)
            union = half | affinity.scale(half, xfact=-1.0, origin=(0.0, 0.0))
            assert found.is_valid
            assert found.area == pytest.approx(2.0 * half.area)
            assert found.symmetric_difference(union).area == 0.0
