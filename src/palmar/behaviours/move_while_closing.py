"""Move While Closing Fingers (section 3.3.3): go on straight while the fingers close, at first with open fingers if wanted.

The hand scoops: what squeezes away from the fingers is met by the palm. With a first stretch it is the source's
combination of both motions, for objects that rest against nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

from palmar.behaviours.reflex import INSTANT, Advance, Drive
from palmar.models.motion import Command, Observation


@dataclass(frozen=True)
class MoveWhileClosing:
    """``first`` (m): the part of the move with open fingers. The state is the time (s) at which it began."""

    drive: Drive
    move: Advance
    first: float = 0.0

    def begin(self, seen: Observation) -> float:
        """Now."""
        return seen.time

    def step(self, state: float, seen: Observation) -> tuple[float, Command]:
        """Advance open, advance while closing, then only close."""
        spent = seen.time - state
        opened = self.first / self.move.speed - spent
        left = self.move.duration - spent
        if opened > INSTANT:
            return state, self.drive.rest("advance with open fingers", self.move.velocity, opened)
        if left > INSTANT:
            return state, self.drive.close("close on the move", self.move.velocity, left)
        return state, self.drive.close_to_the_end(seen, "the move is over: close")
