"""The pre-image of the closing motion by simulated starts: polygons, and disks whose pressure is off their centre.

Starts on a square grid are carried to their end by the stepping kernel; where neighbours differ the grid is halved, down
to a stated spacing. A cell is inside if all its corners and all their neighbours are caught, outside if none of them
is. Over several orientations a start counts as caught if it is caught at each. No bound is proven on what happens between
neighbouring starts: the guarantee is ``sampled``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil, log2

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter, minimum_filter
from shapely import MultiPolygon

from palmar.geometry.planar_set import areal
from palmar.mechanics.pushing.closing_steps import carry_all
from palmar.mechanics.pushing.hand_pose import HandMotion
from palmar.mechanics.pushing.polygon_contacts import Body
from palmar.mechanics.pushing.slider import moved_poses
from palmar.models.outcome import Outcome

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
COARSE = 24
"""Cells across the search box in the first pass."""


@dataclass(frozen=True)
class SampledSets:
    """Inner and outer side (m); spacing of the grid (m); orientations looked at; number of starts carried."""

    centre: MultiPolygon
    outer: MultiPolygon
    spacing: float
    orientations: int
    starts: int


def sampled_sets(
    motion: HandMotion, body: Body, centre: tuple[float, float], thetas: Floats, spacing: float
) -> SampledSets:
    """The region of positions (m) of the object's frame, ``centre`` its centre of pressure, caught at all ``thetas`` (rad).

    The grid is refined until its step is at most ``spacing`` (m).
    """
    size = body.reach + float(np.hypot(*centre))
    length = float(motion.links.sum())
    width, height = 2.0 * (motion.half_palm + length + size), length + 2.0 * size
    carried = 0

    def caught(x: Floats, y: Floats) -> Bools:
        nonlocal carried
        left = np.ones(len(x), bool)
        for theta in thetas:
            some = np.flatnonzero(left)
            poses = np.column_stack([x[some], y[some], np.full(len(some), theta)])
            codes, _, _ = carry_all(motion, body, moved_poses(centre, poses, 1.0))
            left[some] = codes <= Outcome.CAGED.code
            carried += len(some)
        return left

    levels = max(0, ceil(log2(width / COARSE / spacing)))
    held, step = _refined(caught, (-0.5 * width, 0.0), (width, height), levels)
    inner = minimum_filter(held, 3, mode="constant", cval=0)
    outer = maximum_filter(held, 3, mode="constant", cval=0)
    origin = (-0.5 * width, 0.0)
    return SampledSets(
        _cells(_all_corners(inner), origin, step), _cells(_any_corner(outer), origin, step), step, len(thetas), carried
    )


def _refined(
    caught: Callable[[Floats, Floats], Bools], origin: tuple[float, float], extent: tuple[float, float], levels: int
) -> tuple[Bools, float]:
    """Which nodes (rows: y, columns: x) of the finest grid are caught, and its step; only nodes near a change are asked."""
    step = extent[0] / COARSE
    shape = (ceil(extent[1] / step) + 1, COARSE + 1)
    rows, columns = np.indices(shape)
    held = caught(_place(origin[0], step, columns.ravel()), _place(origin[1], step, rows.ravel())).reshape(shape)
    for _ in range(levels):
        near = maximum_filter(held, 3) != minimum_filter(held, 3)
        step *= 0.5
        shape = (2 * shape[0] - 1, 2 * shape[1] - 1)
        finer, asked = np.zeros(shape, bool), np.zeros(shape, bool)
        finer[::2, ::2], asked[::2, ::2] = held, near
        asked = maximum_filter(asked, 3)
        asked[::2, ::2] = False
        inherited = maximum_filter(finer, 3)
        finer = np.where(asked, False, inherited)
        finer[::2, ::2] = held
        r, c = np.nonzero(asked)
        finer[r, c] = caught(_place(origin[0], step, c), _place(origin[1], step, r))
        held = finer
    return held, step


def _place(origin: float, step: float, index: NDArray[np.intp]) -> Floats:
    placed: Floats = origin + step * index.astype(np.float64)
    return placed


def _all_corners(nodes: Bools) -> Bools:
    return nodes[:-1, :-1] & nodes[1:, :-1] & nodes[:-1, 1:] & nodes[1:, 1:]


def _any_corner(nodes: Bools) -> Bools:
    return nodes[:-1, :-1] | nodes[1:, :-1] | nodes[:-1, 1:] | nodes[1:, 1:]


def _cells(inside: Bools, origin: tuple[float, float], step: float) -> MultiPolygon:
    """The union of cells, row by row as runs."""
    edges = np.diff(inside.astype(np.int8), axis=1, prepend=0, append=0)
    row, begin = np.nonzero(edges == 1)
    _, end = np.nonzero(edges == -1)
    x, y = origin
    boxes = shapely.box(x + step * begin, y + step * row, x + step * end, y + step * (row + 1))
    return areal(shapely.union_all(boxes))
