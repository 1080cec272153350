"""The cell at work: at each servo tick sensors are read, the reflex layer decides, servos pull, and physics goes on.

Torques are limited: the arm's by its motors, the fingers' by tendons that only pull and only so hard. What the behaviours
get to know comes from joint angles, tendon tensions, palm bits and vision; the truth is for the judge.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.behaviours.cell.reflexes import ReflexState, reflex_step
from palmar.errors import InputError
from palmar.mechanics.arm.puma_560 import forward, nearest
from palmar.mechanics.arm.salisbury_finger import tensions
from palmar.models.cell_messages import CellSeen, Eye, HandFelt, HandMode, HandOrder, Owner, Sighting
from palmar.models.cell_task import CellTask, TaskKind
from palmar.models.salisbury_hand import CYLINDRIC, TIP_PREHENSION, Curl, SalisburyHand
from palmar.worlds.cell.alter_mode import AlterMode
from palmar.worlds.cell.faults import FaultKind
from palmar.worlds.cell.pose_camera import PoseCamera
from palmar.worlds.cell.timed_camera import Sight, TimedCamera
from palmar.worlds.mujoco.cell.finger_sense import FingerSense
from palmar.worlds.mujoco.cell.scene import STEP, cell_xml
from palmar.worlds.mujoco.cell.settings import (
    ARM_DAMPING,
    ARM_STIFFNESS,
    FINGER_DAMPING,
    FINGER_STIFFNESS,
    CellSettings,
)
from palmar.worlds.mujoco.engine import mujoco

Floats = NDArray[np.float64]
ARM, FINGERS = slice(0, 6), slice(6, 15)
ELBOW_UP = np.radians([18.0, 71.0, -202.0, 0.0, -49.0, -162.0])
"""Of the branches of the inverse, the one nearest to this is taken at the start."""


@dataclass
class Cell:
    """One trial's cell; the hand frame starts at ``pose`` (4, 4) with open fingers.

    ``eye``: None, a camera in lock-step; ``sight``: what it sees in a frame, None, the true pose with noise.
    """

    hand: SalisburyHand
    task: CellTask
    settings: CellSettings
    pose: Floats
    eye: Eye | None = None
    sight: Sight | None = None
    trace: list[tuple[float, Owner]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.model: Any = mujoco.MjModel.from_xml_string(cell_xml(self.hand, self.task))
        self.data: Any = mujoco.MjData(self.model)
        self.random = np.random.default_rng(self.settings.seed)
        self.mount = np.eye(4)
        self.mount[2, 3] = self.hand.mount
        self.unmount = np.linalg.inv(self.mount)
        self.object = self.model.body("object").id
        curl = TIP_PREHENSION if self.task.kind is TaskKind.TABLE else CYLINDRIC
        self._place(curl)
        self.sense = FingerSense(self.hand, STEP, self.settings.tension_noise)
        self.readings = np.full((3, 4), self.hand.tension_least)
        self.order = HandOrder(HandMode.SHAPE, (curl.opened,) * 3, curl)
        self.reflex = ReflexState((curl.opened,) * 3)
        self.wanted = curl.joints(np.array(self.reflex.set_points))
        self.pose_camera = PoseCamera(self.settings.camera, self.random)
        self.camera = TimedCamera(self.settings.camera, self.random, self.settings.fault)
        self.stopped: str | None = None
        self.sighting: Sighting | None = None
        self.touched, self.palm = [False] * 3, [False] * 2

    def _place(self, curl: Curl) -> None:
        joints = nearest(self.pose @ self.unmount, ELBOW_UP)
        if joints is None:
            raise InputError("cell", None, "the arm must be able to reach the start of the task")
        self.data.qpos[ARM] = joints
        self.data.qpos[FINGERS] = curl.joints(np.full(3, curl.opened)).ravel()
        at = int(self.model.joint("object").qposadr[0])
        speed = int(self.model.joint("object").dofadr[0])
        self.data.qpos[at : at + 2] += self.settings.offset
        self.data.qvel[speed : speed + 2] = self.settings.sway
        mujoco.mj_forward(self.model, self.data)
        self.link = AlterMode(joints)

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return float(self.data.time)

    def _frame(self, now: float) -> Sighting | None:
        if self.sight is not None:
            return self.sight(self.data.qpos, now)
        x, y, _ = self.data.xpos[self.object].tolist()
        return self.pose_camera.sight(now, x, y, self.task.cylinder.radius)

    def seen(self) -> CellSeen:
        """What a behaviour is told now; touches since the last call are kept until it is."""
        curls = self.data.qpos[FINGERS].reshape(3, 3)[:, 1]
        self.sighting = (self.eye or self.camera).look(self.time)
        told = CellSeen(
            self.time,
            forward(self.data.qpos[ARM]) @ self.mount,
            (float(curls[0]), float(curls[1]), float(curls[2])),
            (self.touched[0], self.touched[1], self.touched[2]),
            (self.palm[0], self.palm[1]),
            self.reflex.gripped,
            self.reflex.at_end,
            self.reflex.owner,
            self.stopped,
            self.sighting,
        )
        self.touched, self.palm = [False] * 3, [False] * 2
        return told

    def reply(self, palm_pose: Floats) -> bool:
        """Answer the arm's request with a pose of the hand frame (4, 4); whether the arm can reach it."""
        delay = self.settings.reply + 0.001 * float(self.random.exponential())
        fault = self.settings.fault
        if any(fault.now(silent, self.time) for silent in (FaultKind.CONTROLLER_KILLED, FaultKind.CONTROLLER_HUNG)):
            return self.answer(self.time, np.inf, None)
        if fault.now(FaultKind.LATE_REPLY, self.time):
            delay = 0.020
        return self.answer(self.time, delay, palm_pose)

    def answer(self, asked: float, delay: float, palm_pose: Floats | None) -> bool:
        """To the request made at a time (s), ``delay`` (s) later, None if it never came; whether the arm can reach it."""
        joints = None if palm_pose is None else nearest(palm_pose @ self.unmount, self.link.goal)
        reachable = palm_pose is None or joints is not None
        self.link.reply(asked, delay, joints if reachable else self.link.goal)
        if self.link.interrupted:
            self.stopped = "the reply to the arm was late"
        return reachable

    def hold(self, why: str) -> None:
        """Stop the arm where it is and leave the hand as it is, for good."""
        self.stopped = self.stopped or why
        self.link.hold()

    def tick(self) -> None:
        """One servo tick and one step of physics."""
        data, now = self.data, self.time
        if self.eye is None:
            self.camera.expose(now, self._frame)
        felt = self._feel(now)
        self.reflex = reflex_step(self.reflex, felt, self.order, self.stopped is not None, STEP)
        if not self.trace or self.trace[-1][1] is not self.reflex.owner:
            self.trace.append((now, self.reflex.owner))
        if self.reflex.owner is Owner.SENSOR_FAULT:
            self.stopped = self.stopped or "a tendon reads slack"
        goal, rate = self.link.advance(now, STEP)
        position, speed, weight = data.qpos[:15], data.qvel[:15], data.qfrc_bias[:15]
        data.ctrl[ARM] = ARM_STIFFNESS * (goal - position[ARM]) + ARM_DAMPING * (rate - speed[ARM]) + weight[ARM]
        data.ctrl[FINGERS] = self._pull(position[FINGERS], speed[FINGERS], weight[FINGERS])
        mujoco.mj_step(self.model, data)

    def _feel(self, now: float) -> HandFelt:
        sense = self.sense
        weight = self.data.qfrc_bias[FINGERS].reshape(3, 3)
        sense.feel(self.readings, self.data.qvel[FINGERS].reshape(3, 3), weight)
        touched, press = sense.touched, sense.press
        one, other = self.data.sensordata.tolist()
        palm, fault = (one > self.settings.palm_force, other > self.settings.palm_force), self.settings.fault
        if fault.now(FaultKind.PALM_STUCK_ON, now):
            palm = True, True
        elif fault.now(FaultKind.PALM_STUCK_OFF, now):
            palm = False, False
        self.touched = [a or b for a, b in zip(self.touched, touched, strict=True)]
        self.palm = [a or b for a, b in zip(self.palm, palm, strict=True)]
        most = 0.98 * self.hand.tension_most
        return HandFelt(
            now,
            touched,
            press,
            palm,
            bool(sense.mean.max() > most),
            sense.dead,
        )

    def _pull(self, position: Floats, speed: Floats, weight: Floats) -> Floats:
        """Joint torques (9,) that tendons make of the servos' wish; readings are theirs with noise."""
        wanted = self.order.curl.joints(np.array(self.reflex.set_points))
        rate = (wanted - self.wanted) / STEP
        self.wanted = wanted
        wish = FINGER_STIFFNESS * (wanted - position.reshape(3, 3)) + FINGER_DAMPING * (rate - speed.reshape(3, 3))
        pulled = np.minimum(tensions(self.hand, wish + weight.reshape(3, 3)), self.hand.tension_most)
        self.readings = pulled + self.settings.tension_noise * self.random.standard_normal((3, 4))
        if self.settings.fault.now(FaultKind.TENDON_DEAD, self.time):
            self.readings[0, 1] = 0.0
        torques: Floats = (pulled @ self.sense.law).ravel()
        return torques
