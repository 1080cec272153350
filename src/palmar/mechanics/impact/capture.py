"""Zero-gravity capture: a closing hand strikes a free disk, event to event, until it is caught or gone for good.

Between impacts the disk flies straight; each next contact is found so that none is missed (``next_contact``), each
impact follows ``collision``, hops that die out become sustained contact (``settling``, ``holding``). All is seen from the
hand, which may move at a constant velocity: a start's velocity is shifted when it comes in.

Caught: the centre is in a loop of the hand that is shut for good (``enclosed``): for one straight link that is decided at
psi_c = arccos(-(D - R - h) / L), as the trapezoid below the line of the tips. Gone: no contact follows for all time.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.batch import in_parts
from palmar.mechanics.compiled import compiled_to_allocate
from palmar.mechanics.impact.capture_run import capture_on
from palmar.mechanics.impact.capture_state import IMPACTS, LOGGED, SPIN, VX, VY, Bench, T, X, Y, bench
from palmar.mechanics.impact.collision import ImpactLaw
from palmar.mechanics.impact.finger_motion import CaptureHand, Floats, turned
from palmar.mechanics.impact.slowed import covered
from palmar.models.outcome import Outcome

MOST_EVENTS = 20_000
"""Losses near the throat of a hand that shuts take hundreds of impacts at e = 1."""
END_WIDTH = 9
ROWS_PER_TASK = 250


@compiled_to_allocate
def capture_rows(
    hand: CaptureHand, law: ImpactLaw, at: Bench, starts: Floats, es: Floats, most_events: int,
    codes: NDArray[np.int8], ends: Floats,
) -> None:  # fmt: skip
    """``capture`` for each row of ``starts`` (N, 5) on one bench."""
    s = at.state
    for k in range(len(starts)):
        row, end = starts[k], ends[k]
        codes[k] = capture_on(hand, law, at, row[0], row[1], row[2], row[3], row[4], es[k], most_events)
        end[0], end[1], end[2], end[3], end[4], end[5], end[6] = s[X], s[Y], s[VX], s[VY], s[SPIN], s[T], s[IMPACTS]
        end[7], end[8] = turned(at.fingers[0], 0, s[T])[0], turned(at.fingers[1], 0, s[T])[0]


@dataclass(frozen=True)
class Captures:
    """How N starts ended: outcome codes (N,); ``ends`` (N, 9): x, y, vx, vy, spin, time, number of impacts, and
    the base angles (rad) of the right and the left finger.
    """

    codes: NDArray[np.int8]
    ends: Floats


def capture(
    hand: CaptureHand, position: ArrayLike, velocity: ArrayLike = (0.0, 0.0), restitution: float = 1.0, *,
    spin: float = 0.0, law: ImpactLaw | None = None, hand_velocity: ArrayLike = (0.0, 0.0), events: int = 1000,
    most_events: int = MOST_EVENTS,
) -> tuple[Outcome, Floats, Floats]:  # fmt: skip
    """(outcome, end (7,), events (E, EVENT_WIDTH)) of one start; in the frame of the hand."""
    known, at = covered(hand, law or ImpactLaw()), bench(hand, events)
    (x, y), (vx, vy) = np.asarray(position, float), np.asarray(velocity, float) - np.asarray(hand_velocity, float)
    code = capture_on(hand, known, at, x, y, vx, vy, float(spin), float(restitution), most_events)
    s = at.state
    return Outcome.from_code(code), s[[X, Y, VX, VY, SPIN, T, IMPACTS]].copy(), at.log[: int(s[LOGGED])].copy()


def capture_all(
    hand: CaptureHand, positions: ArrayLike, velocities: ArrayLike = (0.0, 0.0), restitution: ArrayLike = 1.0, *,
    spins: ArrayLike = 0.0, law: ImpactLaw | None = None, hand_velocity: ArrayLike = (0.0, 0.0),
    most_events: int = MOST_EVENTS, threads: int | None = None,
) -> Captures:  # fmt: skip
    """Batch: ``positions`` (N, 2); ``velocities`` (N, 2) or (2,), ``restitution`` and ``spins`` (N,) or one; SI.

    Positions are those at time 0 in the frame of the hand, ends too. Rows are independent: ``threads`` do not matter.
    """
    places = np.atleast_2d(np.asarray(positions, dtype=float))
    starts = np.empty((len(places), 5))
    starts[:, :2] = places
    starts[:, 2:4] = np.asarray(velocities, dtype=float) - np.asarray(hand_velocity, dtype=float)
    starts[:, 4] = spins
    es = np.ascontiguousarray(np.broadcast_to(np.asarray(restitution, dtype=float), len(places)))
    codes, ends = np.empty(len(places), np.int8), np.empty((len(places), END_WIDTH))
    known = covered(hand, law or ImpactLaw())

    def part(some: slice) -> None:
        capture_rows(hand, known, bench(hand), starts[some], es[some], most_events, codes[some], ends[some])

    in_parts(part, len(places), ROWS_PER_TASK, threads)
    return Captures(codes, ends)
