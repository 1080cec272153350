"""Force-triggered compliance (section 4.3.2): a finger that is struck too hard is let go for a while.

Nothing is fed back, so nothing becomes unstable: when the force on a finger has passed the trigger, its motor is off, after
a delay, and the finger gives way as the body that it is; then the motor closes it on. That happens once to each finger:
what it feels later is its grip. Its limits: a drive that is not backdrivable does not give way; what is already in
the contact as compression, and the finger's own inertia, are not taken away; and a finger that was let go is late.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

from palmar.behaviours.reflex import INSTANT, Drive
from palmar.models.motion import Command, Observation

NEVER = (inf, inf)


@dataclass(frozen=True)
class Struck:
    """Since when (s; right, left) the force has been over the trigger."""

    since: tuple[float, float] = NEVER


@dataclass(frozen=True)
class LettingGo:
    """``trigger`` (N); ``delay`` (s) until the motor is off, ``limp`` (s) until it is on again."""

    drive: Drive
    trigger: float
    delay: float
    limp: float

    def begin(self, seen: Observation) -> Struck:
        """Nothing has been felt."""
        return Struck()

    def step(self, state: Struck, seen: Observation) -> tuple[Struck, Command]:
        """Close, but for fingers that are let go."""
        if seen.forces is None:
            return state, self.drive.end("no sensor tells the force on a finger")
        right, left = (
            seen.time if since == inf and force > self.trigger else since
            for since, force in zip(state.since, seen.forces, strict=True)
        )
        state = replace(state, since=(right, left))
        changes = [each for since in state.since for each in (since + self.delay, since + self.delay + self.limp)]
        ahead = [each - seen.time for each in changes if seen.time + INSTANT < each < inf]
        limp = [self._is_limp(since, seen.time) for since in state.since]
        if all(seen.stalled) and not any(limp):
            return state, self.drive.end("both fingers are held up")
        closing = self.drive.close("let go of a finger" if any(limp) else "close", longest=min(ahead, default=None))
        torques = (0.0 if limp[0] else None, 0.0 if limp[1] else None)
        return state, replace(closing, torques=torques)

    def _is_limp(self, since: float, now: float) -> bool:
        return since + self.delay <= now + INSTANT and now + INSTANT < since + self.delay + self.limp
