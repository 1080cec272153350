"""What can be made to fail in the cell, and when: in real time processes are killed or stopped, in lock-step silent."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class FaultKind(Enum):
    """One fault each."""

    NONE = "none"
    CAMERA_KILLED = "camera-killed"
    FRAMES_FROZEN = "frames-frozen"
    STALE_FRAMES = "stale-frames"
    PALM_STUCK_ON = "palm-stuck-on"
    PALM_STUCK_OFF = "palm-stuck-off"
    TENDON_DEAD = "tendon-dead"
    LATE_REPLY = "late-reply"
    CONTROLLER_KILLED = "controller-killed"
    CONTROLLER_HUNG = "controller-hung"
    VISION_KILLED = "vision-killed"


@dataclass(frozen=True)
class Fault:
    """From ``start`` (s) on."""

    kind: FaultKind = FaultKind.NONE
    start: float = 0.0

    def now(self, kind: FaultKind, time: float) -> bool:
        """Whether this fault is of a kind and has set in."""
        return self.kind is kind and time >= self.start
