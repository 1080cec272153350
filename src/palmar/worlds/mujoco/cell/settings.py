"""What varies from trial to trial in the cell, and the gains of its servos."""

from __future__ import annotations

from dataclasses import dataclass, field

from palmar.errors import InputError
from palmar.worlds.cell.faults import Fault
from palmar.worlds.cell.timed_camera import CameraSettings

ARM_STIFFNESS = (3000.0, 8000.0, 2500.0, 400.0, 400.0, 300.0)
"""Of the arm's joint servos (N m/rad)."""
ARM_DAMPING = (200.0, 400.0, 130.0, 20.0, 20.0, 14.0)
"""(N m s/rad)."""
FINGER_STIFFNESS = (8.0, 6.0, 3.0)
"""Of a finger's joint servos (N m/rad)."""
FINGER_DAMPING = (0.20, 0.16, 0.08)
"""(N m s/rad)."""


@dataclass(frozen=True)
class CellSettings:
    """One trial. Noise (N) of each tendon's tension sensor; palm bits fire above ``palm_force`` (N).

    ``offset`` (m): where the cylinder really is, from the task's place; ``sway`` (m/s): how it moves at the start, if it
    hangs; ``turn`` (rad): error of the wrist about the hand's y axis; ``reply`` (s): mean time for a reply to the arm.
    """

    seed: int = 0
    offset: tuple[float, float] = (0.0, 0.0)
    sway: tuple[float, float] = (0.0, 0.0)
    camera: CameraSettings = field(default_factory=CameraSettings)
    tension_noise: float = 2.0
    palm_force: float = 0.3
    turn: float = 0.0
    reply: float = 0.003
    fault: Fault = field(default_factory=Fault)

    def __post_init__(self) -> None:
        if self.tension_noise < 0.0 or self.palm_force <= 0.0 or self.reply < 0.0:
            raise InputError(
                "cell", None, "noise and reply time must not be negative, the palm's threshold must be positive"
            )
