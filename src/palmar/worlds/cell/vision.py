"""Vision's process: at 30 Hz, with dropped frames, it looks at the scene and sends what it sees, late by a latency.

It alone is told the scene's state, as light is told to a camera. What looks is made here: a rendered camera that finds the
cylinder in its pictures, or the true pose with noise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic, sleep

import numpy as np
from numpy.typing import NDArray

from palmar.models.cell_messages import Sighting
from palmar.worlds.cell.faults import Fault
from palmar.worlds.cell.pose_camera import PoseCamera
from palmar.worlds.cell.process import orphaned, settle
from palmar.worlds.cell.timed_camera import CameraSettings, Sight, TimedCamera
from palmar.worlds.cell.transport import Key, Mailbox, Ports, Sender, open_session
from palmar.worlds.cell.wire import Frame, Light, Ready

Floats = NDArray[np.float64]
NAP, DARK, NOT_YET = 0.002, 2.0, 60.0
"""How long (s) it sleeps at a time; after so long without light it ends; so long it waits for the first."""
AXIS = slice(15, 17)
"""Of a joint state: the cylinder's axis, after 6 joints of the arm and 9 of the fingers."""


@dataclass(frozen=True)
class PoseSight:
    """What a camera would see of a cylinder of a radius (m), made of the true pose."""

    camera: PoseCamera
    radius: float

    def __call__(self, qpos: Floats, stamp_s: float) -> Sighting | None:
        """At a joint state (nq,) and a time (s)."""
        x, y = qpos[AXIS].tolist()
        return self.camera.sight(stamp_s, x, y, self.radius)


@dataclass
class Retina:
    """The latest light, seen by ``sight``: stamped with the time (s) at which the light left the scene."""

    sight: Sight
    light: Light | None = None

    def see(self, now: float) -> Sighting | None:
        """What is there, whatever the time (s) is."""
        return None if self.light is None else self.sight(np.array(self.light.qpos), self.light.stamp_s)


def watch(make: Callable[[], Sight], settings: CameraSettings, fault: Fault, seed: int, ports: Ports) -> None:
    """Until there is no light any more; ``make`` makes what looks, in this process."""
    retina = Retina(make())
    settle(None)
    camera = TimedCamera(settings, np.random.default_rng([seed, 2]), fault)
    with open_session(None, [ports.plant, ports.controller]) as session:
        lights = Mailbox(Light).listen(session, Key.LIGHT)
        frames, ready = Sender[Frame](session, Key.FRAME), Sender[Ready](session, Key.READY)
        last, patience = monotonic(), NOT_YET
        while not orphaned() and monotonic() - last < patience:
            newest = lights.take()
            if newest:
                (last, retina.light), patience = newest[-1], DARK
                if retina.light.epoch_s is None:
                    retina.see(0.0)
                    ready.send(Ready(who="vision"))
            if retina.light is not None and retina.light.epoch_s is not None:
                camera.expose(monotonic() - retina.light.epoch_s, retina.see)
                for number, sighting in camera.arrivals(monotonic() - retina.light.epoch_s):
                    frames.send(Frame(number=number, sighting=sighting))
            sleep(NAP)
