"""Closing on a free disk: from a case and its starts to how each ends, what happened when, and the way of one start.

Times are given as for the table, as the base angle that a finger would have if it never stopped: psi = open + rate t.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.impact.capture import capture, capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of, impact_law_of
from palmar.mechanics.impact.capture_hand import divided
from palmar.mechanics.impact.capture_state import IMPACT, LANDS, LEAVES, PHASES, SHUTS
from palmar.mechanics.impact.collision import ImpactLaw
from palmar.mechanics.impact.contact_view import BASE, END
from palmar.mechanics.impact.finger_motion import CaptureHand
from palmar.mechanics.pushing.closing import Ends
from palmar.models.case import Case
from palmar.models.outcome import Outcome
from palmar.worlds.planar.events import Event
from palmar.worlds.planar.table import Trace

Floats = NDArray[np.float64]
MOST_EVENTS = 20_000
_KINDS = {IMPACT: "impact", LANDS: "touch", LEAVES: "leave", SHUTS: "shut"}


@dataclass(frozen=True)
class FreeWorld:
    """A closing hand, what its impacts depend on, the restitution, and the first base angle and rate (rad, rad/s)."""

    hand: CaptureHand
    law: ImpactLaw
    restitution: float
    first: float
    rate: float

    def ends(self, starts: ArrayLike) -> Ends:
        """How each start (N, 5) = x, y, theta, vx, vy in SI ends; theta stays that of the start."""
        rows = np.asarray(starts, dtype=float)
        found = capture_all(self.hand, rows[:, :2], rows[:, 3:], self.restitution, law=self.law)
        fingers = np.column_stack([self._angles(found.ends[:, 5], f) for f in (0, 1)])
        return Ends(found.codes, np.column_stack([found.ends[:, :2], rows[:, 2]]), fingers)

    def start(self, start: ArrayLike) -> tuple[Outcome, tuple[float, float, float], tuple[Event, ...]]:
        """Outcome, final pose (x, y, theta) and events of one start (5,); a lost disk is followed until the fingers end."""
        outcome, log = self._run(self.hand, start)
        if outcome is Outcome.INVALID:
            x, y, theta = (float(each) for each in np.asarray(start, dtype=float)[:3])
            return outcome, (x, y, theta), ()
        x, y, theta = self._last(log, outcome, float(np.asarray(start)[2]))
        known = [self._event(row) for row in log if int(row[1]) in _KINDS]
        return outcome, (x, y, theta), (*known, Event(self._clock(self._end(log, outcome)), "end", outcome.value))

    def trace(self, start: ArrayLike, frames: int) -> Trace:
        """Poses at ``frames`` equal steps of time from a valid start (5,) to its end."""
        outcome, log = self._run(self.hand, start)
        times = np.linspace(0.0, self._end(log, outcome), frames)
        _, rows = self._run(divided(self.hand, times[1:-1].tolist()), start)
        x, y, theta, vx, vy = (float(each) for each in np.asarray(start, dtype=float))
        moments = np.vstack([[0.0, PHASES, 0.0, 0.0, x, y, vx, vy, vx, vy, 0.0, 0.0], rows])
        turns = theta + np.concatenate([[0.0], np.cumsum(np.diff(moments[:, 0]) * _between(moments))])
        k = np.searchsorted(moments[:, 0], times, side="right") - 1
        past = (times - moments[k, 0])[:, None]
        places, angles = moments[k, 4:6] + past * moments[k, 8:10], turns[k] + past[:, 0] * moments[k, 11]
        fingers = np.column_stack([self._angles(times, f) for f in (0, 1)])
        return Trace(self.first + self.rate * times, np.column_stack([places, angles]), fingers)

    def _run(self, hand: CaptureHand, start: ArrayLike) -> tuple[Outcome, Floats]:
        row = np.asarray(start, dtype=float)
        outcome, _, log = capture(hand, row[:2], row[3:], self.restitution, law=self.law, events=MOST_EVENTS)
        return outcome, log

    def _end(self, log: Floats, outcome: Outcome) -> float:
        """Time (s) to which a run is told: of a lost disk until the fingers have ended, too."""
        last = float(log[-1, 0])
        return last if outcome.caught else max(last, float(self.hand.times[-1]))

    def _last(self, log: Floats, outcome: Outcome, theta: float) -> tuple[float, float, float]:
        past = self._end(log, outcome) - float(log[-1, 0])
        x, y = log[-1, 4:6] + past * log[-1, 8:10]
        turned = float((np.diff(log[:, 0]) * _between(log)).sum()) + past * float(log[-1, 11])
        return float(x), float(y), theta + turned

    def _angles(self, times: Floats, f: int) -> Floats:
        """Base angle (rad) of finger f at times (s)."""
        found: Floats = np.interp(times, self.hand.times, self.hand.angles[:, f, 0])
        return found

    def _clock(self, time: float) -> float:
        return self.first + self.rate * time

    def _event(self, row: Floats) -> Event:
        psi, kind, body, feature = self._clock(float(row[0])), int(row[1]), int(row[2]), int(row[3])
        if kind == SHUTS:
            return Event(psi, "shut", "hand")
        if body == 0:
            return Event(psi, _KINDS[kind], "palm")
        side = "right" if body <= len(self.hand.lengths) else "left"
        part = {END: "tip", BASE: "joint"}.get(feature, "link")
        return Event(psi, _KINDS[kind], f"{side}_{part}")


def _between(log: Floats) -> Floats:
    """Mean spin (rad/s) between the rows of a log: constant in flight, about linear while the disk rolls or slides."""
    found: Floats = 0.5 * (log[:-1, 11] + log[1:, 10])
    return found


def free_world(case: Case) -> FreeWorld:
    """The world of a case; raises NotCoveredError for tables, polygons and ranges."""
    hand = capture_hand_of(case)
    return FreeWorld(hand, impact_law_of(case), case.contact.restitution, case.hand.open, case.hand.finger_rate)
