"""The state of one capture run, kept in arrays so that a batch allocates nothing per start."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from palmar.mechanics.compiled import compiled
from palmar.mechanics.impact.finger_motion import FASTER, FINGER_WIDTH, CaptureHand, Floats, turned

T, X, Y, VX, VY, SPIN, PHASE, MODE, TOUCHED, IMPACTS, LOGGED, LEFT_BODY, LEFT_OTHER, LEFT_UNTIL, OWN = range(15)
HELD = 16
"""From here on two held contacts (body, feature, side) of sustained motion."""
STATE_WIDTH = HELD + 6
FLIGHT, ONE, TWO = 0, 1, 2
"""MODE: in flight, or held by so many contacts."""
IMPACT, LANDS, LEAVES, SHUTS, ENDS, PHASES, TURNS = range(7)
"""Kinds of event: impact, sustained contact begins, ends, a loop shuts about the disk for good, the run ends, a phase of the
hand's motion begins, a slowed finger's own motion changes."""
FINGERS, EVENT_WIDTH = 12, 18
"""An event is (time, kind, body, feature, x, y, velocity before (2), after (2), spin before, after), then from FINGERS on
(angle, rate, acceleration) of the right finger's base joint and of the left one's, as they go on."""
MOST_TOUCHING, TOUCHING_WIDTH = 8, 7
"""A touching contact is a row (body, feature, side, normal (2), demand, speed of parting)."""


class Bench(NamedTuple):
    """Arrays of one run: ``state``, ``fingers`` in motion, corners of the ``chain``, ``touching`` contacts, ``log``."""

    state: Floats
    fingers: Floats
    chain: Floats
    touching: Floats
    log: Floats


def bench(hand: CaptureHand, events: int = 0) -> Bench:
    """A bench that logs up to so many events."""
    return Bench(
        np.zeros(STATE_WIDTH),
        np.zeros((2, FINGER_WIDTH)),
        np.zeros((2 * len(hand.lengths) + 2, 2)),
        np.zeros((MOST_TOUCHING, TOUCHING_WIDTH)),
        np.zeros((events, EVENT_WIDTH)),
    )


@compiled
def note(at: Bench, kind: int, body: int, feature: int, vx: float, vy: float, spin: float) -> None:
    """Log an event at the state, with the velocity and spin before it."""
    s = at.state
    k = int(s[LOGGED])
    if k < len(at.log):
        row = at.log[k]
        row[0], row[1], row[2], row[3], row[4], row[5] = s[T], kind, body, feature, s[X], s[Y]
        row[6], row[7], row[8], row[9], row[10], row[11] = vx, vy, s[VX], s[VY], spin, s[SPIN]
        for f in range(2):
            angle, rate = turned(at.fingers[f], 0, s[T])
            first = FINGERS + 3 * f
            row[first], row[first + 1], row[first + 2] = angle, rate, at.fingers[f, FASTER]
        s[LOGGED] += 1.0


@compiled
def hold(at: Bench, k: int, row: int) -> None:
    """Make a touching contact the k-th held one."""
    for i in range(3):
        at.state[HELD + 3 * k + i] = at.touching[row, i]


@compiled
def held(at: Bench, k: int) -> tuple[int, int, float]:
    """(body, feature, side) of the k-th held contact."""
    s = at.state
    return int(s[HELD + 3 * k]), int(s[HELD + 3 * k + 1]), s[HELD + 3 * k + 2]
