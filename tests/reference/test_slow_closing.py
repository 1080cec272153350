"""The slow reference itself: known motions, convergence, symmetries and the meaning of its outcomes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from .slow_closing import COARSE, close_hand
from .slow_model import Hand, Object, disk_support, polygon_support

HAND = Hand(half_palm=1.0, links=(2.0,))
DISK = Object(radius=0.5)
STEEP = math.tan(math.radians(35.0))
TRIANGLE = np.array([[-0.30, -0.12], [0.26, -0.21], [0.04, 0.33]])


def test_support_points_carry_the_right_moments() -> None:
    points, weights = disk_support(0.5, 8)
    assert weights.sum() == pytest.approx(1.0)
    assert weights @ np.hypot(*points.T) == pytest.approx(0.5 * 2.0 / 3.0, rel=1e-3)
    assert weights @ points**2 == pytest.approx([0.0625, 0.0625])
    points, weights = polygon_support(np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]), 3)
    assert weights @ points == pytest.approx([1.0, 0.5])
    assert weights @ (points - [1.0, 0.5]) ** 2 == pytest.approx([1.0 / 3.0, 1.0 / 12.0])


def test_one_interior_contact_runs_out_by_the_radius_per_radian() -> None:
    run = close_hand(HAND, DISK, 0.5, (1.8, 0.6)).run
    assert run is not None
    first = run.events[0][0]
    path = run.path[(run.path[:, 0] > first) & (run.path[:, 4] < 1.6)]
    along = (path[:, 1] - 1.0) * np.cos(path[:, 4]) + path[:, 2] * np.sin(path[:, 4])
    assert np.ptp(along - 0.5 * path[:, 4]) < 1e-6
    assert np.abs(path[:, 3]).max() < 1e-9


@pytest.mark.parametrize(
    ("friction", "start", "outcome"),
    [
        (0.0, (2.1754, 0.5), "structural"),
        (0.0, (2.1760, 0.5), "escaped"),
        (STEEP, (2.2835, 0.5), "frictional"),
        (STEEP, (2.2841, 0.5), "escaped"),
        (STEEP, (2.3, 0.5), "escaped"),
        (STEEP, (1.1, 2.0), "escaped"),
    ],
)
def test_limits_of_the_catch(friction: float, start: tuple[float, float], outcome: str) -> None:
    result = close_hand(HAND, DISK, friction, start)
    assert result.outcome == outcome
    if outcome == "structural":  # against the palm, both fingers on it
        assert result.pose == pytest.approx([0.0, 0.5, 0.0], abs=1e-4)
        assert result.joints[:, 0] == pytest.approx(2.0 * math.atan2(1.0, 0.5), abs=1e-4)
    elif outcome == "escaped":  # let go where both tips meet its equator's upper side: 2 sin(psi) + 0.5 sin(beta)
        assert result.pose[:2] == pytest.approx([0.0, math.sqrt(5.25)], abs=1e-4)


def test_backward_euler_converges_with_first_order_to_the_midpoint_result() -> None:
    coarse = replace(COARSE, farthest=1.0, stall=1e4)
    ends = {
        (weight, step): close_hand(HAND, DISK, 0.5, (2.25, 0.5), replace(coarse, weight=weight, step=step)).pose
        for weight, step in [(1.0, 4e-3), (1.0, 2e-3), (1.0, 1e-3), (0.5, 1e-3)]
    }
    exact = ends[0.5, 1e-3]
    errors = [np.abs(ends[1.0, step] - exact).max() for step in (4e-3, 2e-3, 1e-3)]
    assert errors[0] / errors[1] == pytest.approx(2.0, abs=0.3)
    assert errors[1] / errors[2] == pytest.approx(2.0, abs=0.3)


def test_no_numerical_parameter_matters() -> None:
    rough = close_hand(HAND, DISK, 0.5, (2.2, 0.6))
    for finer in ({"step": 2.5e-4, "viscous": 1e-5}, {"eps": 2e-5, "stall": 4e3}, {"stiffness": 4e8, "rings": 12}):
        fine = close_hand(HAND, DISK, 0.5, (2.2, 0.6), replace(COARSE, **finer))
        assert rough.outcome == fine.outcome == "frictional", finer
        assert rough.pose == pytest.approx(fine.pose, abs=3e-4), finer


def test_two_straight_links_are_one() -> None:
    one = close_hand(HAND, DISK, 0.3, (1.9, 0.9))
    two = close_hand(replace(HAND, links=(0.9, 1.1)), DISK, 0.3, (1.9, 0.9))
    assert two.outcome == one.outcome
    assert two.pose == pytest.approx(one.pose, abs=1e-6)
    assert two.joints[:, 0] == pytest.approx(one.joints[:, 0], abs=1e-6)


@pytest.mark.parametrize("half_thickness", [0.0, 0.1])
def test_a_polygon_of_many_sides_is_nearly_a_disk(half_thickness: float) -> None:
    angles = np.arange(24) * (2.0 * math.pi / 24)
    vertices = 0.5 * np.stack([np.cos(angles), np.sin(angles)], axis=1) / math.cos(math.pi / 24) ** 0.5
    hand = replace(HAND, half_thickness=half_thickness)
    disk, polygon = (close_hand(hand, thing, 0.0, (1.5, 0.7)) for thing in (DISK, Object(vertices=vertices)))
    assert polygon.outcome == disk.outcome == "structural"
    assert polygon.pose[:2] == pytest.approx(disk.pose[:2], abs=0.01)


def test_the_mirrored_start_ends_in_the_mirrored_pose() -> None:
    here = close_hand(HAND, Object(vertices=TRIANGLE), 0.4, (1.2, 0.6, 0.3))
    mirrored = Object(vertices=(TRIANGLE * [-1.0, 1.0])[::-1])
    there = close_hand(HAND, mirrored, 0.4, (-1.2, 0.6, -0.3))
    assert there.outcome == here.outcome
    assert there.pose == pytest.approx(here.pose * [-1.0, 1.0, -1.0], abs=1e-5)
    assert there.joints == pytest.approx(here.joints[::-1], abs=1e-5)


def test_rounding_the_corners_hardly_matters() -> None:
    ends = [
        close_hand(HAND, Object(vertices=TRIANGLE), 0.4, (1.2, 0.6, 0.3), replace(COARSE, rounding=rounding))
        for rounding in (1e-4, 2e-4)
    ]
    assert ends[0].outcome == ends[1].outcome
    assert ends[0].pose == pytest.approx(ends[1].pose, abs=2e-3)


@pytest.mark.parametrize(
    ("hand", "radius", "friction", "start", "outcome"),
    [
        (HAND, 0.5, 0.5, (2.5, 0.3), "invalid"),  # lies on the open finger
        (HAND, 0.5, 0.5, (0.0, 3.0), "missed"),
        (HAND, 1.0, 0.0, (0.0, 1.2), "jammed"),  # as wide as the palm: upright fingers squeeze it, nothing holds it
        (HAND, 1.0, 0.1, (0.0, 1.2), "frictional"),
        (replace(HAND, crossing=False), 0.2, 0.5, (1.5, 0.6), "caged"),  # the tips meet above it
    ],
)
def test_outcomes(hand: Hand, radius: float, friction: float, start: tuple[float, float], outcome: str) -> None:
    result = close_hand(hand, Object(radius=radius), friction, start)
    assert result.outcome == outcome
    if outcome == "caged":
        assert result.joints == pytest.approx(2.0 * math.pi / 3.0, abs=1e-5)


def test_distal_joints_follow_their_table() -> None:
    curl = Hand(1.0, (1.0, 1.0), clock=np.array([0.0, math.pi]), joints=np.array([[0.0, 0.0], [math.pi, 1.5]]))
    result = close_hand(curl, Object(radius=0.6), STEEP, (1.5, 0.6))
    assert result.outcome == "structural"
    assert result.pose[:2] == pytest.approx([0.0, 0.6], abs=1e-4)
    assert result.joints[:, 1] == pytest.approx(result.joints[:, 0] * 1.5 / math.pi)
