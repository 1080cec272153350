"""Vision's process: at 30 Hz, with dropped frames, it looks at the scene and sends what it sees, late by a latency.

It alone is told the scene's state, as light is told to a camera. Its source turns that into a sighting: a rendered picture
and its evaluation, or the true pose with noise.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from time import monotonic, sleep
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from palmar.models.cell_messages import Sighting
from palmar.worlds.cell.faults import Fault, FaultKind
from palmar.worlds.cell.pose_camera import CameraSettings
from palmar.worlds.cell.process import orphaned, settle
from palmar.worlds.cell.transport import Key, Mailbox, Ports, Sender, open_session
from palmar.worlds.cell.wire import Frame, Light, Ready

Floats = NDArray[np.float64]
NAP, SILENCE = 0.002, 2.0
"""How long (s) it sleeps at most; after so long without light it ends."""
MUCH_LATER = 0.5
"""With the fault of stale frames: additional latency (s)."""
AXIS = slice(15, 17)
"""Of qpos: the cylinder's axis, after 6 joints of the arm and 9 of the fingers."""


class Source(Protocol):
    """What looks."""

    def sight(self, qpos: Floats, stamp_s: float) -> Sighting | None:
        """The sighting of a scene (MuJoCo's qpos) at a time (s), None if the cylinder is not found."""
        ...


@dataclass
class PoseSource:
    """The true pose with noise (m) and a calibration error (m); the cylinder's radius (m) with half the noise."""

    settings: CameraSettings
    radius: float
    random: np.random.Generator

    def sight(self, qpos: Floats, stamp_s: float) -> Sighting | None:
        """Of the axis."""
        noise = self.settings.noise * self.random.standard_normal(3)
        x, y = (qpos[AXIS] + self.settings.bias + noise[:2]).tolist()
        return Sighting(stamp_s, x, y, self.radius + 0.5 * float(noise[2]), self.settings.noise)


@dataclass
class Shutter:
    """Takes frames of the light at their rate, loses some, and lets go of each after its latency."""

    settings: CameraSettings
    source: Source
    random: np.random.Generator
    fault: Fault = field(default_factory=Fault)
    due: float = 0.0
    number: int = 0
    under_way: deque[tuple[float, Frame]] = field(default_factory=deque)
    frozen: Sighting | None = None

    def expose(self, light: Light, now: float) -> None:
        """Take a frame if one is due at a time (s)."""
        if now < self.due:
            return
        self.due = max(self.due + 1.0 / self.settings.rate, now)
        self.number += 1
        if self.fault.now(FaultKind.CAMERA_KILLED, now) or self.random.random() < self.settings.dropped:
            return
        seen = self.source.sight(np.array(light.qpos), light.stamp_s)
        if seen is None:
            return
        if self.fault.now(FaultKind.FRAMES_FROZEN, now):
            self.frozen = self.frozen or seen
            seen = replace(self.frozen, stamp_s=light.stamp_s)
        latency = self.settings.latency + self.settings.jitter * self.random.standard_normal()
        latency += MUCH_LATER if self.fault.now(FaultKind.STALE_FRAMES, now) else 0.0
        self.under_way.append((light.stamp_s + max(0.0, latency), Frame(number=self.number, sighting=seen)))

    def developed(self, now: float) -> list[Frame]:
        """Frames whose latency is over, the oldest first."""
        frames = []
        while self.under_way and self.under_way[0][0] <= now:
            frames.append(self.under_way.popleft()[1])
        return frames


def watch(make: Callable[[], Source], camera: CameraSettings, fault: Fault, seed: int, ports: Ports) -> None:
    """Until there is no light any more; ``make`` makes the source, in this process."""
    source = make()
    settle(None)
    shutter = Shutter(camera, source, np.random.default_rng([seed, 2]), fault)
    with open_session(None, [ports.plant, ports.controller]) as session:
        lights = Mailbox(Light).listen(session, Key.LIGHT)
        frames, ready = Sender[Frame](session, Key.FRAME), Sender[Ready](session, Key.READY)
        light, warm, last = None, False, monotonic()
        while not orphaned() and monotonic() - last < (SILENCE if warm else 60.0):
            newest = lights.take()
            if newest:
                last, light = newest[-1]
            if light is not None and light.epoch_s is None:
                if newest:
                    source.sight(np.array(light.qpos), light.stamp_s)
                    warm = True
                    ready.send(Ready(who="vision"))
            elif light is not None and light.epoch_s is not None:
                now = monotonic() - light.epoch_s
                shutter.expose(light, now)
                for frame in shutter.developed(monotonic() - light.epoch_s):
                    frames.send(frame)
            sleep(NAP)
