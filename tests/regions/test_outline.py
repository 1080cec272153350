"""Outlines of known sets, traced on a grid: area, holes, parts, and the chord's error as the grid is halved."""

from __future__ import annotations

import numpy as np
import pytest

from palmar.regions.boundary_search import Box, Nodes, nodes_inside
from palmar.regions.outline import outlined

BOX = Box(4.0, 4.0, 16, mirrored=False)
ORIGIN = (-2.0, 0.0)


def traced(inside, levels: int):
    nodes = nodes_inside(inside, BOX, levels)
    return outlined(inside, nodes, ORIGIN)


def ring(x, y):
    r = np.hypot(x - 0.1, y - 2.03)
    return (r < 1.5) & (r > 0.7)


def test_a_ring_keeps_its_hole_and_its_area_to_second_order() -> None:
    errors = []
    for levels in (0, 1, 2, 3):
        found = traced(ring, levels)
        assert len(found.geoms) == 1
        assert len(found.geoms[0].interiors) == 1
        errors.append(abs(found.area - np.pi * (1.5**2 - 0.7**2)))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders.mean() > 1.7


def test_corners_of_the_polygon_lie_on_the_outline() -> None:
    points = np.concatenate([np.array(each.coords) for each in traced(ring, 1).geoms[0].interiors])
    assert np.abs(np.hypot(points[:, 0] - 0.1, points[:, 1] - 2.03) - 0.7).max() < 1e-3 * 0.125


def test_two_parts_and_nothing() -> None:
    apart = traced(lambda x, y: np.hypot(np.abs(x) - 1.0, y - 1.0) < 0.5, 2)
    assert len(apart.geoms) == 2
    assert apart.area == pytest.approx(0.5 * np.pi, rel=0.01)
    assert traced(lambda x, y: np.zeros(len(x), bool), 1).is_empty


def test_opposite_corners_are_kept_apart() -> None:
    held = np.array([[True, False], [False, True]])
    found = outlined(lambda x, y: np.zeros(len(x), bool), Nodes(held, 1.0), (0.0, 0.0))
    assert found.area == pytest.approx(0.0, abs=1e-12)


def test_a_set_that_ends_at_the_grid_is_closed_there() -> None:
    found = traced(lambda x, y: y < 1.0, 1)
    assert found.area == pytest.approx(4.0 * 1.0, abs=0.01)
