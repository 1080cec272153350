"""The twist of an object on a table at one moment of a closing motion, from the contacts that touch.

``solve_motion`` tries every mode of every contact and finds all admissible motions. Within a step the mode stays
the same, so ``mode_twist`` uses Newton's method in the mode of the last motion alone, and says how far the motion found
is from being inadmissible; where it becomes so, all modes are tried again. ``closing_next`` says where that can be spared.
A limit surface turns with its object: contacts are written, and motions solved, along the object's axes, not the table's.
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled, compiled_to_allocate, inlined
from palmar.mechanics.pushing.contact_solve import (
    CONTACT_WIDTH,
    MOST_CONTACTS,
    Workspace,
    fill_rows,
    keeps_clear,
    margin_left,
    workspace,
)
from palmar.mechanics.pushing.edge_loads import edge_loads, edges_twist
from palmar.mechanics.pushing.hand_pose import LINK_WIDTH, MOST_ROWS, HandMotion, place_links
from palmar.mechanics.pushing.limit_surface import ELLIPSOID, UNIFORM_DISK, tangent_metric
from palmar.mechanics.pushing.metric import Triple, inverse, squared
from palmar.mechanics.pushing.motion_solve import solve_motion, start_metric
from palmar.mechanics.pushing.polygon_contacts import MOST_ACTIVE, Body, write_contact

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
PASSES = 8
LAST_CHANGE = 2e-5
"""Relative change of the motion at which Newton's pass, of quadratic convergence, is the last in a known mode."""
REST, LOOSE, SOON = 5e-9, 0.2, 0.1
"""A pass is also the last if the next one would change the motion by less than REST, LOOSE tolerances for a stage: a change
e announces C e^2, with the largest C = e' / e^2, doubled, of all pairs of passes in the mode that began with e < SOON."""
UNKNOWN = -1.0
NONE, MANY = -2, -3
"""In place of an edge: no load; the loads are on more than three edges, or not known."""
CLEAR = 1e-8
STATE_WIDTH, MOST_BRANCHES = 17, 8
X, Y, THETA, TIME, RIGHT, LEFT, VX, VY, OMEGA, TOUCHED, DEPTH, SEVERAL, FLAGS, LOGGED, PINCHED, KEPT, ARM = range(17)
"""Entries of a state: pose, time, stall angles (or MOVING), last twist, whether a finger has touched it, number of
alternatives taken, whether those here are noted, flags, number of events, whether it was pinched without friction,
whether the contacts are those of the last motion, when the arm was halted (or MOVING)."""


class Bench(NamedTuple):
    """Everything that a start's way through the motion writes to: one per start, no allocation after it.

    ``apart`` is each link's least gap but for its active contacts at the state, or less. ``loads`` (per active contact:
    normal and tangential) and ``edges`` belong to the last motion found; ``modes`` is one for each link; ``stages`` are
    the twists and margins of one stride, ``course`` its way between (``closing_course``), ``trend`` the rate of the twist
    at the state as far as known; ``pivot`` (on, x, y, rate) is what the object turns about where it turns with a link;
    ``branches`` are the alternatives still to be followed; ``log`` the events; ``frame`` cosine and sine of the axes that
    the contacts are written along, squares of how Newton's passes converge (UNKNOWN below 0) and of what they leave.
    """

    links: Floats
    active: Integers
    sides: Floats
    found: Integers
    apart: Floats
    contacts: Floats
    gaps: Floats
    loads: Floats
    edges: Integers
    modes: Integers
    stages: Floats
    course: Floats
    trend: Floats
    state: Floats
    pivot: Floats
    branches: Floats
    log: Floats
    frame: Floats
    space: Workspace


@compiled_to_allocate
def bench(events: int) -> Bench:
    """A fresh bench with room for so many events."""
    return Bench(
        np.zeros((MOST_ROWS, LINK_WIDTH)),
        np.zeros(MOST_ACTIVE, np.int64),
        np.zeros(MOST_ACTIVE),
        np.zeros(MOST_ACTIVE, np.int64),
        np.zeros(MOST_ROWS),
        np.zeros((MOST_ACTIVE, CONTACT_WIDTH)),
        np.zeros(MOST_ACTIVE),
        np.zeros((MOST_ACTIVE, 2)),
        np.full(3, NONE),
        np.zeros(MOST_ROWS, np.int64),
        np.zeros((7, 4)),
        np.zeros((4, 3)),
        np.zeros(3),
        np.zeros(STATE_WIDTH),
        np.zeros(4),
        np.zeros((MOST_BRANCHES, STATE_WIDTH)),
        np.zeros((events, 3)),
        np.zeros(4),
        workspace(),
    )


@inlined
def write_contacts(
    hand: HandMotion, body: Body, at: Bench, count: int, skin: float,
    time: float, right: float, left: float, x: float, y: float, theta: float,
) -> float:  # fmt: skip
    """Place the links, write the active contacts' rows and gaps, and return the largest speed of the hand at any of them."""
    place_links(hand, time, right, left, at.links)
    speed = 0.0
    c, s = cosine_sine(theta)
    turned = body.surface.kind != UNIFORM_DISK and body.surface.kind != ELLIPSOID
    at.frame[0], at.frame[1] = (c, s) if turned else (1.0, 0.0)
    for k in range(count):
        row = at.contacts[k]
        at.gaps[k] = write_contact(body, at.links, skin, at.active[k], at.sides[k], x, y, c, s, row)
        speed = max(speed, abs(row[4]) + abs(row[5]))
        if turned:
            row[0], row[1] = to_object(at, row[0], row[1])
            row[2], row[3] = to_object(at, row[2], row[3])
            row[4], row[5] = to_object(at, row[4], row[5])
    return speed


@inlined
def to_object(at: Bench, x: float, y: float) -> tuple[float, float]:
    """A vector along the table's axes -> along those of the contacts written."""
    c, s = at.frame[0], at.frame[1]
    return c * x + s * y, c * y - s * x


@inlined
def to_table(at: Bench, row: Floats) -> None:
    """The first two entries of a motion -> along the table's axes."""
    c, s, x, y = at.frame[0], at.frame[1], row[0], row[1]
    row[0], row[1] = c * x - s * y, s * x + c * y


@compiled
def full_twist(body: Body, at: Bench, count: int, speed: float, guess: Triple) -> int:
    """All admissible motions at the contacts written, the first in ``at.space.motions[0]``; returns their number.

    JAMMED (0) or NOT_CONVERGED (-1) as ``solve_motion``. Contacts beyond four are dealt with three at a time: any
    admissible motion has loads on at most three edges.
    """
    motions = at.space.motions
    for k in range(count):
        at.loads[k, 0], at.loads[k, 1] = 0.0, 0.0
    if speed == 0.0:
        motions[0, :] = 0.0
        at.edges[:] = NONE
        return 1
    gx, gy = to_object(at, guess[0], guess[1])
    if count > MOST_CONTACTS:
        number = _by_threes(body, at, count, (gx, gy, guess[2]))
    else:
        number = solve_motion(body.surface, at.contacts, count, (gx, gy, guess[2]), at.space)
        if number > 0:
            for k in range(count):
                at.loads[k, 0], at.loads[k, 1] = motions[0, 3 + 2 * k], motions[0, 4 + 2 * k]
            _note_edges(at, count)
    for m in range(number):
        to_table(at, motions[m])
    return number


@compiled
def _note_edges(at: Bench, count: int) -> None:
    """The edges of the friction cones that carry the last motion; the first MANY if there are more than three."""
    at.edges[:] = NONE
    number = 0
    for k in range(count):
        normal, tangent = at.loads[k, 0], at.loads[k, 1]
        if normal <= 0.0:
            continue
        bound = at.contacts[k, 6] * normal
        for side in range(2):
            lost = bound - tangent if side == 1 else bound + tangent
            if (side == 1 and at.contacts[k, 6] == 0.0) or (lost <= 1e-9 * bound and at.contacts[k, 6] > 0.0):
                continue
            if number == 3:
                at.edges[0] = MANY
                return
            at.edges[number] = 2 * k + side
            number += 1


@compiled
def _by_threes(body: Body, at: Bench, count: int, guess: Triple) -> int:
    """The motions at more than four contacts: those of every three that keep clear of the rest; the nearest first."""
    best, answer, number = inf, (0.0, 0.0, 0.0), 0
    chosen = (0, 1, 2)
    loads = ((0.0, 0.0), (0.0, 0.0), (0.0, 0.0))
    for i in range(count):
        for j in range(i + 1, count):
            for k in range(j + 1, count):
                triple = at.space.contacts
                for c in range(CONTACT_WIDTH):
                    triple[0, c], triple[1, c], triple[2, c] = at.contacts[i, c], at.contacts[j, c], at.contacts[k, c]
                found = solve_motion(body.surface, triple, 3, guess, at.space)
                for m in range(found):
                    row = at.space.motions[m]
                    x, y, w = row[0], row[1], row[2]
                    slack = CLEAR * (abs(x) + abs(y) + abs(w) * body.reach + abs(guess[0]) + abs(guess[1]))
                    if not keeps_clear(at.contacts, count, x, y, w, slack):
                        continue
                    apart = squared(start_metric(body.surface), x - guess[0], y - guess[1], w - guess[2])
                    number = max(number, 1)
                    if apart < best:
                        best, answer, chosen = apart, (x, y, w), (i, j, k)
                        loads = ((row[3], row[4]), (row[5], row[6]), (row[7], row[8]))
    for m in range(3):
        if number > 0:
            at.loads[chosen[m], 0], at.loads[chosen[m], 1] = loads[m]
    at.edges[0] = MANY
    at.space.motions[0, 0], at.space.motions[0, 1], at.space.motions[0, 2] = answer
    return number


@inlined
def mode_twist(body: Body, at: Bench, count: int, speed: float, guess: Triple) -> tuple[bool, float]:
    """The motion at the contacts written in the mode of ``at.edges``, in ``at.space.motions[0]``, admissible or not.

    Returns (whether there is one, how far it is from being inadmissible, see ``margin_left``). Where no mode of up to
    three edges is known, the first of all admissible motions, with margin 1.
    """
    motion, contacts, rows = at.space.motions[0], at.contacts, at.space.rows
    x, y = to_object(at, guess[0], guess[1])
    w = guess[2]
    a, b, c = at.edges[0], at.edges[1], at.edges[2]
    before = inf
    if a == MANY:
        return full_twist(body, at, count, speed, guess) > 0, 1.0
    if a == NONE:
        motion[0], motion[1], motion[2] = 0.0, 0.0, 0.0
        return True, _rate_at_rest(contacts, count, speed)
    for _ in range(PASSES):
        metric = tangent_metric(body.surface, x, y, w)
        fill_rows(inverse(metric), contacts, count, rows)
        regular, la, lb, lc = edge_loads(contacts, rows, a, b, c)
        nx, ny, nw = edges_twist(contacts, rows, a, b, c, la, lb, lc)
        change = squared(metric, nx - x, ny - y, nw - w)
        x, y, w = nx, ny, nw
        here = change / squared(metric, x, y, w)
        if before < SOON * SOON:
            at.frame[2] = max(at.frame[2], 4.0 * here / (before * before))
        known, before = at.frame[2] >= 0.0 and here < SOON * SOON, here
        if regular and (here <= LAST_CHANGE * LAST_CHANGE or (known and at.frame[2] * here * here <= at.frame[3])):
            _write_loads(at, count, a, b, c, la, lb, lc)
            motion[0], motion[1], motion[2] = x, y, w
            to_table(at, motion)
            return True, margin_left(contacts, count, rows, speed, a, b, c, la, lb, lc, x, y, w)
    return False, -1.0


@inlined
def _rate_at_rest(contacts: Floats, count: int, speed: float) -> float:
    """Least rate at which a gap opens if the object rests, over the hand's speed."""
    least = 1.0
    for i in range(count):
        row = contacts[i]
        least = min(least, -(row[2] * row[4] + row[3] * row[5]) / speed if speed > 0.0 else 0.0)
    return least


@inlined
def _write_loads(at: Bench, count: int, a: int, b: int, c: int, la: float, lb: float, lc: float) -> None:
    """The contacts' loads from those on the edges of their cones."""
    for k in range(count):
        at.loads[k, 0], at.loads[k, 1] = 0.0, 0.0
    for edge, load in ((a, la), (b, lb), (c, lc)):
        if edge >= 0:
            lean = at.contacts[edge // 2, 6]
            at.loads[edge // 2, 0] += load
            at.loads[edge // 2, 1] += load * (lean if edge % 2 == 0 else -lean)
