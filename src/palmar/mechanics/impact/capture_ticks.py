"""Zero-gravity capture taken from one moment to the next, so that what the hand does can depend on what it feels.

The events are those of ``capture_run``; only the ends differ: a time is reached, or the fingers press on the disk from all
sides. Whether the disk is caught is asked of a hand that rests where it is (``ends_at_rest``).
"""

from __future__ import annotations

from palmar.mechanics.compiled import compiled
from palmar.mechanics.impact.capture_run import AT_ONCE, MOST_AT_ONCE, NEAR, overlaps, run, strike
from palmar.mechanics.impact.capture_state import (
    FLIGHT,
    LEAVES,
    LEFT_BODY,
    LEFT_OTHER,
    LEFT_UNTIL,
    LOGGED,
    MODE,
    PHASE,
    SPIN,
    STATE_WIDTH,
    VX,
    VY,
    Bench,
    T,
    X,
    Y,
    held,
    note,
)
from palmar.mechanics.impact.collision import ImpactLaw
from palmar.mechanics.impact.enclosed import enclosed_now
from palmar.mechanics.impact.finger_motion import CaptureHand, begin_phase
from palmar.mechanics.impact.holding import follow_held
from palmar.mechanics.impact.next_contact import NOTHING, SKIN, next_contact
from palmar.mechanics.impact.settling import look, pressed_from_all_sides, settle, still_between
from palmar.models.outcome import Outcome

GOES_ON, PRESSED, TOO_MANY = range(3)
"""The time is reached; the fingers press from all sides, the disk has nowhere to go; the bound on events is."""
CAGED, STRUCTURAL, JAMMED = Outcome.CAGED.code, Outcome.STRUCTURAL.code, Outcome.JAMMED.code


@compiled
def put(hand: CaptureHand, at: Bench, x: float, y: float, vx: float, vy: float) -> bool:
    """Put the disk, without spin, before a hand whose first phase begins; whether it is clear of the hand."""
    s = at.state
    for k in range(STATE_WIDTH):
        s[k] = 0.0
    s[X], s[Y], s[VX], s[VY], s[T], s[LEFT_BODY], s[LEFT_OTHER] = x, y, vx, vy, hand.times[0], -1.0, -1.0
    begin_phase(hand, 0, at.fingers)
    return not overlaps(hand, at, SKIN * hand_reach(hand))


@compiled
def hand_reach(hand: CaptureHand) -> float:
    """``CaptureHand.reach`` for kernels."""
    return hand.half_palm + hand.lengths.sum() + hand.half_thickness + hand.radius


@compiled
def _fly_until(hand: CaptureHand, at: Bench, until: float, reach: float) -> tuple[int, int, int]:
    """Fly to the next contact, or ``until``; a body that was just left stays known as such over the end of a flight."""
    s = at.state
    tau, body, feature, side = next_contact(
        hand, at.fingers, s[T], s[X], s[Y], s[VX], s[VY], until - s[T], reach,
        int(s[LEFT_BODY]), int(s[LEFT_OTHER]), s[LEFT_UNTIL],
    )  # fmt: skip
    s[X], s[Y] = s[X] + s[VX] * tau, s[Y] + s[VY] * tau
    s[T] = until if body == NOTHING else s[T] + tau
    s[LEFT_UNTIL] -= tau
    if body != NOTHING or s[LEFT_UNTIL] <= 0.0:
        s[LEFT_BODY], s[LEFT_OTHER] = -1.0, -1.0
    return body, feature, side


@compiled
def carry_until(
    hand: CaptureHand, law: ImpactLaw, at: Bench, e: float, until: float, most_events: int, anew: bool
) -> int:
    """Carry the state on, the hand in its first phase, for which it is made; ``anew``: that differs from what was before.

    Returns GOES_ON, PRESSED or TOO_MANY; the log holds the events since.
    """
    s, reach, frictional = at.state, hand_reach(hand), law.friction > 0.0
    s[PHASE], s[LOGGED] = 0.0, 0.0
    begin_phase(hand, 0, at.fingers)
    if anew:
        settle(hand, at, e, 0.0, -1, frictional, reach)
    since, at_once, b1, f1, s1 = s[T], 0, -1, 0, 0
    for _ in range(most_events):
        if s[T] >= until:
            return GOES_ON
        if s[MODE] == FLIGHT:
            body, feature, side = _fly_until(hand, at, until, reach)
        else:
            body, feature, side, still = follow_held(hand, law, at, until, reach, most_events)
            if not still:
                b, what, _ = held(at, 0)
                settle(hand, at, e, 0.0, b, frictional, reach)
                note(at, LEAVES, b, what, s[VX], s[VY], s[SPIN])
                continue
        if body >= 0:
            strike(hand, law, at, e, body, feature, side, reach, 0.0)
            at_once = at_once + 1 if s[T] - since <= AT_ONCE * s[T] else 0
            if at_once > MOST_AT_ONCE:
                at_once = 0
                if pressed_from_all_sides(at, look(hand, at, NEAR * reach)):
                    return PRESSED
                if e < 1.0 and b1 >= 0 and (b1 != body or f1 != feature):
                    still_between(hand, at, e, frictional, reach, b1, f1, s1, body, feature, side)
            since, b1, f1, s1 = s[T], body, feature, side
    return TOO_MANY


@compiled
def is_enclosed(hand: CaptureHand, at: Bench) -> bool:
    """Whether the disk is in a loop of the hand that is shut as it is now."""
    s = at.state
    return enclosed_now(hand, at.fingers, s[T], s[X], s[Y], at.chain)


@compiled
def ends_at_rest(
    hand: CaptureHand, law: ImpactLaw, at: Bench, e: float, most_events: int, fastest: float, pressed: bool
) -> int:
    """The outcome's code, the hand, of one phase, resting where it is; ``pressed``: its fingers press from all sides.

    ``fastest`` (rad/s): the rate of its fingers, by which speeds count as rest. Moves the state to its end.
    """
    s, reach = at.state, hand_reach(hand)
    s[PHASE], s[T] = 0.0, hand.times[0]
    begin_phase(hand, 0, at.fingers)
    if not pressed:
        return run(hand, law, at, e, most_events, reach, fastest)
    if is_enclosed(hand, at):
        return CAGED
    return STRUCTURAL if look(hand, at, NEAR * reach) >= 3 else JAMMED
