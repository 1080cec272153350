"""Insets of known sets: corners between the places that were traced are found, and what cannot be mended is told."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from palmar.geometry.planar_set import outline
from palmar.regions.inset import bulged, refined

MARGIN = 1.0 / 256.0
SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
NONE = np.zeros(4, bool)


def notched(half_opening: float, depth: float):
    """The unit square without a wedge that pokes in from the right at y = 0.5, its tip at x = 1 - depth."""

    def inside(x, y, numbers):
        assert len(numbers) == len(x)
        wedge = np.abs(y - 0.5) < (x - (1.0 - depth)) * np.tan(half_opening)
        return (x > 0.0) & (x < 1.0) & (y > 0.0) & (y < 1.0) & ~wedge

    return inside


def reach_of(inside, line) -> int:
    """How many of a hundred thousand places in the inset, about where the wedge is, are not in the set."""
    inset = outline(line).buffer(-MARGIN)
    shapely.prepare(inset)
    points = np.random.default_rng(3).uniform([0.8, 0.4], [1.0, 0.6], (100_000, 2))
    points = points[shapely.contains_xy(inset, *points.T)]
    return int((~inside(points[:, 0], points[:, 1], np.arange(len(points)))).sum())


@pytest.mark.parametrize("depth", [0.11, 0.03, 0.0061])
@pytest.mark.parametrize("half_opening", [0.8, 1.1, 1.3])
def test_a_corner_that_pokes_in_is_kept_out(half_opening: float, depth: float) -> None:
    inside = notched(half_opening, depth)
    line, left = refined(SQUARE, NONE, inside, MARGIN, 0.25)
    assert reach_of(inside, line) == 0
    assert len(left) == 0
    lost = outline(SQUARE).area - outline(line).area
    assert lost == pytest.approx(depth * depth * np.tan(half_opening), abs=2.0 * MARGIN)


def test_a_set_without_corners_keeps_its_outline() -> None:
    line, left = refined(SQUARE, NONE, notched(0.5, 0.0), MARGIN, 0.25)
    assert len(left) == 0
    assert np.array_equal(line, SQUARE)


def test_what_is_deeper_than_one_goes_is_told() -> None:
    channel = notched(0.02, 2.0)
    _, left = refined(SQUARE, NONE, channel, MARGIN, 0.25)
    assert len(left) > 0
    assert not channel(left[:, 0], left[:, 1], np.arange(len(left))).any()


def test_known_edges_are_not_asked_about() -> None:
    asked = []

    def inside(x, y, numbers):
        asked.append(np.column_stack([x, y]))
        return np.ones(len(x), bool)

    refined(SQUARE, np.array([False, False, False, True]), inside, MARGIN, 0.25)
    points = np.concatenate(asked)
    assert points[(points[:, 1] > 0.1) & (points[:, 1] < 0.9), 0].min() > 0.5


def test_places_differ_in_number_where_they_are_asked_about_for_the_first_time() -> None:
    seen = []

    def inside(x, y, numbers):
        seen.append(numbers)
        return np.ones(len(x), bool)

    refined(SQUARE, NONE, inside, MARGIN, 0.25)
    assert len(np.unique(seen[0])) == len(seen[0]) >= 4 * 256


def test_a_corner_of_the_set_that_a_chord_cut_off_is_put_back() -> None:
    cut = np.array([[0.0, 0.0], [0.9, 0.0], [1.0, 0.1], [1.0, 1.0], [0.0, 1.0]])
    line, known = bulged(cut, np.zeros(5, bool), notched(0.5, 0.0), MARGIN)
    assert len(line) == len(known) == 6
    assert outline(line).area == pytest.approx(1.0, abs=1e-3)
    assert refined(line, known, notched(0.5, 0.0), MARGIN, 0.25)[1].size == 0
