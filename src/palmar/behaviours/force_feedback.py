"""Naive force feedback (section 4.3.2): close to the touch, then ask the motor for more than the grip wanted, or less.

The motor is asked for M0 + g (M0 - M), M being the moment of the contact about the base joint and M0 the one wanted. A
drive that lags behind makes that unstable beyond the gain of ``force_feedback_4_3_2``, and without damping at any
gain: then the fingers hammer. It is here to be seen, and measured, not to be used.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

from palmar.behaviours.reflex import Drive
from palmar.models.motion import Command, Observation

TOUCH = 1e-3
"""Force (N) that is felt as a touch."""


@dataclass(frozen=True)
class Pressing:
    """Which fingers (right, left) have touched, and since when (s) one has."""

    touched: tuple[bool, bool] = (False, False)
    since: float = inf


@dataclass(frozen=True)
class ForceFeedback:
    """``grip``: moment wanted (N m); force ``gain``; ``patience`` (s) after which the grip is to be judged."""

    drive: Drive
    grip: float
    gain: float
    patience: float

    def begin(self, seen: Observation) -> Pressing:
        """Nothing is touched."""
        return Pressing()

    def step(self, state: Pressing, seen: Observation) -> tuple[Pressing, Command]:
        """Close to the touch, then feed the moment back."""
        if seen.forces is None or seen.moments is None:
            return state, self.drive.end("no sensor tells the force on a finger")
        right, left = (
            before or force > TOUCH for before, force in zip(state.touched, seen.forces, strict=True)
        )  # fmt: skip
        since = seen.time if (right or left) and state.since == inf else state.since
        state = Pressing((right, left), since)
        if seen.time - since >= self.patience:
            return state, self.drive.end("the time to grip is over")
        if all(seen.stalled):
            return state, self.drive.end("both fingers are held up")
        asked = [self.grip + self.gain * (self.grip - each) for each in seen.moments]
        torques = (asked[0] if right else None, asked[1] if left else None)
        why = "feed the moment back" if right or left else "close to the touch"
        return state, replace(self.drive.close(why), torques=torques)
