"""Curl first, then close (sections 5.2.2 and 5.3.1): the distal joints move, and after them the base joints."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from palmar.behaviours.reflex import INSTANT, Drive
from palmar.models.motion import Command, Observation

DISTAL = 1


class Phase(Enum):
    """What the hand does."""

    CURL = "curl to the preshape angle"
    CLOSE = "close the base joints"


@dataclass(frozen=True)
class CurlAndClose:
    """Fingers of two joints; ``preshape`` (rad) is the distal angle to curl to."""

    drive: Drive
    preshape: float

    def begin(self, seen: Observation) -> Phase:
        """Curl."""
        return Phase.CURL

    def step(self, state: Phase, seen: Observation) -> tuple[Phase, Command]:
        """Curl each finger that is not there and not held up; then close, or end."""
        left = [
            (self.preshape - joints[DISTAL]) / self.drive.rate if not stalled else 0.0
            for joints, stalled in zip((seen.right, seen.left), seen.stalled, strict=True)
        ]
        if state is Phase.CLOSE or max(left) <= INSTANT:
            if state is Phase.CURL:
                return Phase.CLOSE, self.drive.close(Phase.CLOSE.value)
            return Phase.CLOSE, self.drive.close_to_the_end(seen, Phase.CLOSE.value)
        right, other = ((0.0, self.drive.rate if each > INSTANT else 0.0) for each in left)
        longest = min(each for each in left if each > INSTANT)
        return Phase.CURL, Command(right, other, longest=longest, why=Phase.CURL.value)
