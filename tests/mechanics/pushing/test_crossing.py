"""The guarded secant, the course of a stride and the loads on edges by stored entries, against what they stand for."""

from math import inf

import numpy as np
import pytest

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_course import fit_course, pose_after, twist_after
from palmar.mechanics.pushing.closing_motion import Bench, bench
from palmar.mechanics.pushing.closing_stride import SHARE
from palmar.mechanics.pushing.contact_solve import fill_rows, workspace
from palmar.mechanics.pushing.crossing import next_point
from palmar.mechanics.pushing.edge_loads import edge_loads, fill_entries, known_loads
from palmar.mechanics.pushing.metric import inverse


@compiled
def _next(a: float, b: float, x1: float, f1: float, x2: float, f2: float, tried: int) -> float:
    return next_point(a, b, x1, f1, x2, f2, tried)


def crossing_of(function, low, high, jump):
    """(where ``function`` falls below zero in [low, high], points tried); values below ``jump`` only tell the sign."""
    a, b, x1, f1, x2, f2 = low, high, low, function(low), high, function(high)
    x2, f2 = (x2, f2) if f2 > jump else (low, inf)
    for tried in range(200):
        x = _next(a, b, x1, f1, x2, f2, tried)
        assert a <= x <= b
        f = function(x)
        a, b = (x, b) if f > 0.0 else (a, x)
        if f > jump:
            x1, f1, x2, f2 = x, f, x1, f1
        if abs(f) < 1e-12 or b - a < 1e-13:
            return x, tried + 1
    raise AssertionError("no crossing found")


@pytest.mark.parametrize("root", [0.011, 0.3, 0.77])
def test_smooth_crossing_takes_few_points(root):
    found, tried = crossing_of(lambda x: (root - x) * (1.0 + 0.5 * x), 0.0, 1.0, -inf)
    assert found == pytest.approx(root, abs=1e-11)
    assert tried <= 7


@pytest.mark.parametrize("root", [0.011, 0.3, 0.77])
def test_crossing_beside_a_jump_is_found(root):
    found, tried = crossing_of(lambda x: (root - x) * (1.0 + 0.5 * x) if x < root + 1e-6 else -1.0, 0.0, 1.0, -0.5)
    assert found == pytest.approx(root, abs=1e-11)
    assert tried <= 40


def test_jump_that_no_secant_can_tell_is_found():
    found, tried = crossing_of(lambda x: 0.5 if x < 0.3 else -1.0, 0.0, 1.0, -0.5)
    assert found == pytest.approx(0.3, abs=1e-12)
    assert tried <= 100


@compiled
def _both_loads(metric, contacts, rows, count, a, b, c):
    fill_rows(inverse(metric), contacts, count, rows)
    fill_entries(contacts, count, rows)
    return edge_loads(contacts, rows, a, b, c), known_loads(rows, a, b, c)


def test_stored_entries_give_the_same_loads():
    rng, rows = np.random.default_rng(3), workspace().rows
    for _ in range(200):
        angle = rng.uniform(0.0, 2.0 * np.pi, 3)
        contacts = np.column_stack(
            [rng.normal(size=(3, 2)), np.cos(angle), np.sin(angle), rng.normal(size=(3, 2)), 0.4 + 0 * angle]
        )
        metric = (1.0, 0.1, 1.2, 0.05, -0.1, 0.8)
        for edges in [(1, -2, -2), (0, 1, -2), (1, 2, -2), (0, 1, 4), (0, 3, 5)]:
            direct, stored = _both_loads(metric, contacts, rows, 3, *edges)
            assert direct[0] == stored[0]
            assert np.allclose(direct[1:], stored[1:], rtol=1e-9)


@compiled
def _course(at: Bench, h: float, part: float):
    fit_course(at, h)
    return pose_after(at, h, part), twist_after(at, h, part)


@pytest.mark.parametrize("part", [0.0, 0.21, 0.5, 0.93, 1.0])
def test_course_follows_twists_that_are_polynomials(part):
    at, h = bench(0), 0.3
    parts = np.array(SHARE)
    rates = np.array([[0.3, -0.2, 1.0], [0.1, 0.4, -2.0], [-0.5, 0.2, 0.7]])
    at.stages[:, :3] = np.stack([parts**0, parts, parts**2], axis=1) @ rates
    at.state[:3] = 0.01, 0.02, 0.4
    pose, twist = _course(at, h, part)
    assert np.allclose(
        pose, np.array([0.01, 0.02, 0.4]) + h * np.array([part, part**2 / 2, part**3 / 3]) @ rates, atol=1e-14
    )
    assert np.allclose(twist, np.array([1.0, part, part**2]) @ rates, atol=1e-13)
