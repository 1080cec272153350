"""Zero-gravity capture: a closing hand strikes a free disk, event to event, until it is caught or gone for good.

Between impacts the disk flies straight; each next contact is found so that none is missed (``next_contact``), each
impact follows ``collision``, hops that die out become sustained contact (``settling``, ``holding``). All is seen from the
hand, which may move at a constant velocity: a start's velocity is shifted when it comes in.

Caught: the centre is in a loop of the hand that is shut for good (``enclosed``): for one straight link that is decided at
psi_c = arccos(-(D - R - h) / L), as the trapezoid below the line of the tips. Gone: no contact follows for all time.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from math import hypot, inf, isfinite

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.compiled import compiled, compiled_to_allocate
from palmar.mechanics.impact.capture_state import (
    ENDS,
    FLIGHT,
    IMPACT,
    IMPACTS,
    LANDS,
    LEAVES,
    LEFT_BODY,
    LEFT_OTHER,
    LEFT_UNTIL,
    LOGGED,
    MODE,
    PHASE,
    SHUTS,
    SPIN,
    STATE_WIDTH,
    TOUCHED,
    VX,
    VY,
    Bench,
    T,
    X,
    Y,
    bench,
    held,
    note,
)
from palmar.mechanics.impact.collision import ImpactLaw, after_impact, effective_restitution
from palmar.mechanics.impact.contact_view import PALM, SIDE, gap_at, wall_at
from palmar.mechanics.impact.enclosed import enclosed_for_good, enclosed_now
from palmar.mechanics.impact.finger_motion import CaptureHand, Floats, begin_phase
from palmar.mechanics.impact.holding import follow_held, foot_within
from palmar.mechanics.impact.next_contact import NOTHING, SKIN, next_contact
from palmar.mechanics.impact.settling import look, pressed_from_all_sides, settle, still_between
from palmar.models.outcome import Outcome

CAGED, STRUCTURAL, JAMMED = Outcome.CAGED.code, Outcome.STRUCTURAL.code, Outcome.JAMMED.code
ESCAPED, MISSED, INVALID, UNDECIDED = (
    Outcome.ESCAPED.code, Outcome.MISSED.code, Outcome.INVALID.code, Outcome.UNDECIDED.code
)  # fmt: skip
MOST_EVENTS = 20_000
"""Losses near the throat of a hand that shuts take hundreds of impacts at e = 1."""
MOST_AT_ONCE = 60
"""Impacts without time between them after which their limit is taken."""
AT_ONCE, NEAR = 1e-13, 1e-9
"""Part of the time so far that is no time; gap, in reaches, of contacts that then count as touching."""
SLOW = 1e-12
"""Speed, in reaches times the largest rate, that is rest once all fingers rest."""
END_WIDTH = 7
ROWS_PER_TASK = 4_000


@compiled
def overlaps(hand: CaptureHand, at: Bench, skin: float) -> bool:
    """Whether the disk overlaps the hand by more than ``skin``."""
    s, n = at.state, len(hand.lengths)
    for up in (1.0, -1.0):
        gap, foot = gap_at(hand, at.fingers, PALM, SIDE, up, s[T], s[X], s[Y])
        if -2.0 * hand.radius < gap < -skin and abs(foot) <= hand.half_palm and up * s[Y] >= 0.0:
            return True
    for f in range(2):
        if gap_at(hand, at.fingers, 1 + f * n, 2, 1.0, s[T], s[X], s[Y])[0] < -skin:
            return True
        for j in range(n):
            b = 1 + f * n + j
            gap, foot = gap_at(hand, at.fingers, b, SIDE, 1.0, s[T], s[X], s[Y])
            other, _ = gap_at(hand, at.fingers, b, SIDE, -1.0, s[T], s[X], s[Y])
            if max(gap, other) < -skin and foot_within(hand, b, SIDE, foot):
                return True
            if gap_at(hand, at.fingers, b, 1, 1.0, s[T], s[X], s[Y])[0] < -skin:
                return True
    return False


@compiled
def strike(
    hand: CaptureHand, law: ImpactLaw, at: Bench, e: float, body: int, feature: int, side: int, reach: float
) -> None:  # fmt: skip
    """The impact of the disk on a contact, and the mode after it."""
    s = at.state
    nx, ny, wx, wy, arm = wall_at(hand, at.fingers, body, feature, float(side), s[T], s[X], s[Y])
    vx, vy, spin = s[VX], s[VY], s[SPIN]
    s[VX], s[VY], s[SPIN], _ = after_impact(law, e, hand.radius, nx, ny, wx, wy, arm, vx, vy, spin)
    s[TOUCHED], s[IMPACTS] = 1.0, s[IMPACTS] + 1.0
    note(at, IMPACT, body, feature, vx, vy, spin)
    parting = (s[VX] - wx) * nx + (s[VY] - wy) * ny
    settle(hand, at, effective_restitution(law, e, arm), parting, body, law.friction > 0.0, reach)
    if s[MODE] != FLIGHT:
        b, what, _ = held(at, 0)
        note(at, LANDS, b, what, s[VX], s[VY], s[SPIN])


@compiled
def _fly(hand: CaptureHand, at: Bench, until: float, reach: float) -> tuple[int, int, int, bool]:
    """Fly to the next contact, or ``until``: (body, feature, side, whether there is a next event)."""
    s = at.state
    tau, body, feature, side = next_contact(
        hand,
        at.fingers,
        s[T],
        s[X],
        s[Y],
        s[VX],
        s[VY],
        until - s[T],
        reach,
        int(s[LEFT_BODY]),
        int(s[LEFT_OTHER]),
        s[LEFT_UNTIL],
    )
    if body == NOTHING and until == inf:
        return body, feature, side, False
    s[X], s[Y] = s[X] + s[VX] * tau, s[Y] + s[VY] * tau
    s[T] = until if body == NOTHING else s[T] + tau
    s[LEFT_BODY], s[LEFT_OTHER] = -1.0, -1.0
    return body, feature, side, True


@compiled
def _gone(hand: CaptureHand, at: Bench, reach: float, fastest: float) -> bool:
    """Whether the disk, out of everything's reach, does not come nearer, or rests when all fingers do."""
    s = at.state
    if s[X] * s[X] + s[Y] * s[Y] > 4.0 * reach * reach and s[X] * s[VX] + s[Y] * s[VY] >= 0.0:
        return True
    return s[PHASE] == len(hand.times) - 1 and hypot(s[VX], s[VY]) <= SLOW * reach * fastest


@compiled
def _lost(at: Bench) -> int:
    return ESCAPED if at.state[TOUCHED] > 0.0 else MISSED


@compiled
def _shut(hand: CaptureHand, at: Bench) -> bool:
    """Take up the phase that has begun; whether the disk is enclosed for good now."""
    s = at.state
    begin_phase(hand, int(s[PHASE]), at.fingers)
    return enclosed_for_good(hand, at.fingers, s[T], s[X], s[Y], at.chain)


@compiled
def _pressed(hand: CaptureHand, at: Bench, reach: float) -> int:
    """The outcome if the fingers press on the disk from all sides, -1 if they do not."""
    s = at.state
    count = look(hand, at, NEAR * reach)
    if not pressed_from_all_sides(at, count):
        return -1
    if count >= 3:
        return STRUCTURAL
    return CAGED if enclosed_now(hand, at.fingers, s[T], s[X], s[Y], at.chain) else JAMMED


@compiled
def run(hand: CaptureHand, law: ImpactLaw, at: Bench, e: float, most_events: int, reach: float, fastest: float) -> int:
    """Carry the state to its end; returns the outcome's code."""
    s, last, frictional = at.state, len(hand.times) - 1, law.friction > 0.0
    if _shut(hand, at):
        return CAGED
    settle(hand, at, e, 0.0, -1, frictional, reach)
    since, at_once, b1, f1, s1 = s[T], 0, -1, 0, 0
    for _ in range(most_events):
        until = hand.times[int(s[PHASE]) + 1] if s[PHASE] < last else inf
        if s[MODE] == FLIGHT:
            if _gone(hand, at, reach, fastest):
                return _lost(at) if s[X] * s[X] + s[Y] * s[Y] > reach * reach or s[TOUCHED] == 0.0 else JAMMED
            body, feature, side, goes_on = _fly(hand, at, until, reach)
            if not goes_on:
                return _lost(at)
        else:
            body, feature, side, still = follow_held(hand, law, at, until, reach, most_events)
            if not still:
                b, what, _ = held(at, 0)
                settle(hand, at, e, 0.0, b, frictional, reach)
                note(at, LEAVES, b, what, s[VX], s[VY], s[SPIN])
                continue
        if body >= 0:
            strike(hand, law, at, e, body, feature, side, reach)
            at_once = at_once + 1 if s[T] - since <= AT_ONCE * s[T] else 0
            if at_once > MOST_AT_ONCE:
                code, at_once = _pressed(hand, at, reach), 0
                if code >= 0:
                    return code
                if e < 1.0 and b1 >= 0 and (b1 != body or f1 != feature):
                    still_between(hand, at, e, frictional, reach, b1, f1, s1, body, feature, side)
            since, b1, f1, s1 = s[T], body, feature, side
        elif body == NOTHING and s[T] >= until:
            s[PHASE] += 1.0
            if _shut(hand, at):
                note(at, SHUTS, -1, 0, s[VX], s[VY], s[SPIN])
                return CAGED
            if s[MODE] != FLIGHT:
                settle(hand, at, e, 0.0, held(at, 0)[0], frictional, reach)
    return UNDECIDED


@compiled
def capture_on(
    hand: CaptureHand, law: ImpactLaw, at: Bench, x: float, y: float, vx: float, vy: float, spin: float, e: float,
    most_events: int,
) -> int:  # fmt: skip
    """``capture`` on a given bench, whose state then is the end; returns the outcome's code."""
    s = at.state
    for k in range(STATE_WIDTH):
        s[k] = 0.0
    s[X], s[Y], s[VX], s[VY], s[SPIN], s[T] = x, y, vx, vy, spin, hand.times[0]
    s[LEFT_BODY], s[LEFT_OTHER] = -1.0, -1.0
    begin_phase(hand, 0, at.fingers)
    reach = hand.half_palm + hand.lengths.sum() + hand.half_thickness + hand.radius
    fastest = hypot(vx, vy) / reach
    for k in range(len(hand.times)):
        for j in range(len(hand.lengths)):
            fastest = max(fastest, abs(hand.rates[k, 0, j]), abs(hand.rates[k, 1, j]))
    if not isfinite(x + y + vx + vy + spin) or overlaps(hand, at, SKIN * reach):
        return INVALID
    code = run(hand, law, at, e, most_events, reach, fastest)
    note(at, ENDS, -1, 0, s[VX], s[VY], s[SPIN])
    return code


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


@dataclass(frozen=True)
class Captures:
    """How N starts ended: outcome codes (N,); ``ends`` (N, 7): x, y, vx, vy, spin, time, number of impacts."""

    codes: NDArray[np.int8]
    ends: Floats


def capture(
    hand: CaptureHand, position: ArrayLike, velocity: ArrayLike = (0.0, 0.0), restitution: float = 1.0, *,
    spin: float = 0.0, law: ImpactLaw | None = None, hand_velocity: ArrayLike = (0.0, 0.0), events: int = 1000,
    most_events: int = MOST_EVENTS,
) -> tuple[Outcome, Floats, Floats]:  # fmt: skip
    """(outcome, end (7,), events (E, EVENT_WIDTH)) of one start; in the frame of the hand."""
    at = bench(hand, events)
    (x, y), (vx, vy) = np.asarray(position, float), np.asarray(velocity, float) - np.asarray(hand_velocity, float)
    code = capture_on(hand, law or ImpactLaw(), at, x, y, vx, vy, float(spin), float(restitution), most_events)
    s = at.state
    return Outcome.from_code(code), s[[X, Y, VX, VY, SPIN, T, IMPACTS]].copy(), at.log[: int(s[LOGGED])].copy()


def capture_all(
    hand: CaptureHand, positions: ArrayLike, velocities: ArrayLike = (0.0, 0.0), restitution: ArrayLike = 1.0, *,
    spins: ArrayLike = 0.0, law: ImpactLaw | None = None, hand_velocity: ArrayLike = (0.0, 0.0),
    most_events: int = MOST_EVENTS, threads: int = 2,
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
    known = law or ImpactLaw()

    def part(first: int) -> None:
        some = slice(first, first + ROWS_PER_TASK)
        capture_rows(hand, known, bench(hand), starts[some], es[some], most_events, codes[some], ends[some])

    if len(places) <= ROWS_PER_TASK:
        part(0)
    else:
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(part, range(0, len(places), ROWS_PER_TASK)))
    return Captures(codes, ends)
