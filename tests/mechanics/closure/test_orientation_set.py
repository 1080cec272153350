"""Interval sets from a yes or no at single orientations."""

from math import pi

import numpy as np
import pytest

from palmar.mechanics.closure.orientation_set import contains, orientation_set, total_measure

SAMPLES = 2.0 * pi * np.arange(720) / 720


def found(*intervals, samples=SAMPLES):
    """The set that `orientation_set` finds where the truth is these intervals, an end above 2 pi wraps around."""
    return orientation_set(lambda theta: contains(np.array(intervals, dtype=float), theta), samples)


@pytest.mark.parametrize(
    "intervals",
    [
        [(0.3, 0.5)],
        [(0.1234567891, 1.0), (2.0, 2.0000001 + 0.01)],
        [(6.0, 6.5)],
        [(1.0, 1.0 + 2.0 * pi - 0.02)],
        [(0.5, 1.5), (5.0, 2.0 * pi + 0.2)],
    ],
)
def test_ends_are_found_to_the_resolution(intervals):
    assert found(*intervals) == pytest.approx(np.array(intervals), abs=2e-10)
    assert total_measure(found(*intervals)) == pytest.approx(sum(end - start for start, end in intervals), abs=1e-9)


def test_all_and_nothing():
    assert orientation_set(lambda theta: theta >= 0.0, SAMPLES).tolist() == [[0.0, 2.0 * pi]]
    assert orientation_set(lambda theta: theta < 0.0, SAMPLES).shape == (0, 2)


def test_a_single_orientation_is_kept_and_a_gap_of_one_is_closed():
    lone = SAMPLES[100]
    assert found((lone, lone)) == pytest.approx(np.array([[lone, lone]]), abs=0.0)
    assert total_measure(orientation_set(lambda theta: theta != lone, SAMPLES)) == pytest.approx(2.0 * pi)


def test_a_gap_at_zero_does_not_end_the_interval_there():
    pieces = found((0.0, 0.5), (6.0, 2.0 * pi))
    assert pieces == pytest.approx(np.array([[6.0, 2.0 * pi + 0.5]]), abs=2e-10)


def test_contains_counts_the_ends_and_wraps():
    intervals = np.array([[0.5, 1.0], [6.0, 2.0 * pi + 0.1]])
    inside = contains(intervals, np.array([0.5, 1.0, 1.01, 6.0, -0.1, 0.05, 0.2, 0.5 + 2.0 * pi]))
    assert inside.tolist() == [True, True, False, True, True, True, False, True]
