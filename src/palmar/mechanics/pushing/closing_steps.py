"""A closing hand carries a disk or convex polygon on a table through its motion, step by step, to the end.

Any hand of ``hand_pose``, any limit surface, any friction. Quasi-static: the object moves only while it is pushed; its
twist follows from the contacts that touch (``closing_motion``), strides end where a new contact begins
(``closing_stride``), and after each the contacts that carry load are shifted back to gap zero, which only removes the
drift of that stride. Where no motion is admissible the object is jammed: a finger without which there is a motion
stalls, else both do. A finger that has stalled stays where it is, a rigid wall; the other goes on.

Where Coulomb's law admits several motions, the one nearest to the last is followed and the others after it, up to
``DEEPEST`` such choices in a row; the worst end counts, and the start is flagged.

Right to the tolerance (finger lengths per stride), but for contacts that came and went within ``closing_touch.FINEST``, and
for the end pose of a polygon that escapes off the very tip of a line finger: there the mechanics is discontinuous.
"""

from __future__ import annotations

from math import isfinite
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.batch import in_parts
from palmar.mechanics.compiled import compiled, compiled_to_allocate
from palmar.mechanics.pushing import closing_end
from palmar.mechanics.pushing.closing_contacts import look, look_again, settle_and_look, without_wall
from palmar.mechanics.pushing.closing_course import go_on
from palmar.mechanics.pushing.closing_events import ENDS, mirror_log, note, note_modes
from palmar.mechanics.pushing.closing_jam import pinch, stall
from palmar.mechanics.pushing.closing_kink import first_kink
from palmar.mechanics.pushing.closing_motion import (
    ARM,
    DEPTH,
    FLAGS,
    KEPT,
    LEFT,
    LOGGED,
    MOST_BRANCHES,
    OMEGA,
    PINCHED,
    RIGHT,
    SEVERAL,
    STATE_WIDTH,
    THETA,
    TIME,
    TOUCHED,
    VX,
    VY,
    Bench,
    X,
    Y,
    bench,
    write_contacts,
)  # fmt: skip
from palmar.mechanics.pushing.closing_next import UNSOLVED, next_twist
from palmar.mechanics.pushing.closing_stride import FIRST_STRIDE, LONGEST_ARC, stride, turns_along
from palmar.mechanics.pushing.closing_touch import first_change, first_touch
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion, as_halted
from palmar.mechanics.pushing.limit_surface import ELLIPSOID, UNIFORM_DISK
from palmar.mechanics.pushing.meeting import travel_end
from palmar.mechanics.pushing.polygon_contacts import Body, Scale, scale_of
from palmar.mechanics.pushing.single_tables import tabulated
from palmar.models.outcome import Outcome

Floats = NDArray[np.float64]
INVALID, UNDECIDED = Outcome.INVALID.code, Outcome.UNDECIDED.code
TOLERANCE, BATCH_TOLERANCE = 1e-7, 1e-6
"""Error allowed per stride, in finger lengths: for one start; for many, of which the outcomes are asked."""
MOST_STEPS, DEEPEST, ROWS_PER_TASK, MANY_STARTS = 4000, 3, 64, 2000
AFRESH, RANGE = 0.6, 0.01
"""Length of a stride after an event, in units of what the one that it ended would have had; part of ``TOUCH`` by which a
contact is past its range when that is noticed."""
AMBIGUOUS, CUT_SHORT = 1, 2
"""Flags: several motions were admissible somewhere; not all were followed; the search for one did not converge."""


class End(NamedTuple):
    """Outcome code; final pose in the table's frame, where the hand's started; base angles; flags; arm's halt."""

    code: int
    x: float
    y: float
    theta: float
    right: float
    left: float
    flags: int
    halt: float


@compiled
def _branch(at: Bench, number: int, branches: int) -> int:
    """Keep the further motions here for later; returns how many alternatives now wait."""
    s = at.state
    s[FLAGS] = int(s[FLAGS]) | AMBIGUOUS
    if s[SEVERAL] > 0.0:
        return branches
    s[SEVERAL] = 1.0
    for m in range(1, number):
        if s[DEPTH] >= DEEPEST or branches == MOST_BRANCHES:
            s[FLAGS] = int(s[FLAGS]) | CUT_SHORT
            return branches
        for k in range(STATE_WIDTH):
            at.branches[branches, k] = s[k]
        row, motion = at.branches[branches], at.space.motions[m]
        row[VX], row[VY], row[OMEGA] = motion[0], motion[1], motion[2]
        row[DEPTH] += 1.0
        branches += 1
    return branches


@compiled
def _cut(hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale, h: float, over: int) -> float:
    """Fraction of the stride, whose stages are filled, at which its mode ends or a contact begins or leaves its range."""
    part = first_kink(hand, body, at, count, scale.skin, h, over) if over < 7 else 1.0
    part = first_touch(hand, body, at, count, scale, h, part)
    return first_change(hand, body, at, count, RANGE * scale.touch, h, part) if count > 0 else part


@compiled
def _ahead(
    hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale, speed: float, h: float, left: float
) -> tuple[float, float, int]:
    """The stride to take from the state, h the last proposal: as ``stride``; at rest the whole time ``left``, or an arc."""
    at.pivot[0] = 0.0
    if speed == 0.0:
        at.stages[:] = 0.0
        at.course[:] = 0.0
        return left, FIRST_STRIDE, 7
    if turns_along(hand, body, at, count):
        return min(left, LONGEST_ARC), FIRST_STRIDE, 7
    at.state[PINCHED] = 0.0
    return stride(hand, body, at, count, scale, min(h, left))


@compiled
def follow(hand: HandMotion, body: Body, at: Bench, scale: Scale, most_steps: int, branches: int) -> tuple[bool, int]:
    """Carry the state to its end; returns (whether that was reached, number of alternatives that wait)."""
    s, h, hand = at.state, FIRST_STRIDE, as_halted(hand, at.state[ARM])
    _, count = look(hand, body, at, scale, scale.touch)
    at.loads[:], at.trend[:], s[KEPT] = 0.0, 0.0, 0.0
    if count > 0:
        _, count = settle_and_look(hand, body, at, count, scale, False)
    last = travel_end(hand, s[TIME], s[RIGHT], s[LEFT], at.links)
    for _ in range(most_steps):
        if s[TIME] >= last or (s[RIGHT] != MOVING and s[LEFT] != MOVING):
            return True, branches
        speed = write_contacts(hand, body, at, count, scale.skin, s[TIME], s[RIGHT], s[LEFT], s[X], s[Y], s[THETA])
        number = next_twist(body, at, count, speed)
        if number == 0:
            stall(hand, body, at, count, scale.skin)
            hand = as_halted(hand, s[ARM])
            last = travel_end(hand, s[TIME], s[RIGHT], s[LEFT], at.links)
            continue
        if number > 1:
            branches = _branch(at, number, branches)
        motion = at.space.motions[0]
        s[VX], s[VY], s[OMEGA] = motion[0], motion[1], motion[2]
        if len(at.log) > 0:
            note_modes(at, count)
        if pinch(hand, body, at, count, scale.skin):
            _, count = settle_and_look(hand, body, at, count, scale, False)
            stall(hand, body, at, count, scale.skin)
            hand = as_halted(hand, s[ARM])
            last = travel_end(hand, s[TIME], s[RIGHT], s[LEFT], at.links)
            continue
        h, proposal, over = _ahead(hand, body, at, count, scale, speed, h, last - s[TIME])
        part = _cut(hand, body, at, count, scale, h, over)
        go_on(at, h, part, last)
        s[KEPT], before = 1.0 if part == 1.0 and over == 7 else 0.0, count
        least, count = look_again(hand, body, at, count, scale, speed > 0.0 and at.pivot[0] == 0.0, part < 1.0)
        s[KEPT] *= 1.0 if count == before else 0.0
        h = proposal if s[KEPT] > 0.0 else AFRESH * max(min(proposal, h), FIRST_STRIDE)
        if least <= -body.width:  # a link is inside: never go on from there
            s[FLAGS] = int(s[FLAGS]) | UNSOLVED
            return False, branches
    return False, branches


@compiled
def judge(hand: HandMotion, body: Body, at: Bench, scale: Scale) -> int:
    """The outcome at the state: what a wall does is no part of the hold."""
    s, hand = at.state, as_halted(hand, at.state[ARM])
    _, count = look(hand, body, at, scale, 50.0 * scale.touch)
    write_contacts(hand, body, at, count, scale.skin, s[TIME], s[RIGHT], s[LEFT], s[X], s[Y], s[THETA])
    stalls, own = (1 if s[RIGHT] != MOVING else 0) + (1 if s[LEFT] != MOVING else 0), without_wall(hand, at, count)
    if own < count and own > 0 and stalls == 1:  # wedged between a finger and the wall
        stalls = 2
    note(at, ENDS, 0)
    slack = closing_end.PINCHED_SLACK if s[PINCHED] > 0.0 else closing_end.SLACK
    return closing_end.verdict(
        at.links, len(hand.links), at.contacts, own, s[X], s[Y], body.width, body.reach, s[TOUCHED] > 0.0, stalls, slack
    )


@compiled
def carry_on(
    hand: HandMotion, body: Body, at: Bench, x: float, y: float, theta: float, tolerance: float, most_steps: int
) -> End:
    """``carry`` on a given bench; ``at.log`` holds the events of the branch that was followed last.

    A disk to the left takes the way of its mirror image, so that mirror symmetry is exact.
    """
    round_surface = body.surface.kind == UNIFORM_DISK or body.surface.kind == ELLIPSOID
    if not (len(body.vertices) == 1 and round_surface and x < 0.0 and hand.vx == 0.0 and hand.mirrored):
        return _carry(hand, body, at, x, y, theta, tolerance, most_steps)
    end = _carry(hand, body, at, -x, y, -theta, tolerance, most_steps)
    mirror_log(hand, at)
    return End(end.code, -end.x, end.y, -end.theta, end.left, end.right, end.flags, end.halt)


@compiled
def _carry(
    hand: HandMotion, body: Body, at: Bench, x: float, y: float, theta: float, tolerance: float, most_steps: int
) -> End:
    """Follow the motion and its alternatives; the first end that is not caught counts, else the first."""
    s, scale = at.state, scale_of(hand.links.sum(), body, tolerance)
    s[:] = 0.0
    at.modes[:] = 0
    s[X], s[Y], s[THETA], s[TIME], s[RIGHT], s[LEFT], s[ARM] = x, y, theta, hand.first, MOVING, MOVING, MOVING
    gap, _ = look(hand, body, at, scale, scale.touch)
    first = hand.first
    if not (isfinite(x) and isfinite(y) and isfinite(theta)) or gap < -2.0 * scale.skin - 1e-9 * body.reach:
        return End(INVALID, x, y, theta, first, first, 0, MOVING)
    worst, waiting, flags = End(-1, x, y, theta, first, first, 0, MOVING), 0, 0
    while True:
        ended, waiting = follow(hand, body, at, scale, most_steps, waiting)
        code = judge(hand, body, at, scale) if ended else UNDECIDED
        flags |= int(s[FLAGS])
        if worst.code < 0 or (worst.code <= closing_end.CAGED and code > closing_end.CAGED):
            right = s[TIME] if s[RIGHT] == MOVING else s[RIGHT]
            left = s[TIME] if s[LEFT] == MOVING else s[LEFT]
            worst = End(code, s[X], s[Y], s[THETA], right, left, 0, s[ARM])
        if waiting == 0:
            return End(worst.code, worst.x, worst.y, worst.theta, worst.right, worst.left, flags, worst.halt)
        waiting -= 1
        for k in range(STATE_WIDTH):
            s[k] = at.branches[waiting, k]


def carry(
    hand: HandMotion, body: Body, x: float, y: float, theta: float = 0.0,
    tolerance: float = TOLERANCE, most_steps: int = MOST_STEPS, events: int = 0,
) -> tuple[End, Floats]:  # fmt: skip
    """Carry the object from a start to the end of the motion; also its first ``events`` events, (E, 3)."""
    at = bench(events)
    end = carry_on(hand, body, at, float(x), float(y), float(theta), tolerance, most_steps)
    return End(*end), at.log[: int(at.state[LOGGED])].copy()


@compiled_to_allocate
def carry_rows(
    hand: HandMotion, body: Body, starts: Floats, tolerance: float, most_steps: int,
    codes: NDArray[np.int8], ends: Floats, flags: NDArray[np.int8], halts: Floats,
) -> None:  # fmt: skip
    """``carry`` for each row of ``starts`` (N, 3) on one bench; ``ends`` (N, 5) = x, y, theta, right, left."""
    at = bench(0)
    for k in range(len(starts)):
        end = carry_on(hand, body, at, starts[k, 0], starts[k, 1], starts[k, 2], tolerance, most_steps)
        codes[k], flags[k], halts[k] = end.code, end.flags, end.halt
        ends[k, 0], ends[k, 1], ends[k, 2] = end.x, end.y, end.theta
        ends[k, 3], ends[k, 4] = end.right, end.left


def carry_all(
    hand: HandMotion, body: Body, starts: Floats,
    tolerance: float = TOLERANCE, most_steps: int = MOST_STEPS, threads: int | None = None,
) -> tuple[NDArray[np.int8], Floats, NDArray[np.int8]]:  # fmt: skip
    """Batch: ``starts`` (N, 3) or (N, 2) -> outcome codes (N,), ends (N, 5) = x, y, theta, right, left, flags (N,).

    Rows are independent: ``threads`` do not matter. Where MANY_STARTS are asked, single contacts are looked up.
    """
    return carry_halting(hand, body, starts, tolerance, most_steps, threads)[:3]


def carry_halting(
    hand: HandMotion, body: Body, starts: Floats,
    tolerance: float = TOLERANCE, most_steps: int = MOST_STEPS, threads: int | None = None,
) -> tuple[NDArray[np.int8], Floats, NDArray[np.int8], Floats]:  # fmt: skip
    """As ``carry_all``, with the times (N,) at which the arm was halted before a wall, or MOVING."""
    body = tabulated(body) if len(starts) >= MANY_STARTS and tolerance >= BATCH_TOLERANCE else body
    rows = np.zeros((len(starts), 3))
    rows[:, : starts.shape[1]] = starts
    codes, flags = np.zeros(len(rows), np.int8), np.zeros(len(rows), np.int8)
    ends, halts = np.zeros((len(rows), 5)), np.zeros(len(rows))

    def part(some: slice) -> None:
        carry_rows(hand, body, rows[some], tolerance, most_steps, codes[some], ends[some], flags[some], halts[some])

    in_parts(part, len(rows), ROWS_PER_TASK, threads)
    return codes, ends, flags, halts
