"""What a closing motion has come to: the object held, caged or lost, judged from the final contacts and links.

- structural: the contact normals positively span the plane, so no translation is free, whatever the friction;
- frictional: a finger has stalled, and forces inside the friction cones balance with no load from outside, so that a
  greater squeeze meets greater loads (the two cones of a pair see each other, or four edges of cones balance);
- caged: the reference point lies in the pocket of palm and fingers, and the opening at the tips is narrower than the
  object's least width.
"""

from __future__ import annotations

from math import hypot, inf, sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.models.outcome import Outcome

Floats = NDArray[np.float64]
STRUCTURAL, FRICTIONAL, CAGED = Outcome.STRUCTURAL.code, Outcome.FRICTIONAL.code, Outcome.CAGED.code
ESCAPED, MISSED, JAMMED = Outcome.ESCAPED.code, Outcome.MISSED.code, Outcome.JAMMED.code
SLACK = 1e-5
"""Angles (rad) and balances within this count as reached."""
PINCHED_SLACK = 1e-3
"""The same for the end of a pinch without friction, which is extrapolated."""


@compiled
def verdict(
    links: Floats, pairs: int, contacts: Floats, count: int, x: float, y: float, width: float, reach: float,
    touched: bool, stalls: int, slack: float,
) -> int:  # fmt: skip
    """Outcome code from the final ``links`` (see hand_pose), ``contacts`` (see contact_solve) and number of stalls.

    ``slack`` (rad) is that of two opposed contacts.
    """
    if touched and normals_span(contacts, count):
        return STRUCTURAL
    if stalls > 0 and forces_balance(contacts, count, reach, slack):
        return FRICTIONAL
    if in_pocket(links, pairs, x, y) and opening(links, pairs) < width:
        return CAGED
    if stalls == 2:
        return JAMMED
    return ESCAPED if touched else MISSED


@compiled
def normals_span(contacts: Floats, count: int) -> bool:
    """Whether the normals positively span the plane: none of their perpendiculars has all of them on one side."""
    if count < 3:
        return False
    for i in range(count):
        for side in (1.0, -1.0):
            dx, dy = -side * contacts[i, 3], side * contacts[i, 2]
            blocked = False
            for j in range(count):
                blocked = blocked or contacts[j, 2] * dx + contacts[j, 3] * dy < -SLACK
            if not blocked:
                return False
    return True


@compiled
def forces_balance(contacts: Floats, count: int, reach: float, slack: float) -> bool:
    """Whether loads inside the friction cones, not all zero, balance in force and moment."""
    for i in range(count):
        for j in range(i):
            if _see_each_other(contacts[i], contacts[j], slack):
                return True
    edges = 2 * count
    for a in range(edges):
        for b in range(a):
            for c in range(b):
                for d in range(c):
                    if _four_balance(contacts, a, b, c, d, reach):
                        return True
    return False


@compiled
def _see_each_other(one: Floats, other: Floats, slack: float) -> bool:
    """Whether the line between two contacts lies in both friction cones."""
    dx, dy = other[0] - one[0], other[1] - one[1]
    length = hypot(dx, dy)
    if length == 0.0:
        return False
    dx, dy = dx / length, dy / length
    lean, far = abs(one[2] * dy - one[3] * dx), abs(other[2] * dy - other[3] * dx)
    straight, back = one[2] * dx + one[3] * dy, -other[2] * dx - other[3] * dy
    return straight > 0.0 and back > 0.0 and lean <= one[6] * straight + slack and far <= other[6] * back + slack


@compiled
def _edge(contacts: Floats, edge: int, reach: float) -> tuple[float, float, float]:
    """Wrench of unit force along an edge of a cone, moment over ``reach``."""
    row = contacts[edge // 2]
    lean = row[6] if edge % 2 == 0 else -row[6]
    fx, fy = row[2] - lean * row[3], row[3] + lean * row[2]
    scale = 1.0 / sqrt(1.0 + lean * lean)
    return fx * scale, fy * scale, (row[0] * fy - row[1] * fx) * scale / reach


@compiled
def _determinant(p: tuple[float, float, float], q: tuple[float, float, float], r: tuple[float, float, float]) -> float:
    return p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0])


@compiled
def _four_balance(contacts: Floats, a: int, b: int, c: int, d: int, reach: float) -> bool:
    """Whether some positive combination of four wrenches vanishes: their cofactors share one sign."""
    p, q = _edge(contacts, a, reach), _edge(contacts, b, reach)
    r, s = _edge(contacts, c, reach), _edge(contacts, d, reach)
    w1, w2, w3, w4 = _determinant(q, r, s), -_determinant(p, r, s), _determinant(p, q, s), -_determinant(p, q, r)
    low, high = min(min(w1, w2), min(w3, w4)), max(max(w1, w2), max(w3, w4))
    return (high > 1e-3 and low >= -SLACK) or (low < -1e-3 and high <= SLACK)


@compiled
def in_pocket(links: Floats, pairs: int, x: float, y: float) -> bool:
    """Whether (x, y) lies within palm, fingers and the line between the tips: positive winding number."""
    turns = 0
    for k in range(2 * pairs + 2):
        if k <= pairs:
            ax, ay, bx, by = links[k, 0], links[k, 1], links[k, 2], links[k, 3]
        elif k == pairs + 1:
            ax, ay, bx, by = links[pairs, 2], links[pairs, 3], links[2 * pairs, 2], links[2 * pairs, 3]
        else:
            row = links[2 * pairs + 1 - (k - pairs - 1)]
            ax, ay, bx, by = row[2], row[3], row[0], row[1]
        left = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        if ay <= y < by and left > 0.0:
            turns += 1
        elif by <= y < ay and left < 0.0:
            turns -= 1
    return turns > 0


@compiled
def opening(links: Floats, pairs: int) -> float:
    """Least distance of a tip's surface from the other finger's; 0 where the fingers cross."""
    least = inf
    for i in range(1, pairs + 1):
        for j in range(pairs + 1, 2 * pairs + 1):
            if _cross(links[i], links[j]):
                return 0.0
    for k in range(1, pairs + 1):
        least = min(least, _distance(links[pairs + k], links[pairs, 2], links[pairs, 3]))
        least = min(least, _distance(links[k], links[2 * pairs, 2], links[2 * pairs, 3]))
    return least - 2.0 * links[1, 7]


@compiled
def _cross(one: Floats, other: Floats) -> bool:
    dx, dy, ex, ey = one[2] - one[0], one[3] - one[1], other[2] - other[0], other[3] - other[1]
    first = dx * (other[1] - one[1]) - dy * (other[0] - one[0])
    second = dx * (other[3] - one[1]) - dy * (other[2] - one[0])
    third = ex * (one[1] - other[1]) - ey * (one[0] - other[0])
    fourth = ex * (one[3] - other[1]) - ey * (one[2] - other[0])
    return first * second < 0.0 and third * fourth < 0.0


@compiled
def _distance(row: Floats, x: float, y: float) -> float:
    """Distance of a point from a link's segment."""
    dx, dy = row[2] - row[0], row[3] - row[1]
    t = ((x - row[0]) * dx + (y - row[1]) * dy) / (dx * dx + dy * dy)
    t = min(max(t, 0.0), 1.0)
    return hypot(x - row[0] - t * dx, y - row[1] - t * dy)
