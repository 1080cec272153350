"""Tracing the boundary of sets that are known: the same nodes as by asking all of them, with fewer questions."""

import numpy as np
import pytest

from palmar.regions.boundary_search import Box, all_near, any_near, nodes_inside


def disk(x, y):
    return np.hypot(x, y - 1.0) < 0.83


def ring_with_a_spur(x, y):
    ring = (np.hypot(x, y - 1.0) < 0.8) & (np.hypot(x, y - 1.0) > 0.37)
    return ring | ((np.abs(x) < 0.03) & (y > 0.9) & (y < 1.97))


def halves(x, y):
    return (np.abs(x) > 0.2) & (np.abs(x) < 0.9) & (y > 0.3) & (y < 1.1 + 0.3 * np.abs(x))


@pytest.mark.parametrize("inside", [disk, ring_with_a_spur, halves])
@pytest.mark.parametrize("mirrored", [False, True])
def test_the_traced_nodes_are_those_of_asking_all(inside, mirrored):
    asked = []

    def counted(x, y):
        asked.extend(zip(x, y, strict=True))
        return inside(x, y)

    traced = nodes_inside(counted, Box(2.4, 2.0, 12, mirrored), 4)
    every = nodes_inside(inside, Box(2.4, 2.0, 192, False), 0)
    assert traced.step == pytest.approx(every.step)
    assert (traced.held == every.held).all()
    assert len(set(asked)) == len(asked) < 0.35 * traced.held.size
    assert not mirrored or min(x for x, _ in asked) == 0.0


def test_every_node_beside_another_that_differs_has_been_asked():
    rng = np.random.default_rng(3)
    noise = {}

    def rough(x, y):
        return np.array(
            [disk(a, b) and noise.setdefault((a, b), rng.random()) > 0.1 for a, b in zip(x, y, strict=True)]
        )

    asked = set()

    def counted(x, y):
        asked.update(zip(np.round(x, 9), np.round(y, 9), strict=True))
        return rough(x, y)

    nodes = nodes_inside(counted, Box(2.4, 2.0, 12, False), 3)
    rows, columns = np.nonzero(any_near(nodes.held) & any_near(~nodes.held))
    x, y = nodes.step * (columns - 48), nodes.step * rows
    assert set(zip(np.round(x, 9), np.round(y, 9), strict=True)) <= asked


def test_neighbours_beyond_the_grid_are_not_set():
    nodes = np.ones((3, 3), bool)
    assert any_near(nodes).all()
    assert all_near(nodes).sum() == 1
