"""Soft touch-down (section 4.3.2, after Parker): fast to the object, slow when the finger touches it, then close on slowly.

The object stands still about where it is expected, within the behaviour's uncertainty. The rates are a programme known
beforehand (``touch_down_case``), nothing is felt; a finger that touches earlier, because the object is not where it was
expected to be, strikes at the rate of that moment. A disk that does not stand still is struck at its own speed and more.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from palmar.behaviours.reflex import INSTANT, Drive
from palmar.mechanics.impact.touch_down_4_3_2 import Row
from palmar.models.motion import Command, Observation


@dataclass(frozen=True)
class TouchDown:
    """``programme``: for how long (s) which rates (rad/s; right, left); the last is without an end."""

    drive: Drive
    programme: tuple[Row, ...]

    def begin(self, seen: Observation) -> float:
        """Since when (s) the programme runs."""
        return seen.time

    def step(self, state: float, seen: Observation) -> tuple[float, Command]:
        """The rates of the piece that the time is in."""
        if all(seen.stalled):
            return state, self.drive.end("both fingers are held up")
        gone = seen.time - state
        for duration, (right, left) in self.programme:
            gone -= duration
            if gone < -INSTANT:
                slow = duration == inf
                rest = self.drive.still[1:]
                return state, Command(
                    (right, *rest), (left, *rest), longest=None if slow else -gone,
                    why="close on at the rate of touch" if slow else "turn to the object",
                )  # fmt: skip
        return state, self.drive.end("the programme is over")
