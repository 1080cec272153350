"""Set-points for the arm on a straight line: a trapezoid of speed, one point for each request of the arm's controller."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin, sqrt

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
PERIOD = 0.028
"""Time between two requests (s)."""
ACCELERATION = 0.8
"""Of the set-points (m/s^2)."""
THERE = 2e-4
"""How near (m) a target counts as reached."""
TURN_RATE = 1.0
"""About the hand's own axis (rad/s)."""


@dataclass(frozen=True)
class ArmPath:
    """The latest set-point of the hand frame (4, 4) and its speed (m/s)."""

    pose: Floats
    speed: float = 0.0

    @property
    def place(self) -> Floats:
        """Of the palm's middle (m)."""
        place: Floats = self.pose[:3, 3]
        return place

    def there(self, goal: Floats) -> bool:
        """Whether the set-point has reached a goal (m) and stands."""
        return float(np.linalg.norm(goal - self.place)) < THERE and self.speed == 0.0


def toward(path: ArmPath, goal: Floats, fastest: float) -> ArmPath:
    """The next set-point on the way to ``goal`` (m) at up to ``fastest`` (m/s)."""
    left = goal - path.place
    distance = float(np.linalg.norm(left))
    if distance < THERE:
        return ArmPath(_moved(path.pose, goal), 0.0)
    gain = ACCELERATION * PERIOD
    speed = min(fastest, path.speed + gain, sqrt(2.0 * ACCELERATION * distance))
    step = min(speed * PERIOD, distance)
    return ArmPath(_moved(path.pose, path.place + left / distance * step), step / PERIOD if step < distance else 0.0)


def turned(path: ArmPath, left: float) -> tuple[ArmPath, float]:
    """The same place with the hand turned about its own z axis, by at most one step toward ``left`` (rad); how far."""
    step = max(-TURN_RATE * PERIOD, min(TURN_RATE * PERIOD, left))
    cosine, sine = cos(step), sin(step)
    pose = path.pose.copy()
    pose[:3, :3] = pose[:3, :3] @ np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    return ArmPath(pose, path.speed), step


def halt(path: ArmPath) -> ArmPath:
    """Stay at the latest set-point."""
    return ArmPath(path.pose, 0.0)


def _moved(pose: Floats, place: Floats) -> Floats:
    moved = pose.copy()
    moved[:3, 3] = place
    return moved
