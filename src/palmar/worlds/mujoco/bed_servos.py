"""The motors of the source's test bed (section 6.1): a digital servo for each joint, limited in its duty cycle.

At every sample a joint's angle is known in whole encoder counts, and a PID law of its distance from a set point gives the
duty cycle of the motor's voltage, up to a limit. The torque is that share of the stall torque, less what the turning costs
(back-EMF: none is left at the no-load rate). A contact is what takes much duty: a joint touches while its commanded duty
has been over a threshold for some time.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import tau

import numpy as np
from numpy.typing import NDArray

from palmar.errors import NotCoveredError
from palmar.models.bed import Bed
from palmar.worlds.mujoco.servos import UNLIMITED, Both, Servos

Floats = NDArray[np.float64]
NO_TIME = 1e-9
"""Less than this (s) is none."""


@dataclass(frozen=True)
class Move:
    """One joint's motion command: to an angle (rad), in so long (s), with so much duty at most."""

    final: float
    duration: float
    duty: float


@dataclass
class BedServos(Servos):
    """Of a scene's model and data; one motor a joint, right joints, left joints; the wrist is fixed."""

    bed: Bed = field(default_factory=Bed)
    set_points: Floats = field(init=False)
    duty: Floats = field(init=False)
    most_duty: Floats = field(init=False)
    loaded: Floats = field(init=False)
    errors: Floats = field(init=False)
    sums: Floats = field(init=False)
    ends: Floats = field(init=False)
    due: float = 0.0
    clock: float = 0.0

    def __post_init__(self) -> None:
        number = 2 * self.joints
        self.told = np.zeros(number + 2)
        self.duty, self.loaded, self.errors, self.sums = (np.zeros(number) for _ in range(4))
        self.set_points, self.most_duty = np.zeros(number), np.full(number, self.bed.duty_limit)
        self.ends = np.full(number, np.nan)
        turning = slice(2, 2 + number)
        self.model.jnt_actfrcrange[turning] = -UNLIMITED, UNLIMITED
        self.model.jnt_range[turning] = -UNLIMITED, UNLIMITED
        self.model.dof_damping[turning] = self.bed.stall_torque / self.bed.no_load_rate

    def place(self, angles: Both) -> None:
        """Put the joints at these angles, at rest."""
        self.set_points[:] = [*angles[0], *angles[1]]
        self.data.qpos[2 : 2 + 2 * self.joints] = self.set_points

    def tell(self, rates: Both, velocity: tuple[float, float]) -> None:
        """Let the set points move so from now on; where they have been told to stop they stay."""
        if velocity != (0.0, 0.0):
            raise NotCoveredError("the test bed's wrist is fixed to its table: its arm cannot move")
        self.told = np.array((*rates[0], *rates[1], 0.0, 0.0))
        self.ends[:] = np.nan
        self.most_duty[:] = self.bed.duty_limit

    def move(self, moves: tuple[tuple[Move, ...], tuple[Move, ...]]) -> None:
        """Motion commands for the joints of the right and the left finger, as the bed takes them."""
        flat = [*moves[0], *moves[1]]
        rates = [(each.final - now) / each.duration for each, now in zip(flat, self.set_points, strict=True)]
        self.tell((tuple(rates[: self.joints]), tuple(rates[self.joints :])), (0.0, 0.0))
        self.ends[:] = [each.final for each in flat]
        self.most_duty[:] = [min(each.duty, self.bed.duty_limit) for each in flat]

    def halt_arm(self) -> None:
        """The wrist is fixed."""

    def go(self, seconds: float, step: float) -> None:
        """Let the scene go on."""
        end = self.clock + seconds
        while self.clock < end - NO_TIME:
            if self.clock >= self.due - NO_TIME:
                self._sample()
                self.due += self.bed.sample
            span = min(self.due, end) - self.clock
            self.advance(span, step)
            self.clock += span

    def contact(self, side: int) -> bool:
        """Whether a joint of the finger has taken the threshold's duty for long enough."""
        return bool((self.loaded[side * self.joints : (side + 1) * self.joints] >= self.bed.dwell).any())

    def _sample(self) -> None:
        bed, number = self.bed, 2 * self.joints
        self.set_points += bed.sample * self.told[:number]
        past = (self.set_points - self.ends) * np.sign(self.told[:number]) > 0.0
        self.set_points = np.where(past, self.ends, self.set_points)
        count = tau / bed.counts
        errors = self.set_points - count * np.round(self.data.qpos[2 : 2 + number] / count)
        law = bed.proportional * errors + bed.derivative * (errors - self.errors) / bed.sample
        most = self.most_duty / bed.integral if bed.integral > 0.0 else 0.0
        self.sums = np.clip(self.sums + bed.sample * errors, -most, most)
        self.duty = np.clip(law + bed.integral * self.sums, -self.most_duty, self.most_duty)
        self.errors = errors
        over = np.abs(self.duty) >= np.minimum(bed.threshold, self.most_duty)
        self.loaded = np.where(over, self.loaded + bed.sample, 0.0)
        self.data.ctrl[:number] = bed.stall_torque * self.duty


def bed_servos(servos: Servos, bed: Bed) -> BedServos:
    """The bed's motors in place of others on the same model and data."""
    return BedServos(
        servos.model,
        servos.data,
        servos.joints,
        bed.stall_torque,
        0.0,
        servos.at_once,
        servos.friction,
        servos.flight,
        bed,
    )
