"""How far a camera's calibration may be wrong, and by how much an axis is then seen in the wrong place.

Such an error is the same in every frame, so that no mean of sightings takes it away: a behaviour has to know its bound. It
is no part of a sighting's standard deviation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from palmar.errors import InputError
from palmar.worlds.cell.camera_model import PinholeCamera
from palmar.worlds.cell.upright_outline import Upright, outline

Floats = NDArray[np.float64]
SMALL = 1e-5
"""Share of the standard deviations by which derivatives are taken."""


@dataclass(frozen=True)
class Calibration:
    """One standard deviation each: ``shift`` (m) along each axis of the world, ``turn`` (rad) about each axis of the camera,
    ``stretch`` of the focal length (share).
    """

    shift: float = 0.001
    turn: float = 0.001
    stretch: float = 0.001

    def __post_init__(self) -> None:
        if min(self.shift, self.turn, self.stretch) < 0.0:
            raise InputError("calibration", None, "its standard deviations must not be negative")

    def wrong(self, camera: PinholeCamera, draws: Floats) -> PinholeCamera:
        """What it takes a camera to be, by draws (7,) of the standard normal distribution."""
        return camera.moved(self.shift * draws[:3], self.turn * draws[3:6], self.stretch * float(draws[6]))

    def spread(self, camera: PinholeCamera, body: Upright) -> Floats:
        """Covariance (3, 3) of axis x, y and radius (m²) that it causes where the whole outline is seen; to first order."""
        seen = outline(camera, body, 2.0)
        moved = np.stack([self.wrong(camera, SMALL * each).pixels(seen.points) for each in np.eye(7)])
        off = ((seen.pixels - moved) * seen.out).sum(axis=2) / SMALL
        causes: Floats = np.linalg.lstsq(seen.moves, off.T, rcond=None)[0]
        return causes @ causes.T
