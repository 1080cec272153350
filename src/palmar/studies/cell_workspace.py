"""Where the arm can serve a task of the cell: places of the cylinder for which every pose on the hand's way is reached.

The way is a straight line relative to the cylinder's axis: down over it and up again with what is held, or forward to it
and back. A place is served if one branch of the Puma's closed-form inverse stays within all joint limits along the whole
way, without a jump; the cell's arm follows such a branch, the one that is nearest. Turning the hand about its own axis by
up to 60 degrees, as touches may ask for, is joint 6 alone, whose limits leave more than that beyond a half turn.

Places are asked on a grid, finer along the boundary, the way at points: ``sampled``. What is returned is the inner side:
cells of which all corners and their neighbours are served.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, cos, log2, pi

import numpy as np
from numpy.typing import NDArray
from shapely import MultiPolygon, Point, affinity, box
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.cell.belief import reach_of
from palmar.behaviours.cell.floating_catch import BEYOND, STAND_OFF
from palmar.behaviours.cell.table_pick import LIFT, TablePick
from palmar.geometry.planar_set import areal
from palmar.mechanics.arm.puma_560 import LOWER, UPPER, inverse
from palmar.models.cell_task import CellTask, TaskKind
from palmar.models.guarantee import Guarantee
from palmar.models.salisbury_hand import SalisburyHand
from palmar.regions.boundary_search import Box, all_near, nodes_inside
from palmar.regions.closing_sampled import cells, corners_inside
from palmar.studies.cell_prediction import Predicted

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
DOWN = np.diag([1.0, -1.0, -1.0])
AHEAD = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
"""Rotations of the hand frame: palm down, palm forward with the cylinder's axis along the hand's x."""
SPACING, STEP = 0.005, 0.010
"""Of the places at the boundary, and of the poses on the way (m)."""
FARTHEST, COARSE = 1.28, 32
"""Half the side of the square about the shoulder that is searched (m), and its coarse cells across."""
JUMP = 0.3
"""Most that a joint may turn (rad) from one pose on the way to the next."""
ARC = 16
"""Corners of a quarter circle."""
CHUNK = 4000
"""Places asked at once."""


@dataclass(frozen=True)
class Workspace:
    """``places`` (m) of the axis in the arm's base frame; ``spacing`` (m); ``heights`` (m) of the palm on its way."""

    places: MultiPolygon
    spacing: float
    heights: tuple[float, float]
    guarantee: Guarantee = Guarantee.SAMPLED

    def with_error(self, error: float) -> MultiPolygon:
        """Places at which the axis may be seen so that all places within ``error`` (m) of it are served, too."""
        return areal(self.places.buffer(-error / cos(pi / (4.0 * ARC)), quad_segs=ARC))

    def room(self, at: tuple[float, float]) -> float:
        """How far (m) the hand's goal may be from a place before one is not served; 0 where the place itself is not."""
        here = Point(at)
        return float(self.places.boundary.distance(here)) if self.places.contains(here) else 0.0

    def served(self, region: BaseGeometry, at: tuple[float, float]) -> MultiPolygon:
        """Which part of a region of hand places about the axis (m) the arm serves, the axis being at a place (m)."""
        return areal(affinity.translate(self.places, -at[0], -at[1]) & region)


def allowed_places(hand: SalisburyHand, task: CellTask, promised: Predicted) -> BaseGeometry:
    """The region of the closing hand, seen from the axis: where the palm's middle may be (m, directions of the base).

    For a catch what the prediction allows along and across the drive.
    """
    if promised.along_across is not None:
        along, across = promised.along_across
        return box(-along, -across, along, across)
    region = reach_of(hand, task.cylinder).target.region
    return affinity.scale(region, xfact=-DOWN[0, 0], yfact=-DOWN[1, 1], origin=(0.0, 0.0))


def hand_way(hand: SalisburyHand, task: CellTask) -> Floats:
    """Poses (N, 4, 4) of the hand frame on its way, for an axis at x = y = 0; heights are those of the base."""
    if task.kind is TaskKind.TABLE:
        pick = TablePick(hand, task.cylinder, task.place[2] + 0.5 * task.cylinder.height, 0.0)
        low, high = pick.down, max(pick.over, pick.down + LIFT)
        start, end = np.array([0.0, 0.0, high]), np.array([0.0, 0.0, low])
        turn = DOWN
    else:
        turn, height = AHEAD, np.array([0.0, 0.0, task.place[2]])
        start, end = (height - turn @ (0.0, hand.grasp_line, each) for each in (STAND_OFF, -BEYOND))
    share = np.linspace(0.0, 1.0, ceil(float(np.linalg.norm(end - start)) / STEP) + 1)[:, None]
    poses = np.tile(np.eye(4), (len(share), 1, 1))
    poses[:, :3, :3], poses[:, :3, 3] = turn, start + share * (end - start)
    return poses


def workspace(hand: SalisburyHand, task: CellTask, spacing: float = SPACING) -> Workspace:
    """Where the cylinder's axis may be for the arm to carry out a task; ``spacing`` (m) of the places at the boundary."""
    way = hand_way(hand, task)
    unmount = np.eye(4)
    unmount[2, 3] = -hand.mount

    def inside(x: Floats, y: Floats) -> Bools:
        places = np.stack([y - FARTHEST, x], axis=1)
        return np.concatenate([_served(way, unmount, some) for some in _chunks(places)])

    side = 2.0 * FARTHEST
    nodes = nodes_inside(inside, Box(side, side, COARSE, mirrored=False), max(0, ceil(log2(side / COARSE / spacing))))
    inner = corners_inside(all_near(nodes.held)).T
    heights = float(way[:, 2, 3].min()), float(way[:, 2, 3].max())
    return Workspace(cells(inner, (-FARTHEST, -FARTHEST), nodes.step), nodes.step, heights)


def _chunks(places: Floats) -> list[Floats]:
    return np.array_split(places, max(1, ceil(len(places) / CHUNK)))


def _served(way: Floats, unmount: Floats, places: Floats) -> Bools:
    """Whether one branch serves the whole way about each place (N, 2)."""
    poses = np.tile(way, (len(places), 1, 1, 1))
    poses[..., :2, 3] += places[:, None]
    found = inverse(poses @ unmount)
    joints = np.unwrap(found.joints, axis=1)
    smooth = (np.abs(np.diff(joints, axis=1)) < JUMP).all(axis=(1, 3))
    turns = 2.0 * pi * np.array([-1.0, 0.0, 1.0])[:, None, None, None]
    low, high = joints.min(axis=1) + turns, joints.max(axis=1) + turns
    within = ((low >= LOWER) & (high <= UPPER)).any(axis=0).all(axis=-1)
    served: Bools = (found.allowed.all(axis=1) & smooth & within).any(axis=-1)
    return served
