"""One run of zero-gravity capture, event to event: see ``capture``."""

from __future__ import annotations

from math import hypot, inf, isfinite

from palmar.mechanics.compiled import compiled
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
    MODE,
    PHASE,
    PHASES,
    SHUTS,
    SPIN,
    STATE_WIDTH,
    TOUCHED,
    TURNS,
    VX,
    VY,
    Bench,
    T,
    X,
    Y,
    held,
    note,
)
from palmar.mechanics.impact.collision import ImpactLaw, after_impact, effective_restitution
from palmar.mechanics.impact.contact_view import PALM, SIDE, gap_at, wall_at
from palmar.mechanics.impact.enclosed import enclosed_now
from palmar.mechanics.impact.finger_motion import CaptureHand, begin_phase
from palmar.mechanics.impact.holding import fastest_rate, follow_held, foot_within
from palmar.mechanics.impact.next_contact import NOTHING, SKIN, next_contact
from palmar.mechanics.impact.settling import look, pressed_from_all_sides, settle, still_between
from palmar.mechanics.impact.slowed import change_own, is_wall, own_until, shut, slow_down, stays_shut
from palmar.models.outcome import Outcome

CAGED, STRUCTURAL, JAMMED = Outcome.CAGED.code, Outcome.STRUCTURAL.code, Outcome.JAMMED.code
ESCAPED, MISSED, INVALID, UNDECIDED = (
    Outcome.ESCAPED.code, Outcome.MISSED.code, Outcome.INVALID.code, Outcome.UNDECIDED.code
)  # fmt: skip
MOST_AT_ONCE = 60
"""Impacts without time between them after which their limit is taken."""
AT_ONCE, NEAR = 1e-13, 1e-9
"""Part of the time so far that is no time; gap, in reaches, of contacts that then count as touching."""
MOST_CHANGES = 100
"""Of the motion of fingers that nothing strikes any more: a few each."""
CRAWL = 1e-2
"""Speed, in reaches times the largest rate, of impacts that stand for sustained contact with fingers of limited torque."""
SLOW = 1e-12
"""Speed, in reaches times the largest rate, that is rest once all fingers rest."""


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
    hand: CaptureHand, law: ImpactLaw, at: Bench, e: float, body: int, feature: int, side: int, reach: float, crawl: float
) -> None:  # fmt: skip
    """The impact of the disk on a contact, and the mode after it.

    A finger that a disk slows must feel it in sustained contact, too. There hops that do not die out stand for that: an
    impact slower than ``crawl`` (m/s) is elastic, and gives half of that at least.
    """
    s = at.state
    nx, ny, wx, wy, arm = wall_at(hand, at.fingers, body, feature, float(side), s[T], s[X], s[Y])
    vx, vy, spin = s[VX], s[VY], s[SPIN]
    approach = (wx - vx) * nx + (wy - vy) * ny
    if 0.0 < approach < crawl:
        e = max(1.0, 0.5 * crawl / approach)
    arm = 0.0 if is_wall(hand, at, body) else arm
    s[VX], s[VY], s[SPIN], change = after_impact(law, e, hand.radius, nx, ny, wx, wy, arm, vx, vy, spin)
    slow_down(hand, law, at, body, change)
    s[TOUCHED], s[IMPACTS] = 1.0, s[IMPACTS] + 1.0
    note(at, IMPACT, body, feature, vx, vy, spin)
    _, _, wx, wy, _ = wall_at(hand, at.fingers, body, feature, float(side), s[T], s[X], s[Y])
    parting = (s[VX] - wx) * nx + (s[VY] - wy) * ny
    e = effective_restitution(law, e, arm) if law.torque == inf else 1.0
    settle(hand, at, e, parting, body, law.friction > 0.0, reach)
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
    rests = s[PHASE] == len(hand.times) - 1 and fastest_rate(hand, at.fingers) == 0.0
    return rests and hypot(s[VX], s[VY]) <= SLOW * reach * fastest


@compiled
def _lost(at: Bench) -> int:
    return ESCAPED if at.state[TOUCHED] > 0.0 else MISSED


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
def _next_stretch(hand: CaptureHand, law: ImpactLaw, at: Bench, phase_ends: bool) -> bool:
    """Take up what changes at this time, a phase or a finger by itself; whether the disk is enclosed."""
    if phase_ends:
        at.state[PHASE] += 1.0
        is_shut = shut(hand, law, at)
        note(at, PHASES, -1, 0, at.state[VX], at.state[VY], at.state[SPIN])
        return is_shut
    for f in range(2):
        if own_until(hand, at, f) <= at.state[T]:
            change_own(hand, law, at, f)
    note(at, TURNS, -1, 0, at.state[VX], at.state[VY], at.state[SPIN])
    return False


@compiled
def _fingers_to_their_end(hand: CaptureHand, law: ImpactLaw, at: Bench) -> None:
    """After a disk is gone: let slowed fingers come to the end of their travel, the disk flying on."""
    s, last = at.state, len(hand.times) - 1
    for _ in range(MOST_CHANGES):
        ends = hand.times[int(s[PHASE]) + 1] if s[PHASE] < last else inf
        until = min(ends, own_until(hand, at, 0), own_until(hand, at, 1))
        if until == inf:
            return
        s[X], s[Y] = s[X] + s[VX] * (until - s[T]), s[Y] + s[VY] * (until - s[T])
        s[T] = until
        _next_stretch(hand, law, at, until == ends)


@compiled
def run(hand: CaptureHand, law: ImpactLaw, at: Bench, e: float, most_events: int, reach: float, fastest: float) -> int:
    """Carry the state to its end; returns the outcome's code."""
    s, last, frictional, limited = at.state, len(hand.times) - 1, law.friction > 0.0, law.torque < inf
    if shut(hand, law, at):
        return CAGED
    settle(hand, at, 1.0 if limited else e, 0.0, -1, frictional, reach)
    crawl = CRAWL * reach * fastest if limited else 0.0
    since, at_once, b1, f1, s1, is_shut = s[T], 0, -1, 0, 0, False
    for _ in range(most_events):
        ends = hand.times[int(s[PHASE]) + 1] if s[PHASE] < last else inf
        until = min(ends, own_until(hand, at, 0), own_until(hand, at, 1)) if limited else ends
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
            strike(hand, law, at, e, body, feature, side, reach, crawl)
            at_once = at_once + 1 if s[T] - since <= AT_ONCE * s[T] else 0
            if at_once > MOST_AT_ONCE:
                code, at_once = _pressed(hand, at, reach), 0
                if code >= 0:
                    return code
                if e < 1.0 and not limited and b1 >= 0 and (b1 != body or f1 != feature):
                    still_between(hand, at, e, frictional, reach, b1, f1, s1, body, feature, side)
            since, b1, f1, s1 = s[T], body, feature, side
        elif body == NOTHING and s[T] >= until:
            is_shut = _next_stretch(hand, law, at, until == ends)
            if s[MODE] != FLIGHT and not is_shut:
                settle(hand, at, e, 0.0, held(at, 0)[0], frictional, reach)
        if is_shut or (limited and stays_shut(hand, law, at)):
            note(at, SHUTS, -1, 0, s[VX], s[VY], s[SPIN])
            return CAGED
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
    if law.torque < inf and code in (ESCAPED, MISSED):
        _fingers_to_their_end(hand, law, at)
    note(at, ENDS, -1, 0, s[VX], s[VY], s[SPIN])
    return code
