"""What the end of a slow run means.

invalid: object and hand overlap at the start; structural: the normals of the final contacts positively span the
plane, so that no translation is free even without friction; frictional: not so, but the friction cones of the
final contacts positively span the space of planar wrenches; jammed: a finger stalled on the object and loads it
still, without either; caged: free, but enclosed by the final hand; escaped: free after a touch; missed: never
touched. The orientation of a polygon is kept when asking whether it is enclosed.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
from shapely import LineString, MultiPoint, Point, Polygon, box, union_all

from .slow_contacts import end_to_edge, placed
from .slow_model import Hand, Object, Run, core
from .slow_stepping import STALLED

REACH = 2e-5  # finger lengths: a smaller gap at the end is a contact
NORMAL_MARGIN = 2e-3  # radians by which three normals must miss a half-plane: 1/force at which fingers stall
CONE_SLACK = 1e-2  # radians added to a friction cone: an object wedges in at its very edge
STRESSED = 5.0  # table frictions: a larger load on an object at rest is a squeeze


def thicknesses(hand: Hand) -> np.ndarray:
    """Half thickness of the palm and of every link."""
    return np.r_[0.0, np.full(2 * len(hand.links), hand.half_thickness)]


def own_links(hand: Hand, run: Run) -> np.ndarray:
    """The final segments without the wall, which is no part of the hold."""
    return run.links[: 2 * len(hand.links) + 1]


def links_at_start(hand: Hand) -> np.ndarray:
    """Segments of the palm and of both fingers at the first clock value."""
    angles = hand.table()[1][0]
    steps = np.asarray(hand.links)[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    base = np.array([[hand.half_palm, 0.0]])
    joints = np.vstack([base, base + np.cumsum(steps, axis=0)])
    right = np.hstack([joints[:-1], joints[1:]])
    return np.vstack([[-hand.half_palm, 0.0, hand.half_palm, 0.0], right, right * [-1.0, 1.0, -1.0, 1.0]])


def overlaps(hand: Hand, thing: Object, pose: np.ndarray) -> bool:
    """Whether the object overlaps the open hand by more than a billionth of the finger."""
    hair = 1e-9 * sum(hand.links)
    if thing.radius > 0.0:
        shape, reach = Point(pose[:2]), thing.radius - hair
    else:
        shape, reach = Polygon(placed(np.asarray(thing.vertices, float), pose)).buffer(-hair), 0.5 * hair
    if shape.bounds[3] + (reach if thing.radius > 0.0 else 0.0) > hand.wall:
        return True
    return any(
        shape.distance(LineString(segment.reshape(2, 2))) < reach + half
        for segment, half in zip(links_at_start(hand), thicknesses(hand), strict=True)
    )


def final_contacts(hand: Hand, thing: Object, run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Points (c, 2) and normals (c, 2), pointing into the object, of all contacts at the end."""
    reach, points, normals = REACH * sum(hand.links), [], []
    rounding = run.rounding if len(thing.vertices) else 0.0
    world = placed(core(np.asarray(thing.vertices, float), rounding), run.pose) if len(thing.vertices) else None
    for segment, half in zip(own_links(hand, run), thicknesses(hand) + rounding, strict=True):
        line = LineString(segment.reshape(2, 2))
        pairs = []  # (foot on the link's axis, nearest point of the object's core)
        for point in run.pose[None, :2] if world is None else world:
            pairs.append((np.array(line.interpolate(line.project(Point(point))).coords[0]), point))
        for end in () if world is None else segment.reshape(2, 2):
            distance, edge = end_to_edge(world, *end)
            if edge >= 0:
                along = world[(edge + 1) % len(world)] - world[edge]
                pairs.append((end, end + distance * np.array([-along[1], along[0]]) / np.hypot(*along)))
        for foot, point in pairs:
            distance = np.hypot(*(point - foot))
            if distance - half - thing.radius < reach:
                normals.append((point - foot) / distance)
                points.append(foot + half * normals[-1])
    return np.array(points).reshape(-1, 2), np.array(normals).reshape(-1, 2)


def spans_plane(normals: np.ndarray) -> bool:
    """Whether the directions leave no open angle of half a turn (less a margin)."""
    if len(normals) < 3:
        return False
    angles = np.sort(np.arctan2(normals[:, 1], normals[:, 0]))
    gaps = np.diff(np.append(angles, angles[0] + 2.0 * math.pi))
    return bool(gaps.max() < math.pi - NORMAL_MARGIN)


def spans_wrenches(points: np.ndarray, normals: np.ndarray, friction: float, pose: np.ndarray) -> bool:
    """Whether the edges of the friction cones, as planar wrenches, lie in no closed half-space."""
    if len(normals) < 2:
        return False
    half = math.atan(friction) + (CONE_SLACK if friction > 0.0 else 0.0)
    wrenches = []
    arms = points - pose[:2]
    arms = arms / np.hypot(*arms.T).max()
    for turn in (-half, half):
        cos, sin = math.cos(turn), math.sin(turn)
        force = np.stack([cos * normals[:, 0] - sin * normals[:, 1], sin * normals[:, 0] + cos * normals[:, 1]], axis=1)
        wrenches.append(np.c_[force, arms[:, 0] * force[:, 1] - arms[:, 1] * force[:, 0]])
    rays = np.vstack(wrenches)
    if np.linalg.matrix_rank(rays, tol=1e-6) < 3:
        return False
    for i, j in itertools.combinations(range(len(rays)), 2):  # a facet of a smaller cone goes through two rays
        normal = np.cross(rays[i], rays[j])
        if np.hypot.reduce(normal) > 1e-9:
            heights = rays @ normal / np.hypot.reduce(normal)
            if (heights > -1e-9).all() or (heights < 1e-9).all():
                return False
    return True


def enclosed(hand: Hand, thing: Object, run: Run) -> bool:
    """Whether the object, without turning, can go nowhere far from the hand as it ended."""
    shrink, obstacles = 0.995, []
    shape = placed(np.asarray(thing.vertices, float), np.array([0.0, 0.0, run.pose[2]]))
    if len(shape):
        shape = shape.mean(axis=0) + shrink * (shape - shape.mean(axis=0))
    for segment, half in zip(own_links(hand, run), thicknesses(hand), strict=True):
        ends = segment.reshape(2, 1, 2)
        swept = MultiPoint((ends - shape).reshape(-1, 2)).convex_hull if len(shape) else LineString(ends[:, 0])
        obstacles.append(swept.buffer(shrink * (half + thing.radius), 64))
    blocked = union_all(obstacles)
    far = sum(hand.links)
    left, low, right, high = blocked.bounds
    room = box(left - far, low - far, right + far, high + far)
    here = Point(run.pose[:2])
    free = room.difference(blocked)
    for part in getattr(free, "geoms", [free]):
        if part.covers(here):
            return not part.intersects(room.boundary)
    return False


def judge(hand: Hand, thing: Object, friction: float, run: Run) -> str:
    """The outcome of a run that started without overlap."""
    points, normals = final_contacts(hand, thing, run)
    if spans_plane(normals):
        return "structural"
    if friction > 0.0 and spans_wrenches(points, normals, friction, run.pose):
        return "frictional"
    if (run.states == STALLED).any() and run.loads.max() > STRESSED:
        return "jammed"
    if enclosed(hand, thing, run):
        return "caged"
    own = 2 * len(hand.links)
    return "escaped" if any(what == "touch" and who <= own for _, what, who in run.events) else "missed"
