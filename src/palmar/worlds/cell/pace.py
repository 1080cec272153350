"""A loop kept to the wall clock, and how late each of its ticks began."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic, sleep

SLIP = 0.005
"""A tick that is later than this (s) is not made good: the plan is put off, lest requests and replies crowd."""


@dataclass
class Pace:
    """The next tick of ``tick`` s is due at ``due`` (s); ``late``: of every tick so far; ``slipped``: time put off (s)."""

    tick: float
    due: float
    clock: Callable[[], float] = monotonic
    pause: Callable[[float], None] = sleep
    late: list[float] = field(default_factory=list)
    slipped: float = 0.0

    def wait(self) -> float:
        """Until the next tick; the time (s) at which it begins."""
        left = self.due - self.clock()
        if left > 0.0:
            self.pause(left)
        now = self.clock()
        late = now - self.due
        self.late.append(late)
        if late > SLIP:
            self.slipped += late
            self.due = now
        self.due += self.tick
        return now
