"""One hand and one object on a table in MuJoCo, under feedback: what ``worlds.planar.feedback`` is to the kernels.

What differs is physics: the object has inertia, motors are limited, contacts give way a little, and friction resists slip by
creep. What is felt and what has become of the object are judged by the planar world's own code from the poses reached: a
gap of up to ``NEAR`` counts as a touch, and friction cones count as wider by what the motors' limit leaves open.

A finger that does not turn though told to is held up, and stays so until it is told something else; the palm and the
joints' ends stop a finger as in the planar world.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.closing_motion import TOUCHED, bench
from palmar.mechanics.pushing.closing_steps import TOLERANCE
from palmar.mechanics.pushing.hand_pose import MOST_LINKS
from palmar.mechanics.pushing.polygon_contacts import Body, Scale, scale_of
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import moved_poses, slider_body
from palmar.models.case import Case
from palmar.models.motion import Command, Joints, Observation
from palmar.models.outcome import Outcome
from palmar.worlds.mujoco.engine import mujoco
from palmar.worlds.mujoco.scene import STEP, STRENGTH, Scene
from palmar.worlds.mujoco.servos import Servos, servos_of
from palmar.worlds.planar.bits import Bits, Sensing, bits_of
from palmar.worlds.planar.carriage import NEAR as PLANAR_NEAR
from palmar.worlds.planar.carriage import Carriage
from palmar.worlds.planar.feedback import NO_TIME, SIDES, TICK
from palmar.worlds.planar.finger_travel import FingerTravel, travel_of
from palmar.worlds.planar.table import refuse_uncovered

NEAR = 5e-4
"""Gaps up to this part of the finger's length are felt and hold."""
CONE_SLACK = 1.0 / STRENGTH + 0.01
"""A motor that is held up has pushed with so many table frictions, which may lean a cone by their inverse."""
LOOK = 0.005
"""Longest time (s) between two looks at whether a finger is held up."""
STALL_TURN, STALL_SHARE = 0.02, 0.1
"""A finger is held up once it has turned by less than this share of so much (rad) that it was told to turn."""
MOST_CORNERS, THINNEST = 64, 20.0
"""Corners; least width of a polygon in units of the scene's rounding."""


@dataclass
class MujocoTable:
    """Made by ``mujoco_table``; ``told``, ``held`` and ``gripped`` as in the planar world.

    ``slow``: for how much told turning (rad) each finger has hardly turned.
    """

    scene: Scene
    model: Any
    data: Any
    servos: Servos
    carriage: Carriage
    travel: FingerTravel
    bits: Bits
    tick: float
    invalid: bool = False
    time: float = 0.0
    told: tuple[Joints, Joints] = ((), ())
    held: list[bool] = field(default_factory=lambda: [False, False])
    gripped: list[bool] = field(default_factory=lambda: [False, False])
    slow: list[float] = field(default_factory=lambda: [0.0, 0.0])
    still: bool = False
    firing: tuple[bool, ...] = ()

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
        while left > NO_TIME and not self.broken:
            left -= self._go(command, min(left, LOOK))
        self.time += span
        self.feel(span)
        return span

    def outcome(self) -> Outcome:
        """What has become of the object, were this the end."""
        if self.broken:
            return Outcome.INVALID if self.invalid else Outcome.UNDECIDED
        self._settle_carriage()
        return Outcome.from_code(self.carriage.judged(self.servos.angles, (self.gripped[0], self.gripped[1])))

    def feel(self, seconds: float) -> None:
        """Read the sensors, ``seconds`` after the last reading."""
        self._settle_carriage()
        touches = self.carriage.touches(self.servos.angles)
        if any(each.link > 0 for each in touches):
            self.carriage.at.state[TOUCHED] = 1.0
        self.firing = self.bits.read(touches, self.carriage.place[:2], seconds, not any(self.gripped))

    def _place(self) -> tuple[float, float, float]:
        x, y, _, theta = self.data.qpos[-4:].tolist()
        return x, y, theta

    def _settle_carriage(self) -> None:
        self.carriage.place, self.carriage.arm = self._place(), self.servos.arm

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
        self.servos.go(span, self.scene.step)
        for side in SIDES:
            self._notice_stall(side, angles[side], rates[side], span)
            if any(rates[side]) and palm[side] <= span:
                self.held[side] = True
        self.still = bool(np.abs(self.data.qvel).max() < 1e-5)
        return span

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
        turned = sum(abs(b - a) for a, b, rate in zip(before, after, rates, strict=True) if a != b and rate != 0.0)
        self.slow[side] = self.slow[side] + wanted if turned < STALL_SHARE * wanted else 0.0
        if self.slow[side] >= STALL_TURN:
            self.held[side] = True
            self.gripped[side] = self._pressed(side)

    def _pressed(self, side: int) -> bool:
        """Whether the object touches a finger, and the other finger does not."""
        count = len(self.travel.links)
        self._settle_carriage()
        mine = range(1 + side * count, 1 + (side + 1) * count)
        return any(each.link in mine for each in self.carriage.touches(self.servos.angles))


def mujoco_table(
    case: Case,
    start: tuple[float, float, float],
    *,
    tick: float = TICK,
    sensing: Sensing | None = None,
    massive: bool = False,
    step: float = STEP,
) -> MujocoTable:
    """As ``feedback_world``: the object's frame at ``start`` (m, rad) in the hand frame, the fingers open and straight.

    Raises NotCoveredError for what this world does not have.
    """
    scene = scene_of(case, massive, step)
    slider, hand = scene.slider, case.hand
    model = mujoco.MjModel.from_xml_string(scene.xml())
    data = mujoco.MjData(model)
    x, y, theta = (float(each) for each in moved_poses(slider.centre, np.array([start]), 1.0)[0])
    servos = servos_of(scene, model, data)
    straight = (hand.open, *(0.0 for _ in hand.finger_links[1:]))
    servos.place((straight, straight))
    data.qpos[-4:] = x, y, 0.0, theta
    body = slider_body(slider, case.contact.friction + CONE_SLACK)
    carriage = Carriage(hand, body, bench(0), coarse_scale(scene, body), (x, y, theta))
    faults = Sensing(case.sensors.displacement) if sensing is None else sensing
    bits = bits_of(hand, case.sensors.stretches(hand), faults)
    world = MujocoTable(scene, model, data, servos, carriage, travel_of(hand), bits, tick)
    world.firing = (False,) * len(bits.rows)
    world.invalid = carriage.overlaps(world.servos.angles)
    if not world.invalid:
        world.feel(0.0)
    return world


def coarse_scale(scene: Scene, body: Body) -> Scale:
    """The planar world's small lengths, but for the gap that counts as a touch and the depth that contacts may have."""
    near = NEAR * scene.case.hand.finger_length
    fine = scale_of(scene.case.hand.finger_length, body, TOLERANCE)
    return fine._replace(touch=near / PLANAR_NEAR, cut=0.1 * body.width, deep=0.1 * body.width)


def scene_of(case: Case, massive: bool, step: float) -> Scene:
    """The scene of a case on a table; raises NotCoveredError for what it does not have."""
    refuse_uncovered(case)
    count = len(case.hand.finger_links)
    if count > MOST_LINKS:
        raise NotCoveredError(f"a simulated finger has at most {MOST_LINKS} links, not {count}")
    if case.support.wall is not None:
        raise NotCoveredError("support.wall_mm: the world mujoco has no wall")
    if massive:
        raise NotCoveredError("the world mujoco has no objects that stay where they are touched: --no-massive")
    scene = Scene(case, slider_of(case.object, case.support), step)
    corners = scene.slider.core
    if len(corners) > MOST_CORNERS:
        raise NotCoveredError(f"the world mujoco has polygons of up to {MOST_CORNERS} corners, not {len(corners)}")
    if len(corners) > 1 and slider_body(scene.slider, 0.0).width < THINNEST * scene.rounding:
        raise NotCoveredError("the world mujoco has no polygons thinner than a tenth of their reach")
    return scene
