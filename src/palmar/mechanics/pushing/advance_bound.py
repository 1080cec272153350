"""How fast an object can move out along the line finger that pushes it, at worst, whatever its orientation.

In the finger's frame, d along it and n its normal, a contact at the distance r_c from the joint moves at r_c n per radian.
One contact: the twist is r_c times a function of the orientation, found at orientations all round; two contacts, an edge
flush on the finger: found at distances all along. With o and s the contact's offset along d and the height of the pressure
centre over the finger, its distance r = r_c - o from the joint grows at s + v_d.
"""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, compiled_to_allocate
from palmar.mechanics.pushing.contact_solve import CONTACT_WIDTH, Workspace, workspace
from palmar.mechanics.pushing.limit_surface import LimitSurface
from palmar.mechanics.pushing.motion_solve import solve_motion
from palmar.mechanics.pushing.slider import Slider

Floats = NDArray[np.float64]
ORIENTATIONS, DISTANCES = 1440, 129
BESIDE = 1e-6
"""How far (rad) beside a flush edge its two corners are tried alone."""
BESIDE_LEAN = 0.01
"""Added (rad) to the largest lean found, for orientations between those tried."""


class Advance(NamedTuple):
    """Distances r (N,) from 0 to the finger's length (m), bounds (N,) of r' (m per radian) up to each, both rising; and the
    largest angle (rad) from the normal back towards the joint at which the pressure centre moves.
    """

    at: Floats
    growth: Floats
    lean: float


def advance_bound(slider: Slider, friction: float, length: float) -> Advance:
    """The bounds for one object; to what is found the largest change between neighbouring orientations is added."""
    at = np.linspace(0.0, length, DISTANCES)
    corners = np.ascontiguousarray(slider.core, dtype=float)
    edges = np.roll(corners, -1, axis=0) - corners
    flush = np.arctan2(-edges[:, 1], -edges[:, 0]) if len(corners) > 1 else np.empty(0)
    angles = np.linspace(0.0, 2.0 * pi, ORIENTATIONS, endpoint=False)
    tried = np.sort(np.concatenate([angles, flush - BESIDE, flush + BESIDE]) % (2.0 * pi))
    contacts = _pushed_at(slider.surface, corners, slider.rounding, friction, tried)
    ratio, offset, height, corner, leans = contacts.T
    growth = ratio[:, None] * np.maximum(at + offset[:, None], 0.0) + height[:, None]
    same = corner == np.roll(corner, -1)
    change = np.abs(np.roll(growth, -1, axis=0) - growth)[same]
    worst = growth.max(axis=0) + (change.max(axis=0) if len(change) else 0.0)
    for first, second in zip(corners, np.roll(corners, -1, axis=0), strict=True) if len(corners) > 1 else ():
        flush_growth, flush_lean = _pushed_flush(slider.surface, first, second, slider.rounding, friction, at)
        worst, leans = np.maximum(worst, flush_growth), np.append(leans, flush_lean)
    return Advance(at, np.maximum.accumulate(np.maximum(worst, height.max())), float(leans.max()) + BESIDE_LEAN)


@compiled_to_allocate
def _pushed_at(surface: LimitSurface, core: Floats, rounding: float, friction: float, angles: Floats) -> Floats:
    """Where the finger touches one corner, the object's frame turned by ``angles`` (A,) against the finger's.

    Rows (A, 5) of the largest v_d for r_c = 1, the offset o (m), the height s (m), the corner, the lean.
    """
    found, contacts, space = np.empty((len(angles), 5)), np.zeros((1, CONTACT_WIDTH)), workspace()
    for k in range(len(angles)):
        dx, dy, nx, ny = cos(angles[k]), -sin(angles[k]), sin(angles[k]), cos(angles[k])
        corner, least = 0, np.inf
        for i in range(len(core)):
            height = core[i, 0] * nx + core[i, 1] * ny
            if height < least:
                corner, least = i, height
        x, y = core[corner, 0] - rounding * nx, core[corner, 1] - rounding * ny
        _contact(contacts[0], x, y, nx, ny, 1.0, friction)
        found[k, 0], found[k, 4] = _fastest(surface, contacts, 1, dx, dy, nx, ny, 1.0, space)
        found[k, 1], found[k, 2], found[k, 3] = x * dx + y * dy, -x * nx - y * ny, corner
    return found


@compiled_to_allocate
def _pushed_flush(
    surface: LimitSurface, first: Floats, second: Floats, rounding: float, friction: float, at: Floats
) -> tuple[Floats, float]:
    """r' at distances ``at`` with the edge from ``first`` to ``second`` flush on the finger, and the largest lean."""
    edge = hypot(second[0] - first[0], second[1] - first[1])
    dx, dy = (first[0] - second[0]) / edge, (first[1] - second[1]) / edge
    nx, ny = dy, -dx
    growth, contacts, space, largest = np.empty(len(at)), np.zeros((2, CONTACT_WIDTH)), workspace(), -np.inf
    height = rounding - first[0] * nx - first[1] * ny
    for k in range(len(at)):
        fastest = 0.0
        for row in range(2):
            corner = first if row == 0 else second
            x, y = corner[0] - rounding * nx, corner[1] - rounding * ny
            speed = max(at[k] + x * dx + y * dy, 0.0)
            _contact(contacts[row], x, y, nx, ny, speed, friction)
            fastest = max(fastest, speed)
        out, lean = _fastest(surface, contacts, 2, dx, dy, nx, ny, fastest, space)
        growth[k], largest = out + height, max(largest, lean)
    return growth, largest


@compiled
def _contact(row: Floats, x: float, y: float, nx: float, ny: float, speed: float, friction: float) -> None:
    """Write a contact at (x, y) with a finger that moves along its normal."""
    row[0], row[1], row[2], row[3], row[4], row[5], row[6] = x, y, nx, ny, speed * nx, speed * ny, friction


@compiled
def _fastest(
    surface: LimitSurface, contacts: Floats, count: int,
    dx: float, dy: float, nx: float, ny: float, speed: float, space: Workspace,
) -> tuple[float, float]:  # fmt: skip
    """The largest v_d and lean over all admissible motions; the hand's speed, which bounds it, where none is found."""
    found = solve_motion(surface, contacts, count, (0.0, 0.0, 0.0), space)
    if found <= 0:
        return speed, 0.5 * pi
    fastest, lean = -np.inf, -np.inf
    for k in range(found):
        x, y = space.motions[k, 0], space.motions[k, 1]
        out = x * dx + y * dy
        fastest, lean = max(fastest, out), max(lean, atan2(-out, x * nx + y * ny))
    return fastest, lean
