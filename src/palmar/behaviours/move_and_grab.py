"""Move and Grab (section 3.3.3): with open fingers forward for the time T at the speed V, then close.

An object that is not touched on the way is caught from wherever it would be caught, had it stood V T nearer.
"""

from __future__ import annotations

from dataclasses import dataclass

from palmar.behaviours.reflex import INSTANT, Advance, Drive
from palmar.models.motion import Command, Observation


@dataclass(frozen=True)
class MoveAndGrab:
    """The state is the time (s) at which it began."""

    drive: Drive
    move: Advance

    def begin(self, seen: Observation) -> float:
        """Now."""
        return seen.time

    def step(self, state: float, seen: Observation) -> tuple[float, Command]:
        """Advance for the time that is left, then close."""
        left = state + self.move.duration - seen.time
        if left > INSTANT:
            return state, self.drive.rest("advance with open fingers", self.move.velocity, left)
        return state, self.drive.close_to_the_end(seen, "the advance is over: close")
