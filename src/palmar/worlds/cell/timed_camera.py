"""When frames are taken and when what was seen in them arrives: rate, latency, jitter, dropped frames, and faults.

What is seen in a frame is another's business: the true pose with noise (``pose_camera``), or a rendered picture.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from palmar.errors import InputError
from palmar.models.cell_messages import Sighting
from palmar.worlds.cell.faults import Fault, FaultKind

Sight = Callable[[NDArray[np.float64], float], Sighting | None]
"""Of the cylinder at a joint state (nq,) and a time (s)."""


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
        least = min(self.latency, self.jitter, self.noise, self.grain)
        if self.rate <= 0.0 or least < 0.0 or not 0.0 <= self.dropped < 1.0:
            raise InputError(
                "camera",
                None,
                "the rate must be positive, latency, jitter, noise and grain not negative, dropped in 0 to 1",
            )


@dataclass
class TimedCamera:
    """Frames are taken when ``expose`` is called in time; ``frames``: how many were due, also those that were lost."""

    settings: CameraSettings
    random: np.random.Generator
    fault: Fault = field(default_factory=Fault)
    due: float = 0.0
    frames: int = 0
    under_way: deque[tuple[float, int, Sighting]] = field(default_factory=deque)
    latest: Sighting | None = None
    frozen: Sighting | None = None

    def expose(self, now: float, see: Callable[[float], Sighting | None]) -> None:
        """Take a frame if one is due at time ``now`` (s); ``see``: what is to be seen then, None where nothing is."""
        if now < self.due:
            return
        self.due = max(self.due + 1.0 / self.settings.rate, now)
        self.frames += 1
        gone = self.fault.now(FaultKind.CAMERA_KILLED, now) or self.fault.now(FaultKind.VISION_KILLED, now)
        if gone or self.random.random() < self.settings.dropped:
            return
        seen = see(now) if self.frozen is None else replace(self.frozen, stamp_s=now)
        if seen is None:
            return
        if self.fault.now(FaultKind.FRAMES_FROZEN, now):
            self.frozen = seen
        delay = max(0.0, self.settings.latency + self.settings.jitter * self.random.standard_normal())
        stamp = seen.stamp_s - (0.5 if self.fault.now(FaultKind.STALE_FRAMES, now) else 0.0)
        self.under_way.append((now + delay, self.frames, replace(seen, stamp_s=stamp)))

    def arrivals(self, now: float) -> list[tuple[int, Sighting]]:
        """What has arrived by now (s), with the number of its frame, the oldest first."""
        found = []
        while self.under_way and self.under_way[0][0] <= now:
            found.append(self.under_way.popleft()[1:])
        return found

    def look(self, now_s: float) -> Sighting | None:
        """The newest sighting that has arrived."""
        for _, sighting in self.arrivals(now_s):
            if self.latest is None or sighting.stamp_s > self.latest.stamp_s:
                self.latest = sighting
        return self.latest
