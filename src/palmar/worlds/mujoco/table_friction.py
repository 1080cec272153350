"""Friction with the table, exact for any pressure, as dampers that are set anew before each step.

At the twist nu the friction overcome is W = M nu with the secant metric M of the limit surface (``limit_surface``), taken
at nu itself. M is the matrix of two dampers across each other at one point, the centre of the slowness, and one against
turning about it. MuJoCo solves dampers implicitly: with M of the last twist a step takes away energy whatever its length,
and a steady motion has the exact wrench. An object that should rest creeps with at most ``LEAST_SPEED``.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import cos, hypot, sin
from typing import Any

from palmar.mechanics.pushing.limit_surface import LimitSurface, secant_metric
from palmar.worlds.mujoco.stiction import Stiction

LEAST_SPEED = 1e-6
"""Slower twists (m/s, at the surface's length) are resisted in proportion to their speed."""
RESTING = 1e-6
"""A twist that is smaller than this share of it has no direction."""


class TableLaw(Enum):
    """How an object's friction with the table is had."""

    EXACT = "exact"
    """The limit surface of the case's pressure."""
    ELLIPSOID = "ellipsoid"
    """One contact that resists turning too: the ellipsoid with the same largest force and moment."""


@dataclass(frozen=True)
class TableFriction:
    """Of the object whose x, y and turn are the coordinates from ``first`` on; ``force`` (N): that of a translation."""

    model: Any
    data: Any
    first: int
    surface: LimitSurface
    force: float
    stiction: Stiction | None = None

    def prepare(self) -> None:
        """Set the dampers for the next step."""
        vx, vy, omega = self.data.qvel[self.first : self.first + 3].tolist()
        theta = float(self.data.qpos[self.first + 2])
        c, s, length = cos(theta), sin(theta), self.surface.length
        x, y, turn = c * vx + s * vy, c * vy - s * vx, omega
        speed = hypot(x, y, length * turn)
        if speed < RESTING * LEAST_SPEED:
            x, y, turn = LEAST_SPEED, 0.0, 0.0
        elif speed < LEAST_SPEED:
            x, y, turn = (each * LEAST_SPEED / speed for each in (x, y, turn))
        metric = secant_metric(self.surface, x, y, turn)
        if self.stiction is not None:
            metric = self.stiction.added_to(metric, x, y, turn)
        total, _, _, up, across, whole = metric
        px, py = across / total, -up / total
        self.model.tendon_damping[:] = self.force * total
        self.model.wrap_prm[1], self.model.wrap_prm[3] = -(s * px + c * py), c * px - s * py
        self.model.dof_damping[self.first + 2] = self.force * (whole - total * (px * px + py * py))
