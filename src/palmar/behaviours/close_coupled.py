"""Close both joints of each finger together, at a fixed ratio of their rates (section 5.3.1)."""

from __future__ import annotations

from dataclasses import dataclass

from palmar.behaviours.reflex import INSTANT, Drive
from palmar.models.motion import Command, Observation


@dataclass(frozen=True)
class CoupledClosing:
    """Fingers of two joints; ``ratio``: the distal joint's rate over the base joint's.

    ``most``: base angle (rad) at which the motion ends. Nothing is felt or remembered.
    """

    drive: Drive
    ratio: float
    most: float

    def begin(self, seen: Observation) -> None:
        """Nothing."""

    def step(self, state: None, seen: Observation) -> tuple[None, Command]:
        """Close, or end."""
        left = max(0.0 if stalled else self.most - joints[0] for joints, stalled in zip(
            (seen.right, seen.left), seen.stalled, strict=True))  # fmt: skip
        if left <= INSTANT * self.drive.rate:
            return state, self.drive.end("both fingers are held up or at their ends")
        rates = self.drive.rate, self.ratio * self.drive.rate
        return state, Command(rates, rates, longest=left / self.drive.rate, why="close both joints")
