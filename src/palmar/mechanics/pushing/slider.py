"""An object that slides on a table: its outline, and the limit surface of its base.

The outline is a convex core grown by a radius: a disk is a point grown by R, a polygon has the radius 0. Everything is
in the slider's frame, whose axes are those of the object's frame and whose origin is the centre of pressure.
"""

from __future__ import annotations

from math import hypot, inf
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.limit_surface import LimitSurface, disk_surface, polygon_surface, sampled_surface
from palmar.mechanics.pushing.polygon_contacts import Body, polygon_body
from palmar.mechanics.pushing.pressure_cells import Cells, disk_cells, leaned, polygon_cells

Floats = NDArray[np.float64]
RINGS, AROUND = 8, 32


class Slider(NamedTuple):
    """Core vertices (V, 2) counter-clockwise, or one point; rounding (m); surface; centre of pressure in the object."""

    core: Floats
    rounding: float
    surface: LimitSurface
    centre: tuple[float, float]


def disk_slider(radius: float, exponent: float = 0.0, offset: tuple[float, float] = (0.0, 0.0)) -> Slider:
    """A disk about its frame's origin; pressure as s^exponent (0: uniform), its centre moved by ``offset`` (m)."""
    if exponent == 0.0 and offset == (0.0, 0.0):
        return Slider(np.zeros((1, 2)), float(radius), disk_surface(radius), offset)
    return pressed_slider(
        np.zeros((1, 2)), radius, leaned(disk_cells(radius, exponent, RINGS, AROUND), offset), (0.0, 0.0)
    )


def polygon_slider(
    vertices: ArrayLike, centroid: tuple[float, float], exponent: float = 0.0, offset: tuple[float, float] = (0.0, 0.0)
) -> Slider:
    """A convex polygon (V, 2), counter-clockwise; pressure about its area ``centroid``, as for the disk."""
    corners = np.ascontiguousarray(vertices, dtype=float)
    if exponent == 0.0 and offset == (0.0, 0.0):
        about = corners - np.asarray(centroid)
        return Slider(about, 0.0, polygon_surface(about), centroid)
    cells = leaned(polygon_cells(corners, exponent, RINGS, AROUND, centroid), offset)
    return pressed_slider(corners, 0.0, cells, centroid)


def pressed_slider(core: Floats, rounding: float, cells: Cells, about: tuple[float, float]) -> Slider:
    """An outline in the object's frame with any pressure, given on cells about the point ``about`` of that frame."""
    points, weights, spreads = cells
    mean = weights @ points
    centre = about[0] + float(mean[0]), about[1] + float(mean[1])
    return Slider(
        core - np.asarray(centre), float(rounding), sampled_surface((points - mean, weights, spreads)), centre
    )


def slider_body(slider: Slider, friction: float) -> Body:
    """The slider as the stepping kernel takes it: a disk is there a polygon of one vertex, rounded."""
    if len(slider.core) > 1:
        return polygon_body(slider.core, friction, slider.surface)
    radius, (x, y) = slider.rounding, slider.core[0]
    core = np.ascontiguousarray(slider.core, dtype=float)
    return Body(core, np.zeros((1, 3)), radius, hypot(x, y) + radius, 2.0 * radius, float(friction), slider.surface)


def moved_poses(centre: tuple[float, float], poses: Floats, way: float) -> Floats:
    """Poses (N, 3) of the object's frame -> of its centre of pressure at ``centre`` (m) in it (way 1), or back (way -1)."""
    c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    moved = poses.copy()
    moved[:, 0] += way * (c * centre[0] - s * centre[1])
    moved[:, 1] += way * (s * centre[0] + c * centre[1])
    return moved


@compiled
def nearest(slider: Slider, x: float, y: float) -> tuple[float, float, float, float, float]:
    """The outline seen from a point: (distance, foot x, y, outward unit normal x, y), distance negative inside.

    Outside the core the foot is the nearest point; inside, the foot is on the edge that is nearest.
    """
    core, last = slider.core, len(slider.core) - 1
    best, inside, depth = inf, last > 0, -inf
    fx, fy, nx, ny, dx, dy = core[0, 0], core[0, 1], 1.0, 0.0, 1.0, 0.0
    for i in range(last + 1):
        ax, ay = core[i - 1 if i > 0 else last, 0], core[i - 1 if i > 0 else last, 1]
        ex, ey = core[i, 0] - ax, core[i, 1] - ay
        length = hypot(ex, ey)
        along = 0.0
        if length > 0.0:
            off = ((x - ax) * ey - (y - ay) * ex) / length
            inside = inside and off <= 0.0
            if off > depth:
                depth, dx, dy = off, ey / length, -ex / length
            along = min(max(((x - ax) * ex + (y - ay) * ey) / length**2, 0.0), 1.0)
        qx, qy = ax + along * ex, ay + along * ey
        apart = hypot(x - qx, y - qy)
        if apart < best:
            best, fx, fy = apart, qx, qy
    if inside:
        best, nx, ny = depth, dx, dy
        fx, fy = x - depth * dx, y - depth * dy
    elif best > 0.0:
        nx, ny = (x - fx) / best, (y - fy) / best
    return best - slider.rounding, fx + slider.rounding * nx, fy + slider.rounding * ny, nx, ny
