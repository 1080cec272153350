"""The twist of an object on a table at one moment of a closing motion, from the contacts that touch.

``solve_motion`` tries every mode of every contact and finds all admissible motions. Within a step the mode rarely
changes, so ``continued_twist`` first tries Newton's method in the mode of the last motion alone and checks that what it
finds is admissible; only where it is not are all modes tried again.

A limit surface turns with its object: contacts are written, and motions solved, along the object's axes; motions come
back along the table's.
"""

from __future__ import annotations

from math import cos, inf, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.compiled import compiled
from palmar.mechanics.pushing.contact_solve import (
    CONTACT_WIDTH,
    MOST_CONTACTS,
    Workspace,
    _fill_rows,
    _keeps_clear,
    _try_edges,
    workspace,
)
from palmar.mechanics.pushing.hand_pose import LINK_WIDTH, MOST_LINKS, HandMotion, place_links
from palmar.mechanics.pushing.limit_surface import ELLIPSOID, UNIFORM_DISK, tangent_metric
from palmar.mechanics.pushing.metric import Triple, inverse, squared
from palmar.mechanics.pushing.motion_solve import NEWTON_CHANGE, solve_motion, start_metric
from palmar.mechanics.pushing.polygon_contacts import MOST_ACTIVE, SKIN, Body, write_contact

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
PASSES = 8
NONE = -2
CLEAR = 1e-8
TOUCH = 2e-8
"""Gaps up to this part of the finger's length touch."""
STATE_WIDTH, MOST_BRANCHES = 16, 8
X, Y, THETA, TIME, RIGHT, LEFT, VX, VY, OMEGA, TOUCHED, DEPTH, SEVERAL, FENCE, FLAGS, LOGGED, KINK = range(16)
"""Entries of a state: pose, time, stall angles (or MOVING), last twist, whether a finger has touched it, number of
alternatives taken, whether those here are noted, time at which no motion is admissible, flags, number of events,
time by which a contact begins or ends to slide."""


class Scale(NamedTuple):
    """Lengths (m): skin of line links against polygons, gap that touches, error allowed per stride."""

    skin: float
    touch: float
    error: float


@compiled
def scale_of(hand: HandMotion, body: Body, tolerance: float) -> Scale:
    """The kernel's small lengths."""
    length = hand.links.sum()
    return Scale(SKIN * length if body.radius == 0.0 else 0.0, TOUCH * length, tolerance * length)


class Bench(NamedTuple):
    """Everything that a start's way through the motion writes to: one per start, no allocation after it.

    ``loads`` (per active contact: normal and tangential) and ``edges`` belong to the last motion found; ``modes`` is one
    for each link; ``stages`` are the twists of one step, ``trial`` the pose and time that a stage failed at; ``branches``
    are the alternatives still to be followed; ``log`` the events; ``frame`` cosine and sine of the axes that the contacts
    are written along.
    """

    links: Floats
    active: Integers
    sides: Floats
    found: Integers
    contacts: Floats
    gaps: Floats
    loads: Floats
    edges: Integers
    modes: Integers
    stages: Floats
    state: Floats
    trial: Floats
    branches: Floats
    log: Floats
    frame: Floats
    space: Workspace


@compiled
def bench(events: int) -> Bench:
    """A fresh bench with room for so many events."""
    return Bench(
        np.zeros((2 * MOST_LINKS + 1, LINK_WIDTH)),
        np.zeros(MOST_ACTIVE, np.int64),
        np.zeros(MOST_ACTIVE),
        np.zeros(MOST_ACTIVE, np.int64),
        np.zeros((MOST_ACTIVE, CONTACT_WIDTH)),
        np.zeros(MOST_ACTIVE),
        np.zeros((MOST_ACTIVE, 2)),
        np.full(3, NONE),
        np.zeros(2 * MOST_LINKS + 1, np.int64),
        np.zeros((7, 3)),
        np.zeros(STATE_WIDTH),
        np.zeros(4),
        np.zeros((MOST_BRANCHES, STATE_WIDTH)),
        np.zeros((events, 3)),
        np.zeros(2),
        workspace(),
    )


@compiled
def write_contacts(
    hand: HandMotion, body: Body, at: Bench, count: int, skin: float,
    time: float, right: float, left: float, x: float, y: float, theta: float,
) -> float:  # fmt: skip
    """Place the links, write the active contacts' rows and gaps, and return the largest speed of the hand at any of them."""
    place_links(hand, time, right, left, at.links)
    speed = 0.0
    for k in range(count):
        row = at.contacts[k]
        at.gaps[k] = write_contact(body, at.links, skin, at.active[k], at.sides[k], x, y, theta, row)
        speed = max(speed, abs(row[4]) + abs(row[5]))
    _turn_rows(body, at, count, theta)
    return speed


@compiled
def _turn_rows(body: Body, at: Bench, count: int, theta: float) -> None:
    """Write the contacts along the object's axes, unless its limit surface is round."""
    at.frame[0], at.frame[1] = 1.0, 0.0
    if body.surface.kind == UNIFORM_DISK or body.surface.kind == ELLIPSOID:
        return
    at.frame[0], at.frame[1] = cos(theta), sin(theta)
    for k in range(count):
        row = at.contacts[k]
        for pair in range(0, 6, 2):
            row[pair], row[pair + 1] = to_object(at, row[pair], row[pair + 1])


@compiled
def to_object(at: Bench, x: float, y: float) -> tuple[float, float]:
    """A vector along the table's axes -> along those of the contacts written."""
    c, s = at.frame[0], at.frame[1]
    return c * x + s * y, c * y - s * x


@compiled
def _to_table(at: Bench, row: Floats) -> None:
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
        _to_table(at, motions[m])
    return number


@compiled
def _note_edges(at: Bench, count: int) -> None:
    """The edges of the friction cones that carry the last motion; the first NONE if there are more than three."""
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
                at.edges[:] = NONE
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
                triple[0, :], triple[1, :], triple[2, :] = at.contacts[i], at.contacts[j], at.contacts[k]
                found = solve_motion(body.surface, triple, 3, guess, at.space)
                for m in range(found):
                    row = at.space.motions[m]
                    x, y, w = row[0], row[1], row[2]
                    slack = CLEAR * (abs(x) + abs(y) + abs(w) * body.reach + abs(guess[0]) + abs(guess[1]))
                    if not _keeps_clear(at.contacts, count, x, y, w, slack):
                        continue
                    apart = squared(start_metric(body.surface), x - guess[0], y - guess[1], w - guess[2])
                    number = max(number, 1)
                    if apart < best:
                        best, answer, chosen = apart, (x, y, w), (i, j, k)
                        loads = ((row[3], row[4]), (row[5], row[6]), (row[7], row[8]))
    for m in range(3):
        if number > 0:
            at.loads[chosen[m], 0], at.loads[chosen[m], 1] = loads[m]
    at.edges[:] = NONE
    at.space.motions[0, 0], at.space.motions[0, 1], at.space.motions[0, 2] = answer
    return number


@compiled
def continued_twist(body: Body, at: Bench, count: int, speed: float, guess: Triple) -> int:
    """As ``full_twist`` but only one motion, in the mode of the last one where that is admissible."""
    if speed == 0.0 or count > MOST_CONTACTS or at.edges[0] == NONE:
        return full_twist(body, at, count, speed, guess)
    x, y = to_object(at, guess[0], guess[1])
    w = guess[2]
    a, b, c = at.edges[0], at.edges[1], at.edges[2]
    if body.surface.kind != ELLIPSOID and x == 0.0 and y == 0.0 and w == 0.0:
        return full_twist(body, at, count, speed, guess)
    for _ in range(PASSES):
        metric = tangent_metric(body.surface, x, y, w)
        most = _fill_rows(inverse(metric), at.contacts, count, at.space.rows)
        if _try_edges(metric, at.contacts, count, at.space.motions, at.space.rows, 0, most, a, b, c) == 0:
            break
        row = at.space.motions[0]
        change = squared(metric, row[0] - x, row[1] - y, row[2] - w)
        x, y, w = row[0], row[1], row[2]
        if change <= NEWTON_CHANGE * NEWTON_CHANGE * squared(metric, x, y, w):
            for k in range(count):
                at.loads[k, 0], at.loads[k, 1] = row[3 + 2 * k], row[4 + 2 * k]
            _to_table(at, row)
            return 1
    return full_twist(body, at, count, speed, guess)
