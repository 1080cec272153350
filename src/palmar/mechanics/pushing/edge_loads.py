"""Loads on up to three edges of friction cones that move their contacts as the contacts' mode demands.

An edge has the number 2 i for n + mu t of contact i and 2 i + 1 for n - mu t. Both edges of a contact (it sticks) are held
to its normal and tangential row, one (it slides) to the normal row alone; see ``contact_solve`` for the rows. The speed
along a row per load on an edge is an entry of a linear system of order 3 or less, solved by Cramer's rule.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import inlined
from palmar.mechanics.pushing.metric import Triple

Floats = NDArray[np.float64]
Loads = tuple[bool, float, float, float]
FIRST_ENTRY = 7
"""Column of a row from which its entries are stored, one for each edge."""


@inlined
def lean_of(contacts: Floats, edge: int) -> float:
    """Tangential load per normal load on the edge."""
    return contacts[edge // 2, 6] if edge % 2 == 0 else -contacts[edge // 2, 6]


@inlined
def _entry(rows: Floats, constraint: int, contact: int, lean: float) -> float:
    """Speed along the row ``constraint`` per load on an edge of the contact that has the tangential part ``lean``."""
    row, normal, tangent = rows[constraint], rows[2 * contact], rows[2 * contact + 1]
    return (
        row[0] * (normal[3] + lean * tangent[3])
        + row[1] * (normal[4] + lean * tangent[4])
        + row[2] * (normal[5] + lean * tangent[5])
    )


@inlined
def fill_entries(contacts: Floats, count: int, rows: Floats) -> None:
    """Store all entries beside their rows, for a search over many sets of edges."""
    for edge in range(2 * count):
        contact, lean = edge // 2, lean_of(contacts, edge)
        for constraint in range(2 * count):
            rows[constraint, FIRST_ENTRY + edge] = _entry(rows, constraint, contact, lean)


@inlined
def _held(a: int, b: int, c: int) -> tuple[int, int, int]:
    """The rows that the edges a < b < c are held to; only as many as there are edges are of use."""
    return a // 2 * 2, b // 2 * 2 + (1 if b // 2 == a // 2 else 0), c // 2 * 2 + (1 if c // 2 == b // 2 else 0)


@inlined
def known_loads(rows: Floats, a: int, b: int, c: int) -> Loads:
    """As ``edge_loads``, with the entries stored."""
    r1, r2, r3 = _held(a, b, c)
    ea, eb, ec = FIRST_ENTRY + a, FIRST_ENTRY + b, FIRST_ENTRY + c
    if b < 0:
        return (
            abs(rows[r1, ea]) > 0.5e-12 * abs(rows[r1, FIRST_ENTRY + r1] + rows[r1, FIRST_ENTRY + r1 + 1]),
            (rows[r1, 6] / rows[r1, ea]),
            0.0,
            0.0,
        )
    if c < 0:
        return _two(rows[r1, ea], rows[r1, eb], rows[r2, ea], rows[r2, eb], rows[r1, 6], rows[r2, 6])
    return _three(
        rows[r1, ea], rows[r1, eb], rows[r1, ec],
        rows[r2, ea], rows[r2, eb], rows[r2, ec],
        rows[r3, ea], rows[r3, eb], rows[r3, ec],
        rows[r1, 6], rows[r2, 6], rows[r3, 6],
    )  # fmt: skip


@inlined
def edge_loads(contacts: Floats, rows: Floats, a: int, b: int, c: int) -> Loads:
    """Loads on the edges a < b < c (b, c may be NONE) that move their contacts as constrained; False: singular."""
    r1, r2, r3 = _held(a, b, c)
    ca, cb, la, lb = a // 2, b // 2, lean_of(contacts, a), lean_of(contacts, b)
    a11 = _entry(rows, r1, ca, la)
    if b < 0:
        return abs(a11) > 1e-12 * _entry(rows, r1, ca, 0.0), rows[r1, 6] / a11, 0.0, 0.0
    a12, a21, a22 = _entry(rows, r1, cb, lb), _entry(rows, r2, ca, la), _entry(rows, r2, cb, lb)
    if c < 0:
        return _two(a11, a12, a21, a22, rows[r1, 6], rows[r2, 6])
    cc, lc = c // 2, lean_of(contacts, c)
    return _three(
        a11, a12, _entry(rows, r1, cc, lc),
        a21, a22, _entry(rows, r2, cc, lc),
        _entry(rows, r3, ca, la), _entry(rows, r3, cb, lb), _entry(rows, r3, cc, lc),
        rows[r1, 6], rows[r2, 6], rows[r3, 6],
    )  # fmt: skip


@inlined
def _two(a11: float, a12: float, a21: float, a22: float, b1: float, b2: float) -> Loads:
    minor, size = a11 * a22 - a12 * a21, abs(a11 * a22) + abs(a12 * a21)
    return abs(minor) > 1e-12 * size, (b1 * a22 - b2 * a12) / minor, (a11 * b2 - a21 * b1) / minor, 0.0


@inlined
def _three(
    a11: float, a12: float, a13: float, a21: float, a22: float, a23: float, a31: float, a32: float, a33: float,
    b1: float, b2: float, b3: float,
) -> Loads:  # fmt: skip
    c1, c2, c3 = a22 * a33 - a23 * a32, a13 * a32 - a12 * a33, a12 * a23 - a13 * a22
    d1, d2, d3 = a23 * a31 - a21 * a33, a11 * a33 - a13 * a31, a13 * a21 - a11 * a23
    e1, e2, e3 = a21 * a32 - a22 * a31, a12 * a31 - a11 * a32, a11 * a22 - a12 * a21
    det = a11 * c1 + a21 * c2 + a31 * c3
    size = abs(a11 * c1) + abs(a21 * c2) + abs(a31 * c3)
    first, second, third = b1 * c1 + b2 * c2 + b3 * c3, b1 * d1 + b2 * d2 + b3 * d3, b1 * e1 + b2 * e2 + b3 * e3
    return abs(det) > 1e-12 * size, first / det, second / det, third / det


@inlined
def _moved(contacts: Floats, rows: Floats, edge: int, load: float) -> Triple:
    """The twist that a load on one edge causes."""
    normal, tangent, lean = rows[edge // 2 * 2], rows[edge // 2 * 2 + 1], lean_of(contacts, edge)
    return (
        load * (normal[3] + lean * tangent[3]),
        load * (normal[4] + lean * tangent[4]),
        load * (normal[5] + lean * tangent[5]),
    )


@inlined
def edges_twist(
    contacts: Floats, rows: Floats, a: int, b: int, c: int, la: float, lb: float, lc: float
) -> Triple:  # fmt: skip
    """The twist that loads on up to three edges cause."""
    x, y, w = _moved(contacts, rows, a, la)
    if b >= 0:
        x2, y2, w2 = _moved(contacts, rows, b, lb)
        x, y, w = x + x2, y + y2, w + w2
    if c >= 0:
        x3, y3, w3 = _moved(contacts, rows, c, lc)
        x, y, w = x + x3, y + y3, w + w3
    return x, y, w
