"""Close (section 3.3.1): both base joints close at one rate until the fingers are held up; the hand stands still."""

from __future__ import annotations

from dataclasses import dataclass

from palmar.behaviours.reflex import Drive
from palmar.models.motion import Command, Observation


@dataclass(frozen=True)
class Closing:
    """Nothing is felt or remembered."""

    drive: Drive

    def begin(self, seen: Observation) -> None:
        """Nothing."""

    def step(self, state: None, seen: Observation) -> tuple[None, Command]:
        """Close, or end."""
        return state, self.drive.close_to_the_end(seen, "close")
