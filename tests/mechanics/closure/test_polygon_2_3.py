"""The circle test: exact circles, its verdict, and where it may be relied on."""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest

from palmar.mechanics.closure.disk_2_2 import structural_radii
from palmar.mechanics.closure.orientation_set import contains, total_measure
from palmar.mechanics.closure.polygon_2_3 import SOUND_UP_TO, any_orientation, inscribed_radius
from palmar.mechanics.closure.polygon_orientations import structural_orientations


def rectangle(width, height):
    return 0.5 * np.array([(-width, -height), (width, -height), (width, height), (-width, height)])


def regular(corners, radius):
    return radius * np.array([(cos(2 * pi * k / corners), sin(2 * pi * k / corners)) for k in range(corners)])


def test_circles_of_known_shapes():
    test = any_orientation(rectangle(3.0, 1.0), 0.0, 2.0, 0.4, structural=True)
    assert (test.inscribed, test.enclosing) == (pytest.approx(0.5), pytest.approx(sqrt(10.0) / 2))
    triangle = np.array([(0.0, 0.0), (3.0, 0.0), (0.0, 4.0)])
    assert inscribed_radius(triangle) == pytest.approx(1.0)
    assert inscribed_radius(1e-6 * regular(7, 1.0) + 5.0) == pytest.approx(1e-6 * cos(pi / 7), rel=1e-6)


@pytest.mark.parametrize(("low", "high", "passed"), [(0.4, 1.6, True), (0.6, 1.6, False), (0.4, 1.5, False)])
def test_the_verdict(low, high, passed):
    assert any_orientation(rectangle(3.0, 1.0), low, high, 0.4, structural=True).passed is passed


def test_a_passing_rectangle_that_is_not_held_upright_beyond_the_sound_range():
    """beta = 0.5, a 3:1 rectangle with an enclosing circle of 0.999 R_max is lost within about 7 degrees of upright."""
    beta, length = 0.5, 1.0
    largest = float(structural_radii(beta, length).max)
    side = 2.0 * 0.999 * largest / sqrt(10.0)
    bar = rectangle(side, 3.0 * side)
    test = any_orientation(bar, 0.0, largest, beta, structural=True)
    assert (test.passed, test.sound) == (True, False)
    held = structural_orientations(bar, beta, length)
    near, far = np.radians([0.0, 3.0, 6.5]), np.radians([8.0, 20.0, 90.0])
    assert not contains(held, near).any()
    assert contains(held, far).all()


def test_within_the_sound_range_passing_polygons_are_held_at_every_orientation():
    rng = np.random.default_rng(7)
    for _ in range(12):
        beta = rng.uniform(0.1, SOUND_UP_TO)
        angles = np.sort(rng.uniform(0, 2 * pi, rng.integers(3, 8)))
        if np.max(np.diff(np.append(angles, angles[0] + 2 * pi))) > 3.0:
            continue
        polygon = 0.999 * beta * np.column_stack([np.cos(angles), np.sin(angles)])
        test = any_orientation(polygon, 0.0, beta, beta, structural=True)
        assert test.passed
        assert test.sound
        assert total_measure(structural_orientations(polygon, beta, 1.0)) == pytest.approx(2 * pi)
