"""The curl that the centrifugal force asks for: geometry, its clearance, and the growth of an error along the link."""

from __future__ import annotations

from math import acos, cos, cosh, sin, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from palmar.mechanics.impact.centrifugal_5_3_1 import BEST, centrifugal_angle, centrifugal_angles, clearance

LENGTH, SIZE = 0.137, 0.038


def centre(along: float, angle: float) -> np.ndarray:
    """Of a disk on the distal link, in the frame of the proximal one."""
    link, normal = np.array([cos(angle), sin(angle)]), np.array([-sin(angle), cos(angle)])
    return np.array([LENGTH, 0.0]) + along * link + SIZE * normal


@pytest.mark.parametrize("along", [0.02, 0.05, 0.1])
def test_the_ray_to_the_disk_is_square_to_the_link(along: float) -> None:
    angle = centrifugal_angle(LENGTH, along)
    assert centre(along, angle) @ np.array([cos(angle), sin(angle)]) == pytest.approx(0.0, abs=1e-15)


def test_at_the_ends_the_disk_touches_the_proximal_link_too() -> None:
    found = centrifugal_angles(LENGTH, 1.0, SIZE, 0.0)
    assert found is not None
    for angle in found:
        assert centre(-LENGTH * cos(angle), angle)[1] == pytest.approx(SIZE, abs=1e-12)
    middle = 0.5 * (found[0] + found[1])
    assert centre(-LENGTH * cos(middle), middle)[1] > SIZE


def test_the_largest_disk_that_is_clear() -> None:
    tried = np.linspace(0.0, 1.0, 100_001)
    best = tried * np.sqrt((1.0 - tried) / (1.0 + tried))
    assert clearance(1.0, BEST) == pytest.approx(best.max(), abs=1e-9) == pytest.approx(0.300283, abs=1e-6)
    assert pytest.approx((sqrt(5.0) - 1.0) / 2.0) == BEST
    assert centrifugal_angles(1.0, 1.0, 0.3, 0.0) is not None
    assert centrifugal_angles(1.0, 1.0, 0.301, 0.0) is None
    assert centrifugal_angles(1.0, 1.0, 0.29, 0.02) is None
    assert centrifugal_angles(1.0, 0.1, 0.29, 0.0) is None  # the contact would lie beyond the tip


def test_a_frictionless_disk_aside_goes_as_the_hyperbolic_cosine() -> None:
    """A bead on the turning line, in the table's frame: a stiff spring keeps it at its distance, nothing else pulls."""
    along, aside = 0.08, 1e-3
    angle = centrifugal_angle(LENGTH, along)
    link, normal = np.array([cos(angle), sin(angle)]), np.array([-sin(angle), cos(angle)])
    stiff = 1e7

    def turned(t: float, v: np.ndarray) -> np.ndarray:
        return np.array([cos(t) * v[0] - sin(t) * v[1], sin(t) * v[0] + cos(t) * v[1]])

    def rates(t: float, state: np.ndarray) -> np.ndarray:
        n = turned(t, normal)
        gap = n @ state[:2] - normal @ centre(along, angle)
        return np.concatenate([state[2:], -stiff * gap * n])

    start = centre(along + aside, angle)
    velocity = np.array([-start[1], start[0]])
    run = solve_ivp(rates, (0.0, 0.8), [*start, *velocity], rtol=1e-9, atol=1e-12, method="DOP853")
    reached = turned(-0.8, run.y[:2, -1]) @ link - np.array([LENGTH, 0.0]) @ link
    assert reached - along == pytest.approx(aside * cosh(0.8), rel=1e-3)


def test_a_short_distal_link_cuts_off_the_far_contacts_and_then_all() -> None:
    """Clear contacts lie between 0.310 and 0.876 proximal links from the elbow here."""
    least, most = centrifugal_angles(1.0, 2.0, 0.225, 0.0) or (0.0, 0.0)
    low, high = -cos(least), -cos(most)
    assert clearance(1.0, low) == pytest.approx(0.225) and clearance(1.0, high) == pytest.approx(0.225)
    assert centrifugal_angles(1.0, 0.5, 0.225, 0.0) == pytest.approx((least, acos(-0.5)))
    assert centrifugal_angles(1.0, 0.99 * low, 0.225, 0.0) is None
