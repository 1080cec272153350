"""Where the pusher and the object's outline really are: offsets found from the starts of recorded pushes alone.

Two instruments record a push, one the pusher and one the object. If pushes start in contact, the gap between pusher and
outline at the start should be zero; how it varies with the direction of contact in the table's frame shows an offset
between the instruments, and how it varies in the object's frame shows where the outline lies in that frame. No
outcome of a push enters.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from palmar.mechanics.pushing.slider import Slider, nearest

Floats = NDArray[np.float64]
NOISE = 2e-4
"""Size (m) of a gap that counts as noise; larger ones lose influence."""
EXPECTED = np.array([1e-3, 1e-3, 1e-3, 1e-3, 2e-2])
"""Sizes (m, m, m, m, rad) of offsets that are no surprise: directions that no start shows are kept near zero."""
NEAR = 4e-3
"""Starts with a larger gap (m) are taken to be out of contact and are left out."""
FEWEST = 10


@dataclass(frozen=True)
class Registration:
    """To be added to the pusher path (m, table frame); place (m) and angle (rad) of the outline in the object frame."""

    path: tuple[float, float] = (0.0, 0.0)
    outline: tuple[float, float] = (0.0, 0.0)
    turn: float = 0.0
    starts: int = 0
    """How many starts it rests on."""

    def apply(self, starts: Floats, paths: Floats) -> tuple[Floats, Floats]:
        """Start poses (N, 3) of the outline's own frame, and paths (N, 4) in the frame of the object's instrument."""
        return self._outline(starts, 1.0), paths + np.array([*self.path, *self.path])

    def back(self, poses: Floats) -> Floats:
        """Poses (N, 3) of the object's frame from those of the outline's own frame."""
        return self._outline(poses, -1.0)

    def _outline(self, poses: Floats, sign: float) -> Floats:
        turn = sign * self.turn
        angle = poses[:, 2] + (turn if sign < 0.0 else 0.0)
        dx, dy = sign * self.outline[0], sign * self.outline[1]
        moved = poses.copy()
        moved[:, 0] += np.cos(angle) * dx - np.sin(angle) * dy
        moved[:, 1] += np.sin(angle) * dx + np.cos(angle) * dy
        moved[:, 2] += turn
        return moved


def start_gaps(slider: Slider, pusher_radius: float, starts: Floats, paths: Floats) -> Floats:
    """Gap (m) between the pusher and the outline at the start of each push; negative where they overlap."""
    cosine, sine = np.cos(starts[:, 2]), np.sin(starts[:, 2])
    dx, dy = paths[:, 0] - starts[:, 0], paths[:, 1] - starts[:, 1]
    x, y = cosine * dx + sine * dy - slider.centre[0], cosine * dy - sine * dx - slider.centre[1]
    return np.array([nearest(slider, *each)[0] for each in zip(x, y, strict=True)]) - pusher_radius


def register(slider: Slider, pusher_radius: float, starts: Floats, paths: Floats) -> Registration:
    """The offsets that close the gaps at the starts, robust least squares; none if too few pushes start in contact."""
    near = np.abs(start_gaps(slider, pusher_radius, starts, paths)) < NEAR
    if near.sum() < FEWEST:
        return Registration()

    def misfit(scaled: Floats) -> Floats:
        offsets = _registration(scaled, int(near.sum()))
        gaps = start_gaps(slider, pusher_radius, *offsets.apply(starts[near], paths[near]))
        return np.append(gaps / NOISE, scaled)

    found = least_squares(misfit, np.zeros(5), loss="soft_l1", diff_step=np.full(5, 1e-4))
    return _registration(found.x, int(near.sum()))


def _registration(scaled: Floats, starts: int) -> Registration:
    tx, ty, ox, oy, turn = (float(value) for value in scaled * EXPECTED)
    return Registration((tx, ty), (ox, oy), turn, starts)
