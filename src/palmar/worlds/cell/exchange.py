"""One request of the arm and its reply, by the wall clock: what comes later than the deadline has not come."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf

from palmar.worlds.cell.alter_mode import DEADLINE
from palmar.worlds.cell.wire import Reply


@dataclass(frozen=True)
class Answer:
    """``reply``: None, it did not come in time; ``delay`` (s) after the request, infinite if it never came."""

    delay: float
    reply: Reply | None


@dataclass
class Exchange:
    """The number of the latest request, and when (s) it was made, None if it is settled; replies to earlier ones."""

    number: int = 0
    asked_s: float | None = None
    outdated: int = 0

    def ask(self, now_s: float) -> int:
        """A new request: its number."""
        self.number, self.asked_s = self.number + 1, now_s
        return self.number

    def settle(self, arrived: Iterable[tuple[float, Reply]], now_s: float) -> Answer | None:
        """With replies and when (s) they arrived: what came of the request, None while it may still be answered."""
        for arrived_s, reply in arrived:
            if self.asked_s is None or reply.number != self.number:
                self.outdated += 1
                continue
            delay, self.asked_s = arrived_s - self.asked_s, None
            return Answer(delay, reply if delay <= DEADLINE else None)
        if self.asked_s is None or now_s - self.asked_s <= DEADLINE:
            return None
        self.asked_s = None
        return Answer(inf, None)
