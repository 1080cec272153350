"""Sightings as they arrive from the vision process: the newest, and counts of what was lost, late or malformed."""

from __future__ import annotations

from dataclasses import dataclass, field

from palmar.behaviours.cell.sightings import OLDEST
from palmar.models.cell_messages import Sighting
from palmar.worlds.cell.transport import Mailbox
from palmar.worlds.cell.wire import Frame, Sightings


@dataclass
class SightingBox:
    """An Eye (``palmar.models.cell_messages``) over a mailbox of frames."""

    box: Mailbox[Frame] = field(default_factory=lambda: Mailbox(Frame))
    latest: Sighting | None = None
    received: int = 0
    stale: int = 0
    first: int | None = None
    last: int = 0

    def look(self, now_s: float) -> Sighting | None:
        """The newest that has arrived by now."""
        for _, frame in self.box.take():
            self.received += 1
            self.first = frame.number if self.first is None else self.first
            self.last = max(self.last, frame.number)
            self.stale += now_s - frame.sighting.stamp_s > OLDEST
            if self.latest is None or frame.sighting.stamp_s > self.latest.stamp_s:
                self.latest = frame.sighting
        return self.latest

    @property
    def counts(self) -> Sightings:
        """So far."""
        span = 0 if self.first is None else self.last - self.first + 1
        return Sightings(
            received=self.received,
            stale=self.stale,
            dropped=max(0, span - self.received),
            malformed=self.box.malformed,
        )
