"""What a hand learns from its tendons: the torques that contacts put on the joints, through noise.

Tensions are measured, R T are the joint torques; what they do beyond moving the finger and carrying its weight is what
something else does. With the momentum p = I q' of a joint, r = K (p - integral of (R T - weight + r)) follows that torque
with a first-order lag 1/K, without accelerations.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from palmar.models.salisbury_hand import SalisburyHand

Floats = NDArray[np.float64]
GAIN = 60.0
"""K (1/s)."""
LEAST_THRESHOLD, SIGMAS = 0.05, 5.0
"""A touch: torque (N m) on joint 2 above the larger of this and so many standard deviations of its noise."""
MEAN_TIME, SLACK = 0.05, 0.5
"""Readings are averaged over so long (s); a tendon whose average is below this share of the pretension is dead.

For that the average is taken over longer where noise would reach so far in SIGMAS standard deviations.
"""


@dataclass
class FingerSense:
    """Of three fingers, at ticks of ``tick`` (s); ``noise`` (N) is the known standard deviation of each reading."""

    hand: SalisburyHand
    tick: float
    noise: float
    sum: Floats = field(default_factory=lambda: np.zeros((3, 3)))
    torque: Floats = field(default_factory=lambda: np.zeros((3, 3)))
    mean: Floats = field(init=False)
    slow_mean: Floats = field(init=False)
    slack_time: float = field(init=False)
    threshold: float = field(init=False)
    """Of a touch (N m)."""

    def __post_init__(self) -> None:
        self.inertia = np.array(self.hand.joint_inertias) + np.array([1e-4, 3e-4, 4e-5])
        self.law = self.hand.tendon_matrix.T.copy()
        self.mean = np.full((3, 4), self.hand.tension_least)
        self.slow_mean = self.mean.copy()
        reach = SIGMAS * self.noise / ((1.0 - SLACK) * self.hand.tension_least)
        self.slack_time = max(MEAN_TIME, 0.5 * self.tick * reach**2)
        spread = self.noise * float(np.linalg.norm(self.hand.tendon_matrix[1])) * (0.5 * GAIN * self.tick) ** 0.5
        self.threshold = max(LEAST_THRESHOLD, SIGMAS * spread)

    def feel(self, readings: Floats, rates: Floats, weight: Floats) -> None:
        """One tick: readings (3, 4) in N, joint rates (3, 3), torques (3, 3) in N m that carry the finger's weight."""
        self.sum += self.tick * (readings @ self.law - weight + self.torque)
        self.torque = GAIN * (self.inertia * rates - self.sum)
        self.mean += self.tick / MEAN_TIME * (readings - self.mean)
        self.slow_mean += self.tick / self.slack_time * (readings - self.slow_mean)

    @property
    def press(self) -> tuple[float, float, float]:
        """How hard (N m) each finger is pushed outward at joint 2."""
        one, two, three = (-self.torque[:, 1]).tolist()
        return one, two, three

    @property
    def touched(self) -> tuple[bool, bool, bool]:
        """Which fingers feel something, in any direction of their plane."""
        one, two, three = (max(abs(middle), abs(outer)) > self.threshold for _, middle, outer in self.torque.tolist())
        return one, two, three

    @property
    def dead(self) -> bool:
        """Whether a tendon reads slack."""
        return bool(self.slow_mean.min() < SLACK * self.hand.tension_least)
