"""The outline of a set that was asked about on the nodes of a grid: where it crosses the grid's edges, bisected.

In every cell whose corners differ the outline goes straight from crossing to crossing (marching squares); where two
opposite corners are in the set and the others are not, they are kept apart. So corners of the polygon lie on the true
outline to a part of the grid's step, and between them it is a chord.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from palmar.geometry.planar_set import EMPTY, areal
from palmar.regions.boundary_search import Inside, Nodes

Floats = NDArray[np.float64]
HALVINGS = 12
CORNERS = ((0, 0), (0, 1), (1, 1), (1, 0))
"""(row, column) of a cell's corners, counter-clockwise from the lower left; bit k of a cell's code is corner k."""
BOTTOM, RIGHT, TOP, LEFT = range(4)
WAYS = {
    1: ((BOTTOM, LEFT),), 2: ((RIGHT, BOTTOM),), 4: ((TOP, RIGHT),), 8: ((LEFT, TOP),),
    3: ((RIGHT, LEFT),), 6: ((TOP, BOTTOM),), 12: ((LEFT, RIGHT),), 9: ((BOTTOM, TOP),),
    7: ((TOP, LEFT),), 11: ((RIGHT, TOP),), 13: ((BOTTOM, RIGHT),), 14: ((LEFT, BOTTOM),),
    5: ((BOTTOM, LEFT), (TOP, RIGHT)), 10: ((RIGHT, BOTTOM), (LEFT, TOP)),
}  # fmt: skip
"""From which side of a cell to which the outline goes, the set on its left."""
ENDS = {BOTTOM: (0, 1), RIGHT: (1, 2), TOP: (3, 2), LEFT: (0, 3)}
"""The two corners of a side."""
Edge = tuple[tuple[int, int], tuple[int, int]]


def outlined(inside: Inside, nodes: Nodes, origin: tuple[float, float]) -> MultiPolygon:
    """The set as polygons (m); ``origin`` (m) is the place of the grid's first node."""
    held = np.pad(nodes.held, 1)
    if not held.any():
        return EMPTY
    follows = _follows(held)
    edges = list(dict.fromkeys(follows))
    at = np.array(origin) - nodes.step
    places = dict(zip(edges, _crossings(inside, held, edges, at, nodes.step), strict=True))
    rings = []
    while follows:
        first, edge = next(iter(follows.items()))
        del follows[first]
        ring = [first]
        while edge != first:
            ring.append(edge)
            edge = follows.pop(edge)
        rings.append(areal(shapely.make_valid(Polygon([places[each] for each in ring]))))
    # Rings turn left around the set and right around its holes, so what lies in an odd number of them is in it.
    found: BaseGeometry = EMPTY
    for each in rings:
        found = found ^ each
    return areal(found)


def _follows(held: NDArray[np.bool_]) -> dict[Edge, Edge]:
    """For each grid edge that the outline crosses, the one that it crosses next."""
    rows, columns = held.shape[0] - 1, held.shape[1] - 1
    code = np.zeros((rows, columns), np.int64)
    for k, (r, c) in enumerate(CORNERS):
        code += held[r : r + rows, c : c + columns].astype(np.int64) << k
    follows: dict[Edge, Edge] = {}
    for row, column in zip(*np.nonzero((code > 0) & (code < 15)), strict=True):
        for start, end in WAYS[int(code[row, column])]:
            follows[_edge(int(row), int(column), start)] = _edge(int(row), int(column), end)
    return follows


def _edge(row: int, column: int, side: int) -> Edge:
    (r0, c0), (r1, c1) = (CORNERS[k] for k in ENDS[side])
    return (row + r0, column + c0), (row + r1, column + c1)


def _crossings(inside: Inside, held: NDArray[np.bool_], edges: list[Edge], at: Floats, step: float) -> Floats:
    """Where on each edge (E, 2) the set ends: the last place of the bisection that is in it."""
    nodes = np.array(edges)
    within = held[nodes[:, :, 0], nodes[:, :, 1]]
    rows = np.arange(len(nodes))
    first = np.where(within[:, 0], 0, 1)
    low, high = (at + step * nodes[rows, each][:, ::-1] for each in (first, 1 - first))
    last = np.array(held.shape) - 1
    beyond = nodes[rows, 1 - first]
    high = np.where(((beyond == 0) | (beyond == last)).any(axis=1)[:, None], low, high)  # nothing is known there
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        yes = inside(middle[:, 0], middle[:, 1])[:, None]
        low, high = np.where(yes, middle, low), np.where(yes, high, middle)
    return low
