"""The hand and the object, to scale."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, sin

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from numpy.typing import NDArray
from shapely import LineString

from palmar.faces.plots.sheet import MM, Extent, per_paper_mm
from palmar.faces.plots.strokes import CENTRE_LINE, DASHES, disc, shape, stroke
from palmar.faces.plots.style import FINE, HEAVY, NORMAL, Role
from palmar.geometry.polygon import turned
from palmar.models.hand import Hand
from palmar.models.objects import Disk, Object

Floats = NDArray[np.float64]
Place = tuple[float, float]

OBJECT_LEVEL, FINGER_LEVEL, PALM_LEVEL, JOINT_LEVEL = 2.0, 4.0, 5.0, 6.0
"""Drawing order, lowest first; dimensions lie above."""
GHOST_DROP = 2.5
"""How far ghosts lie below."""
JOINT_SIZE, INNER_JOINT_SIZE = 1.8, 1.3
"""Diameters of joints on paper (mm)."""
MARK = 1.0
"""Half the width of an object's origin mark on paper (mm)."""
WALL_LEVEL = 0.8
WALL_ROOM = 0.04
"""Height of what is seen of a wall, as a share of the picture's."""


def finger_points(hand: Hand, joints: Sequence[float], *, left: bool = False) -> Floats:
    """Joints and tip (links + 1, 2) in m; ``joints`` holds the base angle, then the further angles from straight."""
    angles = np.zeros(len(hand.finger_links))
    angles[: len(joints)] = joints
    directions = np.cumsum(angles)
    steps = np.stack([np.cos(directions), np.sin(directions)], axis=1) * np.array(hand.finger_links)[:, None]
    points = np.concatenate([[[hand.half_palm, 0.0]], steps]).cumsum(axis=0)
    return points * (-1.0, 1.0) if left else points


def draw_hand(
    axes: Axes, hand: Hand, psi: float, *, distal: Sequence[float] = (), at: Place = (0.0, 0.0), ghost: bool = False
) -> None:
    """Palm and both fingers at base angle ``psi`` (rad); ``distal`` the further joints, straight where not given.

    ``at`` is the middle of the palm (m). A ghost is a light pose behind the others. Fingers with thickness are drawn
    as the capsules they are.
    """
    draw_palm(axes, hand, at=at, ghost=ghost)
    for left in (True, False):
        draw_finger(axes, hand, (psi, *distal), left=left, at=at, ghost=ghost)


def draw_palm(axes: Axes, hand: Hand, *, at: Place = (0.0, 0.0), facing: float = 0.0, ghost: bool = False) -> None:
    """The palm line between the base joints of a hand turned by ``facing`` (rad)."""
    ends = turned(((-hand.half_palm, 0.0), (hand.half_palm, 0.0)), facing) + at
    role, level = (Role.GHOST, PALM_LEVEL - GHOST_DROP) if ghost else (Role.PALM, PALM_LEVEL)
    stroke(axes, MM * ends, role, level=level, width=HEAVY)


def draw_wall(axes: Axes, height: float) -> None:
    """A wall across the picture at y = ``height`` (m): its line, and hatching behind it."""
    (left, right), (_, top) = axes.get_xlim(), axes.get_ylim()
    stroke(axes, [(left, MM * height), (right, MM * height)], Role.DIMENSION, level=WALL_LEVEL, width=NORMAL)
    if top > MM * height:
        axes.add_patch(
            Rectangle(
                (left, MM * height), right - left, top - MM * height, hatch="////", fill=False, linewidth=0.0,
                edgecolor=Role.GHOST.line, zorder=WALL_LEVEL,
            )
        )  # fmt: skip


def draw_finger(
    axes: Axes,
    hand: Hand,
    joints: Sequence[float],
    *,
    left: bool = False,
    at: Place = (0.0, 0.0),
    facing: float = 0.0,
    ghost: bool = False,
) -> None:
    """One finger with its joints, of a hand turned by ``facing`` (rad); angles as in ``finger_points``."""
    role, drop = (Role.GHOST, GHOST_DROP) if ghost else (Role.HAND, 0.0)
    level = FINGER_LEVEL - drop
    points = MM * (turned(finger_points(hand, joints, left=left), facing) + at)
    if hand.finger_thickness > 0.0:
        capsule = LineString(points).buffer(MM * hand.half_thickness, quad_segs=24)
        shape(axes, capsule.exterior.coords, role, level=level, width=FINE if ghost else 0.7 * NORMAL)
        stroke(axes, points, role, level=level + 0.1, dashes=CENTRE_LINE)
    else:
        stroke(axes, points, role, level=level, width=NORMAL if ghost else 1.4 * NORMAL, round_ends=True)
    for i, point in enumerate(points[:-1]):
        radius = 0.5 * per_paper_mm(axes) * (INNER_JOINT_SIZE if i else JOINT_SIZE)
        disc(axes, point, radius, Role.JOINT, level=JOINT_LEVEL - drop, width=0.7 * NORMAL)


def draw_object(
    axes: Axes,
    item: Object,
    at: Place,
    theta: float = 0.0,
    *,
    role: Role = Role.OBJECT,
    ghost: bool = False,
    fill: float = 1.0,
    mark: bool = True,
    within: Extent | None = None,
    level: float = OBJECT_LEVEL,
) -> None:
    """A disk or polygon with its frame's origin at ``at`` (m), turned by ``theta`` (rad); ``mark`` its origin.

    ``fill`` is the fill's opacity, a ghost is a thin dashed outline; what leaves the rectangle ``within`` is cut off.
    """
    centre = MM * np.array(at)
    width, dashes, fill = (FINE, DASHES, 0.0) if ghost else (NORMAL, "-", fill)
    if isinstance(item, Disk):
        patch = disc(axes, centre, MM * item.radius, role, level=level, width=width, fill=fill, dashes=dashes)
    else:
        outline = MM * turned(item.vertices, theta) + centre
        patch = shape(axes, outline, role, level=level, width=width, fill=fill, dashes=dashes)
    if within is not None:
        corner, size = (MM * within.left, MM * within.bottom), MM * np.array(within.size)
        patch.set(clip_on=True, clip_path=Rectangle(corner, *size, transform=axes.transData))
    if mark and (within is None or within.contains(at)):
        arm = MARK * per_paper_mm(axes) * np.array([cos(theta), sin(theta)])
        for step in (arm, arm[::-1] * (-1.0, 1.0)):
            stroke(axes, [centre - step, centre + step], role, level=level + 0.1)


def object_reach(item: Object) -> float:
    """Distance (m) of the object's farthest point from its frame's origin."""
    return item.radius if isinstance(item, Disk) else float(np.linalg.norm(item.vertices, axis=1).max())
