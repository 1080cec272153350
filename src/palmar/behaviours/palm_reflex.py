"""The palm reflex (sections 4.3 and 7.3): close as soon as the palm feels the object, or a set time after that."""

from __future__ import annotations

from dataclasses import dataclass, replace

from palmar.behaviours.reflex import INSTANT, Advance, Drive
from palmar.behaviours.sensor_places import SensorPlaces
from palmar.models.motion import Command, Observation


@dataclass(frozen=True)
class Waiting:
    """When it began, and when the palm first felt something (s)."""

    began: float
    felt: float | None = None


@dataclass(frozen=True)
class PalmReflex:
    """Waits for ``patience`` (s) at most, advancing if there is a ``move``; closes ``delay`` (s) after the palm's bit.

    Without the bit it does not close: it ends.
    """

    drive: Drive
    places: SensorPlaces
    move: Advance | None = None
    patience: float = 10.0
    delay: float = 0.0

    def begin(self, seen: Observation) -> Waiting:
        """Waiting."""
        return Waiting(seen.time)

    def step(self, state: Waiting, seen: Observation) -> tuple[Waiting, Command]:
        """Wait, count the delay, close."""
        if state.felt is None and self.places.palm_feels(seen):
            state = replace(state, felt=seen.time)
        if state.felt is None:
            return state, self._wait(state, seen)
        left = state.felt + self.delay - seen.time
        if left > INSTANT:
            return state, self.drive.rest("the palm feels it: wait for the delay", longest=left)
        return state, self.drive.close_to_the_end(seen, "the palm feels it: close")

    def _wait(self, state: Waiting, seen: Observation) -> Command:
        limit = self.patience if self.move is None else self.move.duration
        left = state.began + limit - seen.time
        if left <= INSTANT:
            return self.drive.end("the palm has felt nothing")
        if self.move is None:
            return self.drive.rest("wait for the palm's bit", longest=left)
        return self.drive.rest("advance until the palm feels something", self.move.velocity, left)
