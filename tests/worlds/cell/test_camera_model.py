"""The pinhole camera against its own definition."""

import numpy as np
import pytest

from palmar.worlds.cell.camera_model import looking

CAMERA = looking(np.array([0.5, 0.6, 0.2]), np.array([0.5, 0.0, -0.2]), 30.0, (320, 240))


def test_the_angle_of_view_covers_the_height():
    """A point at half the angle above the axis ahead is seen half a picture above the middle."""
    right, down, ahead = CAMERA.turn.T
    assert right @ (0.0, 0.0, 1.0) == pytest.approx(0.0, abs=1e-12)
    assert np.cross(right, down) == pytest.approx(ahead)
    up = CAMERA.place + 2.0 * (ahead - np.tan(np.radians(15.0)) * down)
    assert CAMERA.pixels(up) == pytest.approx([159.5, 119.5 - 120.0])


def test_a_ray_goes_through_what_its_pixel_shows():
    pixels = np.random.default_rng(1).uniform(0.0, 240.0, (50, 2))
    for far in (0.3, 2.0):
        assert CAMERA.pixels(CAMERA.place + far * CAMERA.rays(pixels)) == pytest.approx(pixels, abs=1e-9)


def test_a_camera_that_is_moved_with_what_it_sees_sees_the_same():
    point, shift = np.array([0.52, 0.03, -0.25]), np.array([0.01, -0.02, 0.03])
    there = CAMERA.pixels(point)
    assert CAMERA.moved(shift, np.zeros(3)).pixels(point + shift) == pytest.approx(there)
    longer = CAMERA.moved(np.zeros(3), np.zeros(3), 0.01).pixels(point)
    assert longer - CAMERA.middle == pytest.approx(1.01 * (there - CAMERA.middle))
    turned = CAMERA.moved(np.zeros(3), np.array([0.0, 0.0, 0.5 * np.pi])).pixels(point)
    east, south = there - CAMERA.middle
    assert turned - CAMERA.middle == pytest.approx([south, -east])
