"""What fingers feel shrinks the set of possible places, never past the true one."""

import numpy as np
import pytest

from palmar.behaviours.cell.belief import after_touch, around
from palmar.behaviours.cell.table_pick import circumcentre, through

TIPS = 0.08 * np.array([[np.cos(a), np.sin(a)] for a in (0.5 * np.pi, 7 * np.pi / 6, -np.pi / 6)])
RADIUS, TIP = 0.03, 0.009


def test_the_true_place_stays_in_the_set():
    random = np.random.default_rng(2)
    shrunk = 0
    for _ in range(300):
        truth = 0.05 * np.sqrt(random.random()) * np.array([np.cos(a := 6.28 * random.random()), np.sin(a)])
        touched = tuple(bool(each) for each in np.linalg.norm(TIPS - truth, axis=1) < RADIUS + TIP)
        if not any(touched):
            continue
        before = around((0.0, 0.0), 0.05)
        left = after_touch(before, TIPS, touched, RADIUS, TIP)
        shrunk += 1
        assert len(left.places) < len(before.places)
        assert np.linalg.norm(left.places - truth, axis=1).min() < 0.05 / 30.0
        assert np.linalg.norm(left.middle - truth) <= left.radius + 0.05 / 30.0
    assert shrunk > 30


def test_the_middle_is_that_of_the_least_enclosing_circle():
    half = around((0.1, 0.2), 0.05)
    assert half.middle == pytest.approx([0.1, 0.2], abs=2e-3)
    assert half.radius == pytest.approx(0.05, rel=0.03)


def test_a_touch_that_contradicts_the_set_starts_it_anew_at_the_finger():
    left = after_touch(around((0.0, 0.0), 0.005), TIPS, (True, False, False), RADIUS, TIP)
    assert np.linalg.norm(left.places - TIPS[0], axis=1).max() <= RADIUS + TIP + 0.004


def test_circles_through_points():
    centre = np.array([0.01, -0.02])
    points = centre + 0.039 * np.array([[1.0, 0.0], [0.0, 1.0], [-0.6, -0.8]])
    assert circumcentre(points) == pytest.approx(centre)
    assert through(points[0], points[1], 0.039, np.zeros(2)) == pytest.approx(centre)
