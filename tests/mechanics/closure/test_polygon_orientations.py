"""Orientations at which a polygon is held: brute force, symmetry, scale, and regular polygons on their way to the disk."""

from math import pi

import numpy as np
import pytest

from palmar.mechanics.closure.disk_2_2 import structural_radii
from palmar.mechanics.closure.orientation_set import contains, total_measure
from palmar.mechanics.closure.polygon_orientations import required_friction_angle, structural_orientations
from reference import polygon_holding


def random_polygon(rng):
    while True:
        angles = np.sort(rng.uniform(0.0, 2.0 * pi, rng.integers(3, 8)))
        if np.max(np.diff(np.append(angles, angles[0] + 2.0 * pi))) < 3.0:
            return rng.uniform(0.1, 1.2) * np.column_stack([np.cos(angles), rng.uniform(0.4, 1.0) * np.sin(angles)])


@pytest.mark.parametrize("seed", range(12))
def test_brute_force_holds_the_same_orientations(seed):
    rng = np.random.default_rng(seed)
    polygon, beta, theta = random_polygon(rng), rng.uniform(0.1, 1.5), rng.uniform(0.0, 2.0 * pi, 200)
    held = contains(structural_orientations(polygon, beta, 1.0), theta)
    cases = polygon_holding.cases([polygon] * 200, theta, np.full(200, beta), np.zeros(200))
    margin = polygon_holding.palm_margin(cases)
    clear = np.abs(margin) > 1e-3
    assert clear.sum() > 100
    assert np.array_equal(held[clear], margin[clear] > 0.0)


def test_mirrored_polygons_are_held_at_mirrored_orientations_and_scale_does_not_matter():
    rng = np.random.default_rng(5)
    polygon, theta = random_polygon(rng), rng.uniform(0.0, 2.0 * pi, 300)
    one = contains(structural_orientations(polygon, 0.6, 1.0), theta)
    mirrored = (polygon * [-1.0, 1.0])[::-1]
    assert np.array_equal(contains(structural_orientations(mirrored, 0.6, 1.0), -theta), one)
    assert np.array_equal(contains(structural_orientations(1e3 * polygon, 600.0, 1e3), theta), one)


@pytest.mark.parametrize(("share", "everywhere"), [(0.99, True), (1.02, False)])
def test_a_regular_polygon_of_many_corners_is_held_as_the_disk(share, everywhere):
    largest = float(structural_radii(0.6, 1.0).max)
    angles = 2.0 * pi * np.arange(128) / 128
    polygon = share * largest * np.column_stack([np.cos(angles), np.sin(angles)])
    measure = total_measure(structural_orientations(polygon, 0.6, 1.0))
    assert measure == pytest.approx(2.0 * pi if everywhere else 0.0)


def test_the_friction_that_is_needed_is_none_where_it_is_held_without():
    polygon = random_polygon(np.random.default_rng(8))
    theta = np.linspace(0.0, 6.0, 7)
    held = contains(structural_orientations(polygon, 0.8, 1.0), theta)
    needed = required_friction_angle(polygon, theta, 0.8, 1.0)
    assert np.array_equal(needed == 0.0, held)
