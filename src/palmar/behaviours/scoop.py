"""Scoop: forward with open fingers until the palm feels the object or the way is over, then close whatever was felt."""

from __future__ import annotations

from dataclasses import dataclass, replace

from palmar.behaviours.reflex import INSTANT, Advance, Drive
from palmar.behaviours.sensor_places import SensorPlaces
from palmar.models.motion import Command, Observation


@dataclass(frozen=True)
class Scooping:
    """When it began (s), and why it closes, once it does."""

    began: float
    closes: str | None = None


@dataclass(frozen=True)
class Scoop:
    """A reflex on the palm's bit, with the distance as a second way to end the advance."""

    drive: Drive
    move: Advance
    places: SensorPlaces

    def begin(self, seen: Observation) -> Scooping:
        """Open, on the way."""
        return Scooping(seen.time)

    def step(self, state: Scooping, seen: Observation) -> tuple[Scooping, Command]:
        """Advance until the palm feels something or the time is over, then close."""
        left = state.began + self.move.duration - seen.time
        if state.closes is None and self.places.palm_feels(seen):
            state = replace(state, closes="the palm feels it: close")
        elif state.closes is None and left <= INSTANT:
            state = replace(state, closes="the way is over: close")
        if state.closes is None:
            return state, self.drive.rest("advance with open fingers", self.move.velocity, left)
        return state, self.drive.close_to_the_end(seen, state.closes)
