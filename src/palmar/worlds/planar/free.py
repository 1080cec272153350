"""Closing on a free disk: from a case and its starts to how each ends, what happened when, and the way of one start.

Times are given as for the table, as the base angle that a finger would have if it never stopped: psi = open + rate t.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.impact.capture import capture, capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of, impact_law_of
from palmar.mechanics.impact.capture_hand import divided
from palmar.mechanics.impact.capture_state import FINGERS, IMPACT, LANDS, LEAVES, PHASES, SHUTS
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
        return Ends(found.codes, np.column_stack([found.ends[:, :2], rows[:, 2]]), found.ends[:, 7:9])

    def start(
        self, start: ArrayLike
    ) -> tuple[Outcome, tuple[float, float, float], tuple[float, ...], tuple[Event, ...]]:
        """Outcome, final pose (x, y, theta), final joint angles (right finger's, left's) and events of one start (5,).

        A lost disk is followed until the fingers end. Straight, stiff links count as one.
        """
        outcome, log = self._run(self.hand, start)
        if outcome is Outcome.INVALID:
            x, y, theta = (float(each) for each in np.asarray(start, dtype=float)[:3])
            return outcome, (x, y, theta), tuple(self._joints(np.array([0.0]))[0].tolist()), ()
        x, y, theta = self._last(log, outcome, float(np.asarray(start)[2]))
        known = [self._event(row) for row in log if int(row[1]) in _KINDS]
        end = self._end(log, outcome)
        joints = tuple(self._angles(log, np.array([end]))[0].tolist())
        return outcome, (x, y, theta), joints, (*known, Event(self._clock(end), "end", outcome.value))

    def trace(self, start: ArrayLike, frames: int) -> Trace:
        """Poses at ``frames`` equal steps of time from a valid start (5,) to its end."""
        outcome, log = self._run(self.hand, start)
        times = np.linspace(0.0, self._end(log, outcome), frames)
        between = times[(times > 0.0) & (times < self.hand.times[-1])]
        _, rows = self._run(divided(self.hand, between.tolist()), start)
        x, y, theta, vx, vy = (float(each) for each in np.asarray(start, dtype=float))
        begin = [(self.hand.angles[0, f, 0], self.hand.rates[0, f, 0], 0.0) for f in (0, 1)]
        moments = np.vstack([[0.0, PHASES, 0.0, 0.0, x, y, vx, vy, vx, vy, 0.0, 0.0, *begin[0], *begin[1]], rows])
        turns = theta + np.concatenate([[0.0], np.cumsum(np.diff(moments[:, 0]) * _between(moments))])
        k = np.searchsorted(moments[:, 0], times, side="right") - 1
        past = (times - moments[k, 0])[:, None]
        places, angles = moments[k, 4:6] + past * moments[k, 8:10], turns[k] + past[:, 0] * moments[k, 11]
        return Trace(self.first + self.rate * times, np.column_stack([places, angles]), self._angles(moments, times))

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

    def _angles(self, log: Floats, times: Floats) -> Floats:
        """Joint angles (N, 2 links; rad), right finger's first, at times (s): as prescribed, or as impacts slowed them."""
        if self.law.torque == inf:
            return self._joints(times)
        k = np.maximum(np.searchsorted(log[:, 0], times, side="right") - 1, 0)
        past = times - log[k, 0]
        rows = [log[k, FINGERS + 3 * f : FINGERS + 3 * f + 3] for f in (0, 1)]
        return np.column_stack([row[:, 0] + (row[:, 1] + 0.5 * row[:, 2] * past) * past for row in rows])

    def _joints(self, times: Floats) -> Floats:
        """As prescribed."""
        links = range(len(self.hand.lengths))
        turned = [[np.interp(times, self.hand.times, self.hand.angles[:, f, j]) for j in links] for f in (0, 1)]
        return np.concatenate([np.diff(each, axis=0, prepend=0.0) for each in turned]).T

    def _clock(self, time: float) -> float:
        return self.first + self.rate * time

    def _event(self, row: Floats) -> Event:
        psi, kind, body, feature = self._clock(float(row[0])), int(row[1]), int(row[2]), int(row[3])
        if kind == SHUTS:
            return Event(psi, "shut", "hand")
        if body == 0:
            return Event(psi, _KINDS[kind], "palm")
        links = len(self.hand.lengths)
        finger, link = divmod(body - 1, links)
        if links == 1:
            part = {END: "tip", BASE: "joint"}.get(feature, "link")
        elif feature in (END, BASE):
            joint = link + (feature == END)
            part = "tip" if joint == links else f"joint_{joint + 1}"
        else:
            part = f"link_{link + 1}"
        return Event(psi, _KINDS[kind], f"{('right', 'left')[finger]}_{part}")


def _between(log: Floats) -> Floats:
    """Mean spin (rad/s) between the rows of a log: constant in flight, about linear while the disk rolls or slides."""
    found: Floats = 0.5 * (log[:-1, 11] + log[1:, 10])
    return found


def free_world(case: Case) -> FreeWorld:
    """The world of a case; raises NotCoveredError for tables, polygons and ranges."""
    hand = capture_hand_of(case)
    return FreeWorld(hand, impact_law_of(case), case.contact.restitution, case.hand.open, case.hand.finger_rate)
