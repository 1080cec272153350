"""Where the hand touches the object on its way: the events say which parts do, geometry says where."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from palmar.faces.plots.hand import finger_points, object_reach
from palmar.geometry.polygon import turned
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.studies.simulate import Simulation

Floats = NDArray[np.float64]
Place = tuple[float, float]
SIDES = ("right", "left")
NEAR = 1e-4
"""Share of the finger's length within which a corner counts as lying on a link that touches."""


def contacts(
    case: Case, psi: Floats, poses: Floats, fingers: Floats, result: Simulation
) -> tuple[tuple[Place, ...], ...]:
    """For every pose the points (m) of the hand's surface that touch the object."""
    found: list[list[Place]] = [[] for _ in psi]
    for body in dict.fromkeys(event.body for _, event in result.events if event.kind == "touch"):
        for k in np.flatnonzero(_touching(body, psi, result)):
            found[k] += _feet(case, body, poses[k], fingers[k])
    return tuple(tuple(each) for each in found)


def _touching(body: str, psi: Floats, result: Simulation) -> NDArray[np.bool_]:
    flags = np.zeros(len(psi), dtype=np.bool_)
    for _, event in result.events:
        if event.body == body and event.kind in ("touch", "leave"):
            flags[psi >= event.psi - 1e-6] = event.kind == "touch"
    return flags


def _feet(case: Case, body: str, pose: Floats, fingers: Floats) -> list[Place]:
    """The points of one part of the hand, or of the wall, that lie on the object."""
    sides = np.split(fingers, 2)
    hand, height = case.hand, case.palm_ahead(sides[0].tolist(), sides[1].tolist())
    name, _, part = body.partition("_")
    if name in SIDES:
        points = finger_points(hand, sides[SIDES.index(name)].tolist(), left=name == "left")
        ends, half = (points + np.array([0.0, height]))[_between(part)], hand.half_thickness
    elif name == "wall":
        assert case.support.wall is not None
        x, side, height = float(pose[0]), object_reach(case.object), case.support.wall
        ends, half = np.array([[x - side, height], [x + side, height]]), 0.0
    else:
        ends, half = np.array([[-hand.half_palm, height], [hand.half_palm, height]]), 0.0
    if isinstance(case.object, Disk):
        pairs = [(_foot(ends, pose[:2]), pose[:2])]
    else:
        pairs = _nearest_pairs(ends, turned(case.object.vertices, pose[2]) + pose[:2], NEAR * hand.finger_length)
    return [_on_surface(foot, point, half) for foot, point in pairs]


def _between(part: str) -> list[int]:
    """Numbers of the two joints, the tip last, between which a part of a finger is: link_1, joint_2, tip, or all of it."""
    if part == "tip":
        return [-1, -1]
    what, _, number = part.partition("_")
    if not number:
        return [0, -1]
    return [int(number) - 1, int(number) - (what == "joint")]


def _nearest_pairs(ends: Floats, outline: Floats, near: float) -> list[tuple[Floats, Floats]]:
    """Pairs (point of the segment, point of the polygon) as near as any, within ``near``: corners, or ends on edges."""
    pairs = [(_foot(ends, corner), corner) for corner in outline]
    edges = list(zip(outline, np.roll(outline, -1, axis=0), strict=True))
    pairs += [(end, _foot(np.array(edge), end)) for end in ends for edge in edges]
    lengths = [float(np.hypot(*(foot - point))) for foot, point in pairs]
    kept: list[tuple[Floats, Floats]] = []
    for length, (foot, point) in sorted(zip(lengths, pairs, strict=True), key=lambda each: each[0]):
        if length <= min(lengths) + near and all(np.hypot(*(foot - other)) > near for other, _ in kept):
            kept.append((foot, point))
    return kept


def _foot(ends: Floats, point: Floats) -> Floats:
    """The point of the segment (2, 2) nearest to another."""
    along = ends[1] - ends[0]
    square = float(along @ along)
    share = float(np.clip((point - ends[0]) @ along / square, 0.0, 1.0)) if square > 0.0 else 0.0
    foot: Floats = ends[0] + share * along
    return foot


def _on_surface(foot: Floats, point: Floats, half: float) -> Place:
    """From the joint line towards the object, by half the finger's thickness."""
    apart = float(np.hypot(*(point - foot)))
    share = half / apart if apart > 0.0 else 0.0
    x, y = foot + share * (point - foot)
    return float(x), float(y)
