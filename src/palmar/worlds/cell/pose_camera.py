"""What a camera would see, made of the true pose: it stands in where nothing can be rendered, and in statistics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from palmar.models.cell_messages import Sighting
from palmar.worlds.cell.timed_camera import CameraSettings


@dataclass(frozen=True)
class PoseCamera:
    """With noise and calibration error."""

    settings: CameraSettings
    random: np.random.Generator

    def sight(self, now: float, x: float, y: float, radius: float) -> Sighting:
        """Of a true axis and radius (m) at a time (s)."""
        east, north = self.settings.bias
        noise = self.settings.noise * self.random.standard_normal(3)
        return Sighting(now, x + east + noise[0], y + north + noise[1], radius + 0.5 * noise[2], self.settings.noise)
