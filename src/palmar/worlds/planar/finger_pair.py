"""Two fingers under commands: their angles, what they are told, and what holds them up."""

from __future__ import annotations

from dataclasses import dataclass, field

from palmar.models.motion import Command, Joints
from palmar.worlds.planar.finger_travel import FingerTravel

SIDES = (0, 1)
Both = tuple[Joints, Joints]


@dataclass
class FingerPair:
    """``told``: the joint rates of the last command, right and left; ``held``: fingers that are held up by anything,
    ``gripped``: by the object.
    """

    travel: FingerTravel
    angles: Both
    told: Both = ((), ())
    held: list[bool] = field(default_factory=lambda: [False, False])
    gripped: list[bool] = field(default_factory=lambda: [False, False])

    def listen(self, command: Command) -> None:
        """A finger that is told something else is free again."""
        told = command.right, command.left
        if any(len(each) != len(self.travel.links) for each in told):
            raise ValueError(f"a command needs a rate for each of a finger's {len(self.travel.links)} joints")
        for side in SIDES:
            if told[side] != self.told[side]:
                self.held[side] = False
                self.gripped[side] = self.gripped[side] and not any(told[side])
        self.told = told

    def rates(self, side: int) -> Joints:
        """The rates of a finger that is told to move, without what is held up; notes if that is all of it."""
        told = self.told[side]
        rates = self.travel.allowed(self.angles[side], told)
        self.held[side] = any(told) and (self.held[side] or not any(rates))
        return tuple(0.0 for _ in told) if self.held[side] else rates

    def turn(self, rates: Both, seconds: tuple[float, float]) -> None:
        """Let each finger go on at its rates for its time (s)."""
        right, left = (
            tuple(angle + rate * seconds[k] for angle, rate in zip(self.angles[k], rates[k], strict=True))
            for k in SIDES
        )
        self.angles = right, left
