"""The world of a free disk and soft contacts: impacts take time and have a force, motors a limit and a lag.

Physics is that of ``mechanics.impact.soft_4_3_2``. The fingers are kept straight and pass each other, the arm stands still.
A finger that hardly turns though told to, or is at the end of its travel, is held up.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, nan, pi

import numpy as np
from numpy.typing import NDArray

from palmar.errors import NotCoveredError
from palmar.geometry.straight_finger import last_angle
from palmar.mechanics.impact.collision import rod_inertia
from palmar.mechanics.impact.impact_force_4_3_2 import damping_ratio_for
from palmar.mechanics.impact.soft_4_3_2 import (
    ANGLE,
    FELT_WIDTH,
    FORCE,
    MOMENT,
    PEAK,
    RATE,
    STATE_WIDTH,
    THETA,
    VX,
    VY,
    SoftHand,
    X,
    Y,
    advance,
    steps_for,
)
from palmar.models.case import Case
from palmar.models.hand import Fingers
from palmar.models.motion import Command, Observation
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.models.support import SupportKind
from palmar.worlds.planar.bits import Bits, Sensing, bits_of
from palmar.worlds.planar.carriage import Touch
from palmar.worlds.planar.enclosure import Enclosure, enclosure_of
from palmar.worlds.planar.feedback import NO_TIME, TICK
from palmar.worlds.planar.finger_pair import SIDES, Both

STALL_TURN, STALL_SHARE = 0.1, 0.1
"""A finger is held up if it has turned on by less than this share of so much (rad) that it was told to turn, and
by what its motor needs to turn it back from an impact."""
MOST_DAMPED = 5.0
"""Largest damping ratio of a contact: restitution 0.01; less than that is not told from it."""
AT_END = 1e-9
OVERLAP = 1e-9
"""Of the radius: a start that overlaps the hand by less only touches it."""


@dataclass
class SoftWorld:
    """Made by ``soft_world``; ``owed``: how much (rad) each finger was told to turn since it was at ``from_angle``."""

    hand: SoftHand
    enclosure: Enclosure
    links: tuple[float, ...]
    bits: Bits
    tick: float
    state: NDArray[np.float64]
    invalid: bool = False
    time: float = 0.0
    told: NDArray[np.float64] = field(default_factory=lambda: np.array([0.0, 0.0, nan, nan]))
    felt: NDArray[np.float64] = field(default_factory=lambda: np.zeros(FELT_WIDTH))
    held: list[bool] = field(default_factory=lambda: [False, False])
    owed: list[float] = field(default_factory=lambda: [0.0, 0.0])
    from_angle: list[float] = field(default_factory=lambda: [0.0, 0.0])
    still: bool = False
    touched: bool = False
    firing: tuple[bool, ...] = ()
    scratch: tuple[NDArray[np.float64], NDArray[np.float64]] = field(
        default_factory=lambda: (np.zeros(STATE_WIDTH), np.zeros(STATE_WIDTH))
    )

    @property
    def settled(self) -> bool:
        """Whether nothing moves under the last command, or the world cannot go on."""
        return self.still or self.broken

    @property
    def broken(self) -> bool:
        """Whether the start was invalid or the motion has no bounds any more."""
        return self.invalid or not bool(np.isfinite(self.state).all())

    @property
    def ambiguous(self) -> bool:
        """Soft contacts have one way to go."""
        return False

    @property
    def angles(self) -> Both:
        """Of all joints (rad), right and left."""
        straight = (0.0,) * (len(self.links) - 1)
        return (float(self.state[ANGLE]), *straight), (float(self.state[ANGLE + 1]), *straight)

    @property
    def pose(self) -> tuple[float, float, float]:
        """Of the disk: x, y (m), theta (rad) in the hand frame."""
        return float(self.state[X]), float(self.state[Y]), float(self.state[THETA])

    def observe(self) -> Observation:
        """What the hand feels and knows of itself now."""
        (right, left), felt = self.angles, self.felt
        forces, moments = (
            (float(felt[PEAK]), float(felt[PEAK + 1])),
            (-float(felt[MOMENT]), -float(felt[MOMENT + 1])),
        )
        return Observation(
            self.time, right, left, self.firing, (self.held[0], self.held[1]), forces=forces, moments=moments
        )

    def act(self, command: Command, seconds: float) -> float:
        """Let a command hold for so long, or as long as it allows; returns the seconds it held."""
        self._listen(command)
        span = seconds if command.longest is None else min(seconds, command.longest)
        self.felt[PEAK:] = 0.0
        if span > NO_TIME:
            self._go(span)
        self.touched = self.touched or bool((self.felt[PEAK:] > 0.0).any())
        self.time += span
        self.firing = self.bits.read(self._touches(), self.pose[:2], span, False)
        return span

    def outcome(self) -> Outcome:
        """What has become of the disk, were this the end."""
        if self.broken:
            return Outcome.INVALID if self.invalid else Outcome.UNDECIDED
        if self.enclosure.shut(self.angles, *self.pose[:2]):
            return Outcome.CAGED
        return Outcome.ESCAPED if self.touched else Outcome.MISSED

    def _listen(self, command: Command) -> None:
        if command.velocity != (0.0, 0.0):
            raise NotCoveredError("the world soft has a hand that stands still: its arm cannot move")
        told = np.array(
            [command.right[0], command.left[0], *(nan if each is None else each for each in command.torques)]
        )
        if any((*command.right[1:], *command.left[1:])):
            raise NotCoveredError("the world soft has straight fingers: distal joints cannot turn")
        for side in SIDES:
            if not np.array_equal(told[side::2], self.told[side::2], equal_nan=True):
                self.held[side], self.owed[side] = False, 0.0
        self.told = told

    def _go(self, span: float) -> None:
        for side in SIDES:
            if self.owed[side] == 0.0:
                self.from_angle[side] = float(self.state[ANGLE + side])
        middle, change = self.scratch
        advance(self.hand, self.state, self.told, self.felt, span, steps_for(self.hand, span), middle, change)
        for side in SIDES:
            self._notice_stall(side, span)
        self.still = not self.state[[VX, VY, RATE, RATE + 1]].any()

    def _notice_stall(self, side: int, span: float) -> None:
        angle, rate, torque = float(self.state[ANGLE + side]), self.told[side], self.told[2 + side]
        closes = rate > 0.0 if np.isnan(torque) else torque > 0.0
        if np.isnan(torque):
            self.owed[side] += span * abs(float(rate))
        if closes and angle >= self.hand.highest - AT_END:
            self.held[side] = True
        elif self.owed[side] >= STALL_TURN + 2.0 * float(rate) ** 2 * self.hand.inertia / self.hand.limit:
            turned = float(np.sign(rate)) * (angle - self.from_angle[side])
            self.held[side], self.owed[side] = turned < STALL_SHARE * self.owed[side], 0.0

    def _touches(self) -> list[Touch]:
        """Where the disk has been felt since the last observation, as it lies now: on the links' rows."""
        found, (x, y, _), hand = [], self.pose, self.hand
        if self.felt[PEAK + 2] > 0.0:
            found.append(Touch(0, min(max(x + hand.half_palm, 0.0), 2.0 * hand.half_palm)))
        for side in SIDES:
            if self.felt[PEAK + side] > 0.0:
                angle, px = self.state[ANGLE + side], (x if side == 0 else -x) - hand.half_palm
                along = min(max(px * np.cos(angle) + y * np.sin(angle), 0.0), hand.length)
                found.append(self._on_link(side, float(along)))
        return found

    def _on_link(self, side: int, along: float) -> Touch:
        row = 1 + side * len(self.links)
        for length in self.links[:-1]:
            if along <= length:
                return Touch(row, along)
            along, row = along - length, row + 1
        return Touch(row, along)


def soft_world(
    case: Case,
    start: tuple[float, float, float],
    *,
    tick: float = TICK,
    sensing: Sensing | None = None,
    massive: bool = False,
) -> SoftWorld:
    """The world of a case, its disk at ``start`` (m, rad) in the hand frame at the case's start velocity.

    Raises NotCoveredError for what this world does not have.
    """
    hand = soft_hand_of(case)
    faults = Sensing(case.sensors.displacement) if sensing is None else sensing
    if massive or faults.displacement > 0.0:
        raise NotCoveredError(
            "the world soft has no objects that stay where they are touched, and feels touches at once"
        )
    state = np.zeros(STATE_WIDTH)
    state[[X, Y, THETA]], state[[VX, VY]] = start, case.start.velocity
    state[ANGLE : ANGLE + 2] = case.hand.open
    bits = bits_of(case.hand, case.sensors.stretches(case.hand), faults)
    world = SoftWorld(hand, enclosure_of(case), case.hand.finger_links, bits, tick, state)
    at_rest = state.copy()
    at_rest[[VX, VY]] = 0.0
    advance(hand, at_rest, world.told, world.felt, 1e-12, 1, *world.scratch)
    deepest = OVERLAP * hand.radius * hand.stiffness
    world.invalid = bool((world.felt[FORCE : FORCE + 3] > deepest).any()) or start[1] < 0.0
    world.firing = (False,) * len(bits.rows)
    return world


def soft_hand_of(case: Case) -> SoftHand:
    """A case's hand, disk and contact; raises NotCoveredError for what soft contacts are not simulated with."""
    hand, disk, contact = case.hand, case.object, case.contact
    if case.support.kind is not SupportKind.FREE or not isinstance(disk, Disk) or case.support.wall is not None:
        raise NotCoveredError("the world soft is for free disks")
    if case.ranges:
        raise NotCoveredError("a simulation takes plain numbers, not ranges")
    if contact.stiffness is None:
        raise NotCoveredError("contact.stiffness_N_mm absent: the world soft needs it")
    if hand.fingers is Fingers.COLLIDING:
        raise NotCoveredError('hand.fingers = "colliding": the world soft has fingers that pass each other')
    if any(case.open_joints[1:]):
        raise NotCoveredError("behaviour.bend_deg: the world soft has straight fingers")
    if hand.finger_mass is None:
        raise NotCoveredError("hand.finger_mass_kg absent: the world soft needs it, heavy fingers crush what they hold")
    low, high = hand.base_limits
    return SoftHand(
        hand.half_palm, hand.finger_length, hand.half_thickness, low,
        float(last_angle(hand.half_palm, hand.finger_length, hand.half_thickness, True, min(high, pi))),
        rod_inertia(hand.finger_mass, hand.finger_length),
        inf if hand.finger_torque is None else hand.finger_torque, hand.drive_lag, disk.radius, disk.mass,
        contact.stiffness, min(float(damping_ratio_for(contact.restitution)), MOST_DAMPED), contact.friction,
    )  # fmt: skip
