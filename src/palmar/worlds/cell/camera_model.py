"""A pinhole camera.

Camera frame: x right, y down, z ahead. A point X (m) there is seen at the pixel c + f (X / Z, Y / Z); pixel centres have
whole coordinates, from the upper left. Lenses do not distort.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import radians, tan

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PinholeCamera:
    """``place`` (3,) in m; ``turn`` (3, 3): its columns are the camera's axes in the world; ``size``: width, height (px).

    ``focal`` (px): the same along both axes; the axis ahead meets the image in its middle.
    """

    place: Floats
    turn: Floats
    focal: float
    size: tuple[int, int]

    @property
    def middle(self) -> Floats:
        """Pixel (2,) on the axis ahead."""
        return 0.5 * (np.array(self.size) - 1.0)

    def pixels(self, points: Floats) -> Floats:
        """Where (…, 2) points (…, 3) in the world (m) are seen, all of them ahead of the camera."""
        inside = (points - self.place) @ self.turn
        seen: Floats = self.middle + self.focal * inside[..., :2] / inside[..., 2:]
        return seen

    def rays(self, pixels: Floats) -> Floats:
        """Directions (…, 3) in the world from the camera's place through pixels (…, 2); one long along the axis ahead."""
        inside = np.concatenate([(pixels - self.middle) / self.focal, np.ones((*pixels.shape[:-1], 1))], axis=-1)
        directions: Floats = inside @ self.turn.T
        return directions

    def moved(self, shift: Floats, turn: Floats, stretch: float = 0.0) -> PinholeCamera:
        """Shifted (3,) in m in the world, turned about the camera's axes by (3,) rad, focal length a share longer."""
        angle = float(np.linalg.norm(turn))
        x, y, z = turn / angle if angle > 0.0 else np.zeros(3)
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        rotation = np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
        return replace(self, place=self.place + shift, turn=self.turn @ rotation, focal=self.focal * (1.0 + stretch))


def looking(place: Floats, at: Floats, fovy: float, size: tuple[int, int]) -> PinholeCamera:
    """From ``place`` (3,) at a point (3,) in m, its x level; ``fovy`` (deg): the whole angle that the height covers."""
    ahead = (at - place) / np.linalg.norm(at - place)
    right = np.cross(ahead, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    turn = np.stack([right, np.cross(ahead, right), ahead], axis=1)
    return PinholeCamera(place, turn, 0.5 * size[1] / tan(0.5 * radians(fovy)), size)
