"""What a camera would see, made of the true pose: it stands in where nothing can be rendered, and in statistics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from palmar.models.cell_messages import Sighting
from palmar.worlds.cell.timed_camera import CameraSettings


@dataclass(frozen=True)
class PoseCamera:
    """``where`` gives the axis' true place and radius (m) now."""

    settings: CameraSettings
    where: Callable[[], tuple[float, float, float]]
    random: np.random.Generator

    def sight(self, now: float) -> Sighting:
        """With noise and calibration error."""
        x, y, radius = self.where()
        east, north = self.settings.bias
        noise = self.settings.noise * self.random.standard_normal(3)
        return Sighting(now, x + east + noise[0], y + north + noise[1], radius + 0.5 * noise[2], self.settings.noise)
