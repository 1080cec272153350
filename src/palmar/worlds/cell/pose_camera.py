"""The simulated camera: sightings made of the true pose, with a frame rate, latency, jitter, dropped frames and noise.

It stands in for a vision process wherever nothing can be rendered, and in lock-step statistics.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from palmar.errors import InputError
from palmar.models.cell_messages import Sighting
from palmar.worlds.cell.faults import Fault, FaultKind


@dataclass(frozen=True)
class CameraSettings:
    """Frames per second; latency and its jitter's standard deviation (s); share of frames dropped.

    ``noise`` (m): of sightings made of the true pose; ``grain``: of a rendered picture's pixels, of 255; ``bias`` (m): a
    calibration error, the same in every frame.
    """

    rate: float = 30.0
    latency: float = 0.040
    jitter: float = 0.008
    dropped: float = 0.05
    noise: float = 0.0015
    grain: float = 3.0
    bias: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        if (
            self.rate <= 0.0
            or min(self.latency, self.jitter, self.noise, self.grain) < 0.0
            or not 0.0 <= self.dropped < 1.0
        ):
            raise InputError(
                "camera",
                None,
                "the rate must be positive, latency, jitter, noise and grain not negative, dropped in 0 to 1",
            )


@dataclass
class PoseCamera:
    """``where`` gives the axis' true place and radius (m) now; frames are taken when ``expose`` is called in time."""

    settings: CameraSettings
    where: Callable[[], tuple[float, float, float]]
    random: np.random.Generator
    fault: Fault = field(default_factory=Fault)
    due: float = 0.0
    under_way: deque[tuple[float, Sighting]] = field(default_factory=deque)
    latest: Sighting | None = None
    frozen: tuple[float, float, float] | None = None

    def expose(self, now: float) -> None:
        """Take a frame if one is due at time ``now`` (s)."""
        if now < self.due:
            return
        self.due += 1.0 / self.settings.rate
        if self.fault.now(FaultKind.CAMERA_KILLED, now) or self.random.random() < self.settings.dropped:
            return
        x, y, radius = self.where()
        noise = self.settings.noise * self.random.standard_normal(3)
        seen = (x + self.settings.bias[0] + noise[0], y + self.settings.bias[1] + noise[1], radius + 0.5 * noise[2])
        if self.fault.now(FaultKind.FRAMES_FROZEN, now):
            self.frozen = seen = self.frozen or seen
        delay = max(0.0, self.settings.latency + self.settings.jitter * self.random.standard_normal())
        stamp = now - (0.5 if self.fault.now(FaultKind.STALE_FRAMES, now) else 0.0)
        self.under_way.append((now + delay, Sighting(stamp, *seen, self.settings.noise)))

    def look(self, now_s: float) -> Sighting | None:
        """The newest sighting that has arrived."""
        while self.under_way and self.under_way[0][0] <= now_s:
            _, sighting = self.under_way.popleft()
            if self.latest is None or sighting.stamp_s > self.latest.stamp_s:
                self.latest = sighting
        return self.latest
