"""The twist of an object that a corner touches alone, or that slides on a fingertip alone, from ``single_tables``.

With the contact's normal n, tangent t and u the hand's velocity there: where a corner sticks, w = u and the load is along
w + q w'; where it slides, the load is along f = n + lambda t, lambda = mu or -mu, and w = s (f + p f') with
s = (n . u) / (1 - lambda p), so that the gap stays.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import inlined
from palmar.mechanics.pushing.closing_motion import Bench, to_table
from palmar.mechanics.pushing.contact_solve import signed
from palmar.mechanics.pushing.polygon_contacts import VERTEX, Body, kind_of
from palmar.mechanics.pushing.single_tables import CELLS

Floats = NDArray[np.float64]
LEAST_OPENING = 0.02
"""Of 1 - lambda p: a load that hardly opens its gap, or closes it, is left to the solver."""


@inlined
def in_tables(body: Body, at: Bench, count: int) -> bool:
    """Whether the last motion's mode is one that ``single_twist`` knows."""
    if count != 1 or len(body.single) == 0 or at.edges[0] < 0:
        return False
    return kind_of(at.active[0]) == VERTEX or at.edges[1] < 0


@inlined
def single_twist(body: Body, at: Bench, speed: float) -> tuple[bool, float]:
    """As ``mode_twist`` for the contact written, False also where the tables do not reach; loads are of size 1."""
    row, motion, code = at.contacts[0], at.space.motions[0], at.active[0]
    nx, ny, ux, uy = row[2], row[3], row[4], row[5]
    normal, across = nx * ux + ny * uy, nx * uy - ny * ux
    sticks = at.edges[1] >= 0
    if speed == 0.0:
        return False, -1.0
    if sticks:
        q, turn = _of_direction(body, 2 * (code % 16384), ux, uy)
        wx, wy = ux, uy
        pressed, dragged = normal - q * across, across + q * normal
        size = 1.0 / (abs(pressed) + abs(dragged))
        pressed, dragged = pressed * size, dragged * size / row[6]
        margin = min(signed(0.5 * (pressed + dragged)), signed(0.5 * (pressed - dragged)))
        at.loads[0, 0], at.loads[0, 1] = pressed, dragged * row[6]
    else:
        lean = row[6] if at.edges[0] == 0 else -row[6]
        fx, fy = nx - lean * ny, ny + lean * nx
        if kind_of(code) == VERTEX:
            p, turn = _of_direction(body, 2 * (len(body.vertices) + code % 16384), fx, fy)
        else:
            p, turn, reached = _of_place(body, code % 16384, 0 if at.edges[0] == 0 else 1, row[0], row[1])
            if not reached:
                return False, -1.0
        opens = 1.0 - lean * p
        if not opens > LEAST_OPENING:
            return False, -1.0
        share = normal / opens
        wx, wy, turn = share * (fx - p * fy), share * (fy + p * fx), share * turn
        margin = 1.0 if normal > 0.0 else -1.0
        at.loads[0, 0], at.loads[0, 1] = margin, margin * lean
    rx, ry = row[0], row[1]
    x, y = wx + turn * ry, wy - turn * rx
    if not sticks and row[6] > 0.0:
        slip = share * (lean + p) - across
        scale = 1.0 / (speed + abs(x) + abs(y) + abs(turn) * (abs(rx) + abs(ry)))
        margin = min(margin, scale * (-slip if at.edges[0] == 0 else slip))
    motion[0], motion[1], motion[2] = x, y, turn
    to_table(at, motion)
    return True, margin


@inlined
def _of_direction(body: Body, first: int, a: float, b: float) -> tuple[float, float]:
    """(value, omega) in the direction (a, b) from the tables of two faces, the first of which has the number ``first``."""
    steep = abs(b) > abs(a)
    large, t = (b, a / b) if steep else (a, b / a)
    value, turn = _at(body, first + (1 if steep else 0), 0.5 * (t + 1.0))
    return value, large * turn


@inlined
def _of_place(body: Body, edge: int, side: int, x: float, y: float) -> tuple[float, float, bool]:
    """(value, omega) at a point of an edge, loaded along one side of the friction cone; whether it is between the ends."""
    ex, ey, length = body.edges[edge, 0], body.edges[edge, 1], body.edges[edge, 2]
    part = ((x - body.vertices[edge, 0]) * ex + (y - body.vertices[edge, 1]) * ey) / length
    if not 0.0 <= part <= 1.0:
        return 0.0, 0.0, False
    value, turn = _at(body, 4 * len(body.vertices) + 2 * edge + side, part)
    return value, turn, True


@inlined
def _at(body: Body, table: int, part: float) -> tuple[float, float]:
    """The two functions of a table at the fraction ``part`` of its range."""
    place = part * CELLS
    cell = min(int(place), CELLS - 1)
    z, row = place - cell - 0.5, body.single[table * CELLS + cell]
    return row[0] + z * (row[1] + z * (row[2] + z * row[3])), row[4] + z * (row[5] + z * (row[6] + z * row[7]))
