"""One hand and one object in MuJoCo, under feedback: what ``worlds.planar.feedback`` is to the kernels.

What differs is physics: the object has inertia, motors are limited, contacts give way a little, and friction resists slip by
creep. What is felt and what has become of the object are judged by the planar world's own code (``judges``) from the poses
reached.

A finger that does not turn though told to is held up, and stays so until it is told something else; the palm and the
joints' ends stop a finger as in the planar world. In free space everything stands still once the outcome is decided.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np

from palmar.mechanics.pushing.slider import moved_poses
from palmar.models.case import Case
from palmar.models.motion import Command, Joints, Observation
from palmar.models.outcome import Outcome
from palmar.worlds.mujoco.bed_servos import BedServos, bed_servos
from palmar.worlds.mujoco.engine import mujoco
from palmar.worlds.mujoco.judges import Judge, Place, judge_of
from palmar.worlds.mujoco.scene import Scene, scene_of
from palmar.worlds.mujoco.servos import Servos, servos_of
from palmar.worlds.mujoco.table_friction import TableLaw
from palmar.worlds.planar.bits import Bits, Sensing, bits_of
from palmar.worlds.planar.carriage import Touch
from palmar.worlds.planar.feedback import NO_TIME, TICK
from palmar.worlds.planar.finger_pair import SIDES
from palmar.worlds.planar.finger_travel import FingerTravel, travel_of

LOOK = 0.01
"""Longest time (s) between two looks at whether a finger is held up."""
STALL_TURN, STALL_SHARE = 0.02, 0.1
"""A finger is held up once it has turned by less than this share of so much (rad) that it was told to turn."""
STILL, LEAST_CHANGE = 1e-5, 1e-9
"""Speeds (m/s, rad/s): of a scene in which nothing moves; by which a free object has changed its own where it was struck."""


@dataclass
class MujocoWorld:
    """Made by ``mujoco_world``; ``told``, ``held`` and ``gripped`` as in the planar world.

    ``slow``: for how much told turning (rad) each finger has hardly turned; ``over``:
    whether the outcome is decided.
    """

    scene: Scene
    model: Any
    data: Any
    servos: Servos
    judge: Judge
    travel: FingerTravel
    bits: Bits
    massive: bool
    tick: float
    invalid: bool = False
    time: float = 0.0
    told: tuple[Joints, Joints] = ((), ())
    held: list[bool] = field(default_factory=lambda: [False, False])
    gripped: list[bool] = field(default_factory=lambda: [False, False])
    slow: list[float] = field(default_factory=lambda: [0.0, 0.0])
    still: bool = False
    firing: tuple[bool, ...] = ()
    touched: bool = False
    over: bool = False

    @property
    def first(self) -> int:
        """Of the object's among the scene's coordinates."""
        return 2 + 2 * self.servos.joints

    @property
    def settled(self) -> bool:
        """Whether nothing moves under the last command, or the world cannot go on."""
        return self.still or self.broken

    @property
    def broken(self) -> bool:
        """Whether the start was invalid or the simulation has diverged."""
        return self.invalid or bool(self.data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number > 0)

    @property
    def ambiguous(self) -> bool:
        """Inertia chooses: there is always one motion."""
        return False

    @property
    def pose(self) -> tuple[float, float, float]:
        """Of the object's frame: x, y (m), theta (rad) in the frame where the hand started."""
        x, y, theta = moved_poses(self.scene.slider.centre, np.array([self._place()]), -1.0)[0]
        return float(x), float(y), float(theta)

    def observe(self) -> Observation:
        """What the hand feels and knows of itself now."""
        right, left = self.servos.angles
        return Observation(self.time, right, left, self.firing, (self.held[0], self.held[1]), (*self.servos.arm, 0.0))

    def act(self, command: Command, seconds: float) -> float:
        """Let a command hold for so long, or as long as it allows; returns the seconds it held."""
        span = seconds if command.longest is None else min(seconds, command.longest)
        self._listen(command)
        left = span
        while left > NO_TIME and not self.broken and not self.over:
            left -= self._go(command, min(left, LOOK))
            self._look()
            self.over = self.judge.decided(self.servos.angles)
        if self.over:
            self.held, self.still = [True, True], True
        self.time += span
        self.feel(span, not self._slides_by(command) and not any(self.gripped))
        return span

    def outcome(self) -> Outcome:
        """What has become of the object, were this the end."""
        if self.broken:
            return Outcome.INVALID if self.invalid else Outcome.UNDECIDED
        self._look()
        return self.judge.outcome(self.servos.angles, (self.gripped[0], self.gripped[1]), self.touched)

    def feel(self, seconds: float, displaces: bool) -> None:
        """Read the sensors, ``seconds`` after the last reading; ``displaces``: touch moves the object."""
        touches = self._touches()
        self.touched = self.touched or any(each.link > 0 for each in touches) or self._struck()
        self.firing = self.bits.read(touches, self._place()[:2], seconds, displaces)

    def _place(self) -> Place:
        x, y, theta = self.data.qpos[self.first : self.first + 3].tolist()
        return x, y, theta

    def _look(self) -> None:
        self.judge.see(self._place(), self.servos.arm)

    def _touches(self) -> list[Touch]:
        self._look()
        return self.judge.touches(self.servos.angles)

    def _struck(self) -> bool:
        """Whether a free object no longer moves as at the start."""
        change = self.data.qvel[self.first : self.first + 2] - self.scene.case.start.velocity
        return self.scene.free and bool(np.abs(change).max() > LEAST_CHANGE)

    def _listen(self, command: Command) -> None:
        """A finger that is told something else is free again."""
        told = command.right, command.left
        if any(len(each) != len(self.travel.links) for each in told):
            raise ValueError(f"a command needs a rate for each of a finger's {len(self.travel.links)} joints")
        for side in SIDES:
            if told[side] != self.told[side]:
                self.held[side], self.slow[side] = False, 0.0
                self.gripped[side] = self.gripped[side] and not any(told[side])
        self.told = told

    def _go(self, command: Command, left: float) -> float:
        """Go on for at most ``left`` (s), until a joint is at its end or a link on the palm; returns the time this took."""
        angles = self.servos.angles
        rates = self._rates(0, angles[0]), self._rates(1, angles[1])
        palm = [self.travel.to_palm(angles[k], rates[k], left) for k in SIDES]
        span = min([left, *palm, *(self.travel.to_joint_end(angles[k], rates[k]) for k in SIDES)])
        span = max(span, 0.01 * self.scene.step)
        self.servos.tell(rates, command.velocity)
        if self._slides_by(command):
            span = min(span, self.scene.step)
            self._go_by(command.velocity, span)
        else:
            self.servos.go(span, self.scene.step)
        for side in SIDES:
            self._notice_stall(side, angles[side], rates[side], span)
            if any(rates[side]) and palm[side] <= span:
                self.held[side] = True
        self.still = bool(np.abs(self.data.qvel).max() < STILL)
        return span

    def _slides_by(self, command: Command) -> bool:
        """Whether the arm moves by an object that stays."""
        return self.massive and not command.moves_fingers

    def _go_by(self, velocity: tuple[float, float], span: float) -> None:
        """Only the arm moves, by an object that stays: for ``span`` (s), a step at most, unless that would push it."""
        place, speed = self.data.qpos[self.first :].copy(), self.data.qvel[self.first :].copy()
        mujoco.mj_fwdPosition(self.model, self.data)
        if self._pushes(velocity):
            self.servos.halt_arm()
        self.servos.go(span, self.scene.step)
        self.data.qpos[self.first :], self.data.qvel[self.first :] = place, speed

    def _pushes(self, velocity: tuple[float, float]) -> bool:
        """Whether the arm, with this velocity, would push the object."""
        contacts, bodies = self.data.contact, self.model.geom_bodyid
        thing = bodies[self.model.geom("outline").id]
        for (one, other), frame in zip(contacts.geom, contacts.frame, strict=True):
            if bodies[one] and bodies[other] and thing in (bodies[one], bodies[other]):
                way = 1.0 if bodies[other] == thing else -1.0
                if way * (frame[0] * velocity[0] + frame[1] * velocity[1]) > 0.0:
                    return True
        return False

    def _rates(self, side: int, angles: Joints) -> Joints:
        """The rates of a finger that is told to move, without what is held up; notes if that is all of it."""
        told = self.told[side]
        rates = self.travel.allowed(angles, told)
        self.held[side] = any(told) and (self.held[side] or not any(rates))
        return tuple(0.0 for _ in told) if self.held[side] else rates

    def _notice_stall(self, side: int, before: Joints, rates: Joints, span: float) -> None:
        wanted = span * sum(abs(each) for each in rates)
        if wanted == 0.0:
            return
        after = self.servos.angles[side]
        turned = sum(abs(b - a) for a, b, rate in zip(before, after, rates, strict=True) if rate)
        self.slow[side] = self.slow[side] + wanted if turned < STALL_SHARE * wanted else 0.0
        if self.slow[side] >= STALL_TURN:
            self.held[side] = True
            self.gripped[side] = self._pressed(side)

    def _pressed(self, side: int) -> bool:
        """Whether the object touches a finger, and the fingers do not touch each other."""
        count = len(self.travel.links)
        mine = range(1 + side * count, 1 + (side + 1) * count)
        fingers_meet = bool(np.isin(self.data.contact.geom, self.scene.meeting(self.model)).any())
        return not fingers_meet and any(each.link in mine for each in self._touches())


Made = TypeVar("Made", bound=MujocoWorld)


@dataclass
class BedWorld(MujocoWorld):
    """Made by ``bed_world``: a finger is held up once its motor has told of a contact."""

    def _notice_stall(self, side: int, before: Joints, rates: Joints, span: float) -> None:
        if any(rates) and isinstance(self.servos, BedServos) and self.servos.contact(side):
            self.held[side] = True
            self.gripped[side] = self._pressed(side)


def mujoco_world(
    case: Case,
    start: tuple[float, float, float],
    *,
    tick: float = TICK,
    sensing: Sensing | None = None,
    massive: bool = False,
    step: float | None = None,
    law: TableLaw = TableLaw.EXACT,
) -> MujocoWorld:
    """As ``feedback_world``: the object's frame at ``start`` (m, rad) in the hand frame, the fingers open.

    The object has the velocity of the case's start. ``step`` (s): of the simulation, else as the scene has it;
    ``law``: how friction with the table is had. Raises
    NotCoveredError for what this world does not have.
    """
    return _begin(MujocoWorld, scene_of(case, step, law), start, tick, sensing, massive)


def _begin(kind: type[Made], scene: Scene, start: Place, tick: float, sensing: Sensing | None, massive: bool) -> Made:
    """A scene's world with its hand open and its object in place."""
    case, hand = scene.case, scene.case.hand
    model = mujoco.MjModel.from_xml_string(scene.xml())
    data = mujoco.MjData(model)
    x, y, theta = (float(each) for each in moved_poses(scene.slider.centre, np.array([start]), 1.0)[0])
    servos = servos_of(scene, model, data)
    if scene.servos:
        servos = bed_servos(servos, case.bed)
    servos.place((case.open_joints, case.open_joints))
    judge = judge_of(scene, (x, y, theta))
    faults = Sensing(case.sensors.displacement) if sensing is None else sensing
    bits = bits_of(hand, case.sensors.stretches(hand), faults)
    world = kind(scene, model, data, servos, judge, travel_of(hand), bits, massive, tick)
    world.firing = (False,) * len(bits.rows)
    world.invalid = judge.overlaps(world.servos.angles)
    data.qpos[world.first : world.first + 3] = x, y, theta
    data.qvel[world.first : world.first + 2] = case.start.velocity
    if not world.invalid:
        world.feel(0.0, not massive)
    return world


def bed_world(
    case: Case,
    start: Place,
    *,
    tick: float = TICK,
    sensing: Sensing | None = None,
    massive: bool = False,
    step: float | None = None,
    law: TableLaw = TableLaw.EXACT,
) -> BedWorld:
    """As ``mujoco_world``, with the motors of the case's bed and the source's way to tell a contact; the wrist is fixed."""
    return _begin(BedWorld, scene_of(case, step, law, servos=True), start, tick, sensing, massive)
