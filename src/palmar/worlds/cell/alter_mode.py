"""The arm's link (section 7.1.2): every 28 ms its controller asks for a set-point and waits 15 ms for the reply.

Between two set-points it interpolates. A reply that is late interrupts the link: the arm holds its last set-point from then
on, the interruption is counted, and nothing moves it again until someone restarts the link.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
PERIOD, DEADLINE = 0.028, 0.015
"""Between requests, and for a reply (s)."""


@dataclass
class AlterMode:
    """Joint set-points ``now`` (6,) in rad on their way to ``goal``; how many requests were made and replies missed."""

    now: Floats
    goal: Floats = field(init=False)
    rate: Floats = field(init=False)
    until: float = 0.0
    due: float = 0.0
    waiting: Floats | None = None
    asked: int = 0
    missed: int = 0

    def __post_init__(self) -> None:
        self.goal, self.rate = self.now.copy(), np.zeros(6)

    @property
    def interrupted(self) -> bool:
        """Whether the link is down."""
        return self.missed > 0

    def reply(self, request: float, delay: float, joints: Floats | None) -> None:
        """To the request made at a time (s): set-point (6,), None if it never comes, ``delay`` (s) after the request."""
        self.asked += 1
        if joints is None or delay > DEADLINE:
            self.missed += 1
        self.waiting, self.due = joints, request + min(delay, DEADLINE)

    def hold(self) -> None:
        """Stay where it is now, for good: nobody is to reply any more."""
        self.goal, self.rate, self.waiting = self.now.copy(), np.zeros(6), None
        self.until, self.due = 0.0, np.inf

    def advance(self, time: float, tick: float) -> tuple[Floats, Floats]:
        """Set-points (6,) in rad and their rates at a time (s), one tick (s) on."""
        if time >= self.due - 1e-9 and (self.waiting is not None or self.interrupted):
            self.goal = self.now if self.interrupted or self.waiting is None else self.waiting
            self.rate, self.until, self.waiting = (self.goal - self.now) / PERIOD, time + PERIOD, None
            if self.interrupted:
                self.due = np.inf
        if time >= self.until - 1e-9:
            self.now = self.goal
            return self.now, np.zeros(6)
        self.now = self.now + self.rate * tick
        return self.now, self.rate
