"""Pre-images of closing while the arm moves: a straight first stretch with still fingers, then closing on the way.

Everything on the table is quasi-static, so only ways count: ``first`` metres straight ahead before the fingers move, and
``per_radian`` metres for each radian of the fingers then, until they end; the arm stops with them. Starts are carried by
the stepping kernel, first before the still hand, then before the closing one. Positions are in the hand frame at the
start. Guarantee: ``sampled``, as in ``closing_sampled``.

A still hand that is open flat, with line fingers, pushes a disk straight ahead: then moving first and closing after is
the closing region with every start up to ``first`` beyond it: exact, see ``moved_first``.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, log2

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, affinity

from palmar.geometry.planar_set import areal
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.closing_steps import BATCH_TOLERANCE, carry_all, carry_halting
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion
from palmar.mechanics.pushing.polygon_contacts import Body
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import moved_poses, slider_body
from palmar.models.case import Case
from palmar.models.outcome import Outcome
from palmar.regions.boundary_search import Box, Nodes, all_near, nodes_inside
from palmar.regions.closing_sampled import COARSE, cells, corners_inside

Floats = NDArray[np.float64]
NANOMETRES = 9
"""Digits to which the ways of arms that a wall stops are told apart."""


@dataclass(frozen=True)
class ArmMotion:
    """Straight ahead along y: ``first`` (m) before the fingers move, ``per_radian`` (m/rad) while they close."""

    first: float = 0.0
    per_radian: float = 0.0


@dataclass(frozen=True)
class MovingSets:
    """The region (m), the spacing of the starts simulated (m) and their number."""

    centre: MultiPolygon
    spacing: float
    starts: int


def moving_sets(case: Case, arm: ArmMotion, spacing: float) -> MovingSets:
    """Positions of the object's frame, at the case's orientation, that are caught; starts ``spacing`` (m) apart."""
    slider = slider_of(case.object, case.support)
    body, motion = slider_body(slider, case.contact.friction), straight_motion(case.hand, case.support.wall)
    carried = 0

    def inside(x: Floats, y: Floats) -> NDArray[np.bool_]:
        nonlocal carried
        carried += len(x)
        poses = np.column_stack([x, y, np.full(len(x), case.start.theta)])
        return caught(motion, body, moved_poses(slider.centre, poses, 1.0), arm)

    length, reach = float(motion.links.sum()), body.reach + float(np.hypot(*slider.centre))
    width = 2.0 * (motion.half_palm + length + reach)
    height = length + 2.0 * reach + arm.first + arm.per_radian * (motion.last - motion.first)
    mirrored = len(body.vertices) == 1 and slider.centre == (0.0, 0.0)
    levels = max(0, ceil(log2(width / COARSE / spacing)))
    nodes: Nodes = nodes_inside(inside, Box(width, height, COARSE, mirrored), levels)
    return MovingSets(cells(corners_inside(all_near(nodes.held)), (-0.5 * width, 0.0), nodes.step), nodes.step, carried)


def caught(motion: HandMotion, body: Body, starts: Floats, arm: ArmMotion) -> NDArray[np.bool_]:
    """Whether each start (N, 3) of the centre of pressure, in the hand frame at the start, is caught."""
    if arm.first == 0.0:
        return _held(motion._replace(vy=arm.per_radian), body, starts)
    codes, ends, _, halts = carry_halting(still(motion, arm.first), body, starts, tolerance=BATCH_TOLERANCE)
    found: NDArray[np.bool_] = (codes != Outcome.INVALID.code) & (codes != Outcome.UNDECIDED.code)
    ways = np.where(halts == MOVING, 1.0, halts) * arm.first
    for way in np.unique(ways.round(NANOMETRES)):
        some = np.flatnonzero(found & (ways.round(NANOMETRES) == way))
        closing = motion._replace(vy=arm.per_radian, wall=motion.wall - float(way))
        found[some] = _held(closing, body, ends[some, :3] - np.array([0.0, way, 0.0]))
    return found


def _held(motion: HandMotion, body: Body, starts: Floats) -> NDArray[np.bool_]:
    codes, _, _ = carry_all(motion, body, starts, tolerance=BATCH_TOLERANCE)
    found: NDArray[np.bool_] = codes <= Outcome.CAGED.code
    return found


def still(motion: HandMotion, distance: float) -> HandMotion:
    """The hand with its fingers where ``motion`` begins, going ``distance`` (m) straight ahead while time runs to 1."""
    offsets, ratios = np.zeros_like(motion.offsets), np.zeros_like(motion.ratios)
    offsets[...] = motion.offsets
    offsets[..., 0], ratios[..., 0] = motion.first, -1.0
    return motion._replace(first=0.0, last=1.0, offsets=offsets, ratios=ratios, vx=0.0, vy=distance, alone=0.0)


def moved_first(region: MultiPolygon, radius: float, distance: float) -> MultiPolygon:
    """The region (m) of going ``distance`` ahead and closing then, for a disk before flat open line fingers: exact.

    What the hand meets it pushes straight to y = R; the rest comes nearer by ``distance``. So a start is caught if
    (x, max(y - distance, R)) is in the closing region: that region shifted, and its lowest row drawn out down to R.
    """
    ahead = affinity.translate(region, 0.0, distance)
    left, _, right, _ = region.bounds
    row = shapely.intersection(region, shapely.LineString([(left - 1.0, radius), (right + 1.0, radius)]))
    spans = [each.bounds for each in shapely.get_parts(row) if each.length > 0.0]
    rows = [shapely.box(low, radius, high, radius + distance) for low, _, high, _ in spans]
    return areal(shapely.union_all([ahead, *rows]))
