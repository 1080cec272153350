"""Coulomb contacts with stick and slide on an ellipsoidal limit surface, solved exactly by enumeration.

The object's twist nu about the reference point and the contact loads f_i satisfy, for a metric B,

    B nu = sum J_i^T f_i,        gap rate g_i = n_i . (v(r_i) - u_i) >= 0,  normal load >= 0,  one of them 0,
    |tangential load| <= mu_i normal load, and equal and against the slip where there is slip.

The cone of loads of contact i is spanned by two edges, n + mu t and n - mu t. Every admissible B nu lies in the cone
of at most three independent edges of all contacts (Caratheodory), so trying all sets of up to three edges finds every
isolated motion, also where the loads themselves are not unique (an edge of the object flush on a link): both edges of a
contact mean that it sticks, one that it slides (or is about to), none that it carries nothing. Each set is a linear
system of order 3 or less. Up to four contacts give at most 92 sets.

Only contacts that touch are passed in. A contact that is near but open is left out: a gap must never carry load.
"""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, compiled_to_allocate, inlined
from palmar.mechanics.pushing.edge_loads import edges_twist, fill_entries, known_loads, lean_of
from palmar.mechanics.pushing.metric import Metric, inverse, squared, times

Floats = NDArray[np.float64]
MOST_CONTACTS = 4
MOST_MOTIONS = 8
CONTACT_WIDTH = 7
"""A contact is a row (rx, ry, nx, ny, ux, uy, mu): where it touches from the reference point (m), the unit normal into
the object, the velocity of the hand's material point there, the friction."""
MOTION_WIDTH = 3 + 2 * MOST_CONTACTS
"""A motion is a row (vx, vy, omega, then normal and tangential load of each contact); tangent = normal turned left."""
TIGHT = 1e-9
"""Speeds below this part of the largest, and loads below this part of their sum, count as zero."""
SAME = 1e-6
"""Motions nearer to each other than this part of the hand's speed are one motion."""


def _edge_sets() -> NDArray[np.int64]:
    """All sets of one to three of the eight edges, ascending and padded with NONE, few contacts first."""
    edges = range(2 * MOST_CONTACTS)
    sets = [each for size in (1, 2, 3) for each in combinations(edges, size)]
    sets.sort(key=lambda each: (each[-1] // 2, len(each), each))
    return np.array([each + (NONE,) * (3 - len(each)) for each in sets])


NONE = -2
EDGE_SETS = _edge_sets()
SETS_UP_TO = np.array([np.count_nonzero(EDGE_SETS.max(axis=1) < 2 * m) for m in range(MOST_CONTACTS + 1)])


class Workspace(NamedTuple):
    """Arrays that the solvers write to: one per thread, from ``workspace``; ``motions`` holds the answer."""

    motions: Floats
    trial: Floats
    candidates: Floats
    rows: Floats
    contacts: Floats


@compiled_to_allocate
def workspace() -> Workspace:
    """A fresh workspace."""
    shape = (MOST_MOTIONS, MOTION_WIDTH)
    rows, contacts = np.zeros((2 * MOST_CONTACTS, 7 + 2 * MOST_CONTACTS)), np.zeros((MOST_CONTACTS, CONTACT_WIDTH))
    return Workspace(np.zeros(shape), np.zeros(shape), np.zeros(shape), rows, contacts)


@compiled
def solve_contacts(metric: Metric, contacts: Floats, count: int, motions: Floats, rows: Floats) -> int:
    """Write every admissible motion into ``motions`` and return their number; 0: the object is jammed.

    ``contacts`` (>= count, 7), ``motions`` (8, 11) and ``rows`` (8, 15), the latter for scratch. Loads balance
    B nu. More than eight motions are not recorded (none have been met).
    """
    speed = fill_rows(inverse(metric), contacts, count, rows)
    fill_entries(contacts, count, rows)
    found = 0
    if keeps_clear(contacts, count, 0.0, 0.0, 0.0, TIGHT * speed):
        found = _record(metric, 0.0, 0.0, 0.0, speed, motions, found)
    for k in range(SETS_UP_TO[count]):
        a, b, c = EDGE_SETS[k]
        if not (_is_double(contacts, a) or _is_double(contacts, b) or _is_double(contacts, c)):
            found = _try_edges(metric, contacts, count, motions, rows, found, speed, a, b, c)
    return found


@inlined
def _is_double(contacts: Floats, edge: int) -> bool:
    """Whether it is the second edge of a contact without friction, whose cone has only one."""
    return edge % 2 == 1 and contacts[edge // 2, 6] == 0.0


@inlined
def fill_rows(mobility: Metric, contacts: Floats, count: int, rows: Floats) -> float:
    """Per contact a normal and a tangential row: Jacobian (3), mobility times it (3), the hand's speed along it.

    Returns the largest speed of the hand.
    """
    speed = 0.0
    for i in range(count):
        rx, ry, ux, uy = contacts[i, 0], contacts[i, 1], contacts[i, 4], contacts[i, 5]
        speed = max(speed, abs(ux) + abs(uy))
        for side in range(2):
            dx, dy = (contacts[i, 2], contacts[i, 3]) if side == 0 else (-contacts[i, 3], contacts[i, 2])
            lever = rx * dy - ry * dx
            row = rows[2 * i + side]
            row[0], row[1], row[2] = dx, dy, lever
            row[3], row[4], row[5] = times(mobility, dx, dy, lever)
            row[6] = dx * ux + dy * uy
    return speed


@inlined
def is_admissible(
    contacts: Floats, count: int, rows: Floats, speed: float,
    a: int, b: int, c: int, x: float, y: float, w: float,
) -> bool:  # fmt: skip
    """Whether a twist with loads on these edges closes no gap, and slips against the load where an edge is alone."""
    slack = TIGHT * (speed + abs(x) + abs(y) + abs(w) * _reach(contacts, count))
    if not keeps_clear(contacts, count, x, y, w, slack):
        return False
    for edge in (a, b, c):
        if edge < 0:
            continue
        other = edge + 1 if edge % 2 == 0 else edge - 1
        row = rows[edge // 2 * 2 + 1]
        slip = row[0] * x + row[1] * y + row[2] * w - row[6]
        alone = other not in (a, b, c)
        if alone and contacts[edge // 2, 6] > 0.0 and (slip if edge % 2 == 0 else -slip) > slack:
            return False
    return True


@inlined
def margin_left(
    contacts: Floats, count: int, rows: Floats, speed: float,
    a: int, b: int, c: int, la: float, lb: float, lc: float, x: float, y: float, w: float,
) -> float:  # fmt: skip
    """How far the mode with loads on these edges is from being inadmissible; of order 1, below zero past that point.

    A load l counts as 2 l / (1 + l^2), which changes its sign where the load does: at zero and at a pole, a jam.
    """
    margin = signed(la)
    if b >= 0:
        margin = min(margin, signed(lb))
    if c >= 0:
        margin = min(margin, signed(lc))
    scale = 1.0 / (speed + abs(x) + abs(y) + abs(w) * _reach(contacts, count))
    for i in range(count):
        if a // 2 != i and b // 2 != i and c // 2 != i:
            dx, dy = x - w * contacts[i, 1] - contacts[i, 4], y + w * contacts[i, 0] - contacts[i, 5]
            margin = min(margin, scale * (contacts[i, 2] * dx + contacts[i, 3] * dy))
    for edge in (a, b, c):
        other = edge + 1 if edge % 2 == 0 else edge - 1
        if edge >= 0 and other != a and other != b and other != c and contacts[edge // 2, 6] > 0.0:
            row = rows[edge // 2 * 2 + 1]
            slip = row[0] * x + row[1] * y + row[2] * w - row[6]
            margin = min(margin, scale * (-slip if edge % 2 == 0 else slip))
    return margin


@inlined
def signed(load: float) -> float:
    """A load, bounded: see ``margin_left``."""
    return 2.0 * load / (1.0 + load * load)


@inlined
def _try_edges(
    metric: Metric, contacts: Floats, count: int, motions: Floats, rows: Floats, found: int, speed: float,
    a: int, b: int, c: int,
) -> int:  # fmt: skip
    """Record the motion with loads on these edges if it is admissible; returns how many motions there are now."""
    regular, la, lb, lc = known_loads(rows, a, b, c)
    least = -TIGHT * (abs(la) + abs(lb) + abs(lc))
    if not (regular and la >= least and lb >= least and lc >= least):
        return found
    x, y, w = edges_twist(contacts, rows, a, b, c, la, lb, lc)
    if not is_admissible(contacts, count, rows, speed, a, b, c, x, y, w):
        return found
    after = _record(metric, x, y, w, speed, motions, found)
    if after > found:
        for edge, load in ((a, la), (b, lb), (c, lc)):
            if edge >= 0:
                motions[found, 3 + edge // 2 * 2] += load
                motions[found, 4 + edge // 2 * 2] += load * lean_of(contacts, edge)
    return after


@inlined
def _reach(contacts: Floats, count: int) -> float:
    reach = 0.0
    for i in range(count):
        reach = max(reach, abs(contacts[i, 0]) + abs(contacts[i, 1]))
    return reach


@inlined
def keeps_clear(contacts: Floats, count: int, x: float, y: float, w: float, slack: float) -> bool:
    """Whether no gap closes faster than ``slack`` under the twist (x, y, w)."""
    for i in range(count):
        dx, dy = x - w * contacts[i, 1] - contacts[i, 4], y + w * contacts[i, 0] - contacts[i, 5]
        if contacts[i, 2] * dx + contacts[i, 3] * dy < -slack:
            return False
    return True


@compiled
def copy_motion(source: Floats, source_row: int, target: Floats, target_row: int) -> None:
    """Copy one motion."""
    for k in range(MOTION_WIDTH):
        target[target_row, k] = source[source_row, k]


@inlined
def _record(metric: Metric, x: float, y: float, w: float, speed: float, motions: Floats, found: int) -> int:
    """Append the motion without loads unless it is known already or there is no room."""
    if found == MOST_MOTIONS:
        return found
    limit = SAME * SAME * 0.5 * (metric[0] + metric[2]) * speed * speed
    for k in range(found):
        if squared(metric, motions[k, 0] - x, motions[k, 1] - y, motions[k, 2] - w) <= limit:
            return found
    for k in range(3, MOTION_WIDTH):
        motions[found, k] = 0.0
    motions[found, 0], motions[found, 1], motions[found, 2] = x, y, w
    return found + 1
