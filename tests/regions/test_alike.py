"""Orientations that are the same to a hand: which they are, and that the mechanics agrees."""

from math import pi, radians

import numpy as np
import pytest

from palmar.mechanics.pushing.closing_steps import carry_all
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.polygon_contacts import disk_body, polygon_body
from palmar.mechanics.pushing.slider import polygon_slider, pressed_slider, slider_body
from palmar.regions.alike import different_orientations

FULL = np.linspace(0.0, 2.0 * pi, 72, endpoint=False)


def regular(corners, phase=0.0):
    angles = phase + 2.0 * pi * np.arange(corners) / corners
    return 0.04 * np.column_stack([np.cos(angles), np.sin(angles)])


RECTANGLE = np.array([[-0.04, -0.027], [0.04, -0.027], [0.04, 0.027], [-0.04, 0.027]])
PARALLELOGRAM = np.array([[-0.05, -0.02], [0.03, -0.02], [0.05, 0.02], [-0.03, 0.02]])
KITE = np.array([[0.05, 0.0], [0.0, 0.025], [-0.02, 0.0], [0.0, -0.025]])
ODD = np.array([[-0.035, -0.025], [0.038, -0.03], [0.03, 0.028], [-0.022, 0.033]])


@pytest.mark.parametrize(
    ("corners", "count", "mirrored"),
    [
        (regular(3), 24, True),
        (regular(4, pi / 4.0), 18, True),
        (regular(4, 0.1), 18, False),
        (regular(5), 72, True),
        (regular(6, radians(20.0)), 12, True),
        (RECTANGLE, 36, True),
        (PARALLELOGRAM, 36, False),
        (KITE - np.array([0.01, 0.0]), 72, True),
        (ODD, 72, False),
    ],
)
def test_a_full_turn_in_steps_of_five_degrees(corners, count, mirrored):
    found = different_orientations(polygon_body(corners, 0.5), (0.0, 0.0), FULL, True)
    assert (len(found.thetas), found.mirrored) == (count, mirrored)
    assert not different_orientations(polygon_body(corners, 0.5), (0.0, 0.0), FULL, False).mirrored


def test_single_orientations_may_be_their_own_mirror_images():
    body = polygon_body(RECTANGLE, 0.5)
    for degrees, mirrored in ((0.0, True), (90.0, True), (20.0, False)):
        assert different_orientations(body, (0.0, 0.0), np.array([radians(degrees)]), True).mirrored is mirrored


def test_a_frame_off_the_centre_of_pressure_sees_turned_copies_elsewhere():
    body = polygon_body(RECTANGLE, 0.5)
    aside = different_orientations(body, (0.01, 0.0), FULL, True)
    askew = different_orientations(body, (0.01, 0.003), FULL, True)
    assert (len(aside.thetas), aside.mirrored) == (72, True)
    assert (len(askew.thetas), askew.mirrored) == (72, False)


def test_nothing_is_presumed_of_other_pressures_and_of_disks():
    points, weights = RECTANGLE * 0.9, np.array([0.1, 0.2, 0.3, 0.4])
    slider = pressed_slider(RECTANGLE, 0.0, (points, weights, np.full(4, 0.001)), (0.0, 0.0))
    for body in (slider_body(slider, 0.5), disk_body(0.03, 0.5)):
        found = different_orientations(body, (0.0, 0.0), FULL, True)
        assert (len(found.thetas), found.mirrored) == (72, False)


@pytest.mark.parametrize(("corners", "turn", "double"), [(regular(4), pi / 2.0, 0.0), (RECTANGLE, pi, pi)])
def test_turned_copies_and_mirror_images_end_alike(corners, turn, double):
    slider = polygon_slider(corners, (0.0, 0.0))
    motion, body = hand_motion(0.06, [0.244]), slider_body(slider, 0.5)
    rng = np.random.default_rng(1)
    starts = np.column_stack(
        [rng.uniform(-0.3, 0.3, 150), rng.uniform(0.03, 0.3, 150), rng.uniform(0.0, 2.0 * pi, 150)]
    )
    codes, ends, _ = carry_all(motion, body, starts)
    turned, _, _ = carry_all(motion, body, starts + np.array([0.0, 0.0, turn]))
    images = starts * np.array([-1.0, 1.0, -1.0]) + np.array([0.0, 0.0, pi - double])
    mirrored, other, _ = carry_all(motion, body, images)
    assert (codes == turned).mean() > 0.98
    assert (codes == mirrored).mean() > 0.98
    settled = (codes == mirrored) & (codes <= 2)
    assert np.median(np.abs(ends[settled, 0] + other[settled, 0])) < 1e-6
