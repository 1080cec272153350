"""The pre-image of the closing motion by simulated starts: polygons, and disks whose pressure is off their centre.

Starts on a square grid are carried to their end by the stepping kernel; where neighbours differ the grid is halved, down
to a stated spacing (``boundary_search``). A cell is inside if all its corners and all their neighbours are caught, outside
if none of them is. Over several orientations a start counts as caught if it is caught at each; those that are the same to
the hand are simulated once (``alike``), and a start that was lost at one is not followed at the others. No bound is proven
on what happens between neighbouring starts: the guarantee is ``sampled``.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, log2

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon

from palmar.geometry.planar_set import EMPTY, areal
from palmar.mechanics.pushing.closing_steps import BATCH_TOLERANCE, carry_all
from palmar.mechanics.pushing.hand_pose import HandMotion
from palmar.mechanics.pushing.polygon_contacts import Body
from palmar.mechanics.pushing.slider import moved_poses
from palmar.models.outcome import Outcome
from palmar.regions.alike import Different, different_orientations
from palmar.regions.boundary_search import Box, all_near, any_near, nodes_inside

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
COARSE = 24
"""Cells across the search box in the first pass."""
BATCH = 128
"""At least about so many starts are carried at once."""


@dataclass(frozen=True)
class SampledSets:
    """Inner and outer side (m); spacing of the grid (m); orientations looked at; number of starts carried.

    ``different``: how many of the orientations are not the same to the hand; ``mirrored``: one half stands for both.
    """

    centre: MultiPolygon
    outer: MultiPolygon
    spacing: float
    orientations: int
    starts: int
    different: int
    mirrored: bool


def sampled_sets(
    motion: HandMotion,
    body: Body,
    centre: tuple[float, float],
    thetas: Floats,
    spacing: float,
    certain: MultiPolygon = EMPTY,
) -> SampledSets:
    """The region of positions (m) of the object's frame, ``centre`` its centre of pressure, caught at all ``thetas`` (rad).

    The grid is refined until its step is at most ``spacing`` (m). Positions in ``certain`` (m) are known to be caught.
    """
    size = body.reach + float(np.hypot(*centre))
    length = float(motion.links.sum())
    width, height = 2.0 * (motion.half_palm + length + size), length + 2.0 * size
    different = different_orientations(body, centre, thetas, motion.vx == 0.0)
    starts = _Starts(motion, body, centre, different, certain)
    levels = max(0, ceil(log2(width / COARSE / spacing)))
    nodes = nodes_inside(starts.caught, Box(width, height, COARSE, different.mirrored), levels)
    inner, outer = corners_inside(all_near(nodes.held)), corners_touching(any_near(nodes.held))
    origin, step, known = (-0.5 * width, 0.0), nodes.step, (len(different.thetas), different.mirrored)
    return SampledSets(
        cells(inner, origin, step), cells(outer, origin, step), step, len(thetas), starts.carried, *known
    )


class _Starts:
    """Asks whether starts are caught at all orientations, those first at which the nearest lost start was lost."""

    def __init__(
        self, motion: HandMotion, body: Body, centre: tuple[float, float], different: Different, certain: MultiPolygon
    ) -> None:
        self.carried = 0
        self._motion, self._body, self._centre = motion, body, centre
        self._thetas, self._certain = different.thetas, certain
        self._lost, self._lost_at = np.empty((0, 2)), np.empty(0, np.intp)

    def caught(self, x: Floats, y: Floats) -> Bools:
        """Which starts (N,), (N,), m, are caught at all orientations."""
        held = np.ones(len(x), bool)
        asked, places = ~shapely.contains_xy(self._certain, x, y), np.column_stack([x, y])
        order = self._most_telling_first(places)
        done = 0
        while done < len(self._thetas):
            some = np.flatnonzero(held & asked)
            if len(some) == 0:
                break
            count = min(max(1, done, BATCH // len(some)), len(self._thetas) - done)
            now = order[some, done : done + count]
            each = self._caught_at(places[some], now)
            lost = ~each.all(axis=1)
            held[some] = ~lost
            self._lost = np.concatenate([self._lost, places[some[lost]]])
            self._lost_at = np.concatenate([self._lost_at, now[lost, np.argmin(each[lost], axis=1)]])
            done += count
        return held

    def _most_telling_first(self, places: Floats) -> NDArray[np.intp]:
        """For each place (N, 2) the orientations' numbers (N, T), outwards from that at which the nearest start was lost."""
        count = len(self._thetas)
        numbers = np.tile(np.arange(count), (len(places), 1))
        if len(self._lost) == 0:
            return numbers
        apart = ((places[:, None, :] - self._lost[None, :, :]) ** 2).sum(axis=2)
        suspect = self._lost_at[apart.argmin(axis=1)]
        steps = np.abs(numbers - suspect[:, None])
        order: NDArray[np.intp] = np.argsort(np.minimum(steps, count - steps), axis=1, kind="stable")
        return order

    def _caught_at(self, places: Floats, numbers: NDArray[np.intp]) -> Bools:
        """Whether starts (N, 2) are caught at each of some orientations (N, T): (N, T)."""
        count = numbers.shape[1]
        poses = np.column_stack([np.repeat(places, count, axis=0), self._thetas[numbers].ravel()])
        starts = moved_poses(self._centre, poses, 1.0)
        codes, _, _ = carry_all(self._motion, self._body, starts, tolerance=BATCH_TOLERANCE)
        self.carried += len(poses)
        found: Bools = (codes <= Outcome.CAGED.code).reshape(numbers.shape)
        return found


def corners_inside(nodes: Bools) -> Bools:
    """Cells of which all corners are set."""
    return nodes[:-1, :-1] & nodes[1:, :-1] & nodes[:-1, 1:] & nodes[1:, 1:]


def corners_touching(nodes: Bools) -> Bools:
    """Cells of which some corner is set."""
    return nodes[:-1, :-1] | nodes[1:, :-1] | nodes[:-1, 1:] | nodes[1:, 1:]


def cells(inside: Bools, origin: tuple[float, float], step: float) -> MultiPolygon:
    """The union of cells, row by row as runs."""
    edges = np.diff(inside.astype(np.int8), axis=1, prepend=0, append=0)
    row, begin = np.nonzero(edges == 1)
    _, end = np.nonzero(edges == -1)
    x, y = origin
    boxes = shapely.box(x + step * begin, y + step * row, x + step * end, y + step * (row + 1))
    return areal(shapely.union_all(boxes))
