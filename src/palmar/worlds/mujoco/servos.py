"""The hand's motors: joints and arm follow a set point that moves at the commanded rate, by a spring and a damper.

A joint pushes with a limited torque in the direction it is told to turn, and is not driven back: its gear holds whatever
load. Told nothing, it holds its angle. In free space fingers are heavy, and have the rate that they are told at once.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.models.motion import Joints
from palmar.worlds.mujoco.engine import mujoco
from palmar.worlds.mujoco.impacts import Flight
from palmar.worlds.mujoco.scene import GRAVITY, Scene
from palmar.worlds.mujoco.stiction import stiction_of
from palmar.worlds.mujoco.table_friction import TableFriction

Both = tuple[Joints, Joints]
UNLIMITED = 1e12
"""Torque (N m)."""


@dataclass
class Servos:
    """Of a scene's model and data; actuators come in pairs, spring and damper, right joints, left joints, arm."""

    model: Any
    data: Any
    joints: int
    torque: float
    stiffness: float
    at_once: bool
    friction: TableFriction | None
    flight: Flight | None
    told: NDArray[np.float64] = field(init=False)

    def __post_init__(self) -> None:
        self.told = np.full(2 * self.joints + 2, np.nan)

    @property
    def angles(self) -> Both:
        """Joint angles (rad), right and left."""
        each = self.data.qpos[2 : 2 + 2 * self.joints].tolist()
        return tuple(each[: self.joints]), tuple(each[self.joints :])

    @property
    def arm(self) -> tuple[float, float]:
        """Where the arm is (m)."""
        x, y = self.data.qpos[:2].tolist()
        return x, y

    def place(self, angles: Both) -> None:
        """Put the joints at these angles, at rest."""
        flat = [*angles[0], *angles[1]]
        self.data.qpos[2 : 2 + 2 * self.joints] = flat
        self.data.act[: 2 * self.joints] = flat

    def tell(self, rates: Both, velocity: tuple[float, float]) -> None:
        """Turn and move so from now on."""
        told = np.array((*rates[0], *rates[1], *velocity))
        if np.array_equal(told, self.told):
            return
        self.told = told
        if self.at_once:
            self.data.qvel[2 : 2 + 2 * self.joints], self.data.qvel[:2] = told[:-2], told[-2:]
        self.data.ctrl[0::2] = self.told
        self.data.ctrl[1::2] = self.told
        turns = self.told[:-2]
        limits = self.model.jnt_actfrcrange[2 : 2 + 2 * self.joints]
        limits[:, 0] = np.where(turns < 0.0, -self.torque, -UNLIMITED)
        limits[:, 1] = np.where(turns > 0.0, self.torque, UNLIMITED)
        self.model.jnt_range[2 : 2 + 2 * self.joints] = -UNLIMITED, UNLIMITED
        self._lock_behind()

    def halt_arm(self) -> None:
        """Stop the arm where it is."""
        self.data.ctrl[-4:], self.data.qvel[:2] = 0.0, 0.0
        self.data.act[-2:] = self.data.qpos[:2]
        self.told[-2:] = 0.0

    def go(self, seconds: float, step: float) -> None:
        """Let the scene go on; set points do not run away from joints that are held up."""
        self.advance(seconds, step)
        turns = self.data.qpos[2 : 2 + 2 * self.joints]
        ahead = np.where(self.told[:-2] == 0.0, UNLIMITED, self.torque) / self.stiffness
        set_points = self.data.act[: 2 * self.joints]
        np.clip(set_points, turns - ahead, turns + ahead, out=set_points)
        self._lock_behind()

    def advance(self, seconds: float, step: float) -> None:
        """Let the scene go on, whatever the motors do."""
        if self.flight is not None:
            self.flight.go(seconds, step)
            return
        number = max(1, int(np.ceil(seconds / step - 1e-6)))
        self.model.opt.timestep = seconds / number
        if self.friction is None:
            mujoco.mj_step(self.model, self.data, number)
        else:
            for _ in range(number):
                self.friction.prepare()
                mujoco.mj_step(self.model, self.data)

    def _lock_behind(self) -> None:
        """No joint that is told to turn goes back behind where it has been."""
        turns, ends = self.data.qpos[2 : 2 + 2 * self.joints], self.model.jnt_range[2 : 2 + 2 * self.joints]
        ends[:, 0] = np.where(self.told[:-2] > 0.0, np.maximum(ends[:, 0], turns), -UNLIMITED)
        ends[:, 1] = np.where(self.told[:-2] < 0.0, np.minimum(ends[:, 1], turns), UNLIMITED)


def servos_of(scene: Scene, model: Any, data: Any) -> Servos:
    """The motors of a scene's hand."""
    joints = len(scene.case.hand.finger_links)
    friction = None
    flight, bed = None, scene.case.bed
    if scene.free:
        flight = Flight(model, data, model.geom("outline").id, 2 + 2 * joints, bed.tilt_loss)
    if not scene.free and not scene.on_foot:
        sticky = stiction_of(scene.slider.surface, bed.stiction, bed.stiction_speed)
        force = scene.case.support.friction * scene.case.object.mass * GRAVITY
        friction = TableFriction(model, data, 2 + 2 * joints, scene.slider.surface, force, sticky)
    stiffness = float(model.actuator_gainprm[0, 0])
    return Servos(model, data, joints, scene.torque, stiffness, scene.free, friction, flight)
