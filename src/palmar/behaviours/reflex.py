"""A reflex: a program of a few lines that turns what the hand feels into what it does next.

It is a value with parameters. All it remembers is the state that ``step`` is given and gives back, so that the same
observations lead to the same commands, in a simulated world, on a hand, or read from a recording.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin
from typing import Protocol, TypeVar

from palmar.models.motion import Command, Observation

State = TypeVar("State")
INSTANT = 1e-9
"""A motion with no more than this (s) left is over."""


class Reflex(Protocol[State]):
    """What the runtime needs of a behaviour."""

    def begin(self, seen: Observation) -> State:
        """The state before the first step."""
        ...

    def step(self, state: State, seen: Observation) -> tuple[State, Command]:
        """The next state, and the command until the next observation."""
        ...


@dataclass(frozen=True)
class Drive:
    """Both fingers as a reflex moves them: joints of each, and the rate (rad/s) at which a joint turns."""

    joints: int
    rate: float

    def close(self, why: str, velocity: tuple[float, float] = (0.0, 0.0), longest: float | None = None) -> Command:
        """Base joints close, the others stay."""
        rates = (self.rate, *self.still[1:])
        return Command(rates, rates, velocity, longest, False, why)

    def rest(self, why: str, velocity: tuple[float, float] = (0.0, 0.0), longest: float | None = None) -> Command:
        """No joint moves; the arm may."""
        return Command(self.still, self.still, velocity, longest, False, why)

    def end(self, why: str) -> Command:
        """The behaviour is over."""
        return Command(self.still, self.still, stop=True, why=why)

    def close_to_the_end(
        self, seen: Observation, why: str, velocity: tuple[float, float] = (0.0, 0.0), longest: float | None = None
    ) -> Command:
        """Close until both fingers are held up, then end."""
        if all(seen.stalled):
            return self.end("both fingers are held up")
        return self.close(why, velocity, longest)

    @property
    def still(self) -> tuple[float, ...]:
        """No rate at any joint of a finger."""
        return (0.0,) * self.joints


@dataclass(frozen=True)
class Advance:
    """A straight move of the arm over ``distance`` (m) at ``speed`` (m/s), ``direction`` (rad) from the palm line.

    It is a move of a given time, the source's T: an arm that is held up does not make it longer.
    """

    distance: float
    speed: float
    direction: float

    @property
    def duration(self) -> float:
        """T (s)."""
        return self.distance / self.speed

    @property
    def velocity(self) -> tuple[float, float]:
        """(m/s); straight along an axis without a rest of rounding along the other."""
        x, y = (each if abs(each) > 1e-15 else 0.0 for each in (cos(self.direction), sin(self.direction)))
        return self.speed * x, self.speed * y
