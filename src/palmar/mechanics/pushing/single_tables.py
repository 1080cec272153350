"""Tables of how a uniform polygon moves that is touched at a single corner, or slides on a fingertip.

Quasi-static motion has no memory, and a limit surface turns with its object: along the object's axes the twist under a
load of the direction f = (fx, fy) at the point r depends on f and r alone, and so does the velocity w of the object's
point r. With a' the vector a turned left by a quarter,

    w ~ f + p f',   f ~ w + q w',   p and q even, omega odd and of degree 1, in f or w.

For each corner p and omega are tabulated against f, as needed where it slides (the load is on an edge of the friction
cone), q and omega against w, as where it sticks (w is the hand's velocity), neither for any one friction. The key of a
direction (a, b) is b / a on one face, |a| >= |b|, and a / b on the other, omega that for the larger part 1: no angle is
needed. For each edge p and omega are tabulated against the place r on it, f being an edge of the friction cone. Each cell
holds two cubics through Chebyshev's points. Where the centre of rotation passes the outline the curvature of these
functions has a logarithmic pole: there they are right to 5e-6 of speed or load, elsewhere to 1e-8.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing.limit_surface import UNIFORM_POLYGON, LimitSurface, secant_metric, tangent_metric, twist
from palmar.mechanics.pushing.metric import Triple, inverse, squared, times
from palmar.mechanics.pushing.polygon_contacts import Body

Floats = NDArray[np.float64]
CELLS = 256
"""Cells of each table: a row of four and four coefficients of powers of the place in the cell, from -1/2 to 1/2."""
NODES = 0.5 * np.cos(np.pi * (np.arange(4) + 0.5) / 4.0)
FIT = np.linalg.inv(NODES[:, None] ** np.arange(4))
NEWTON_PASSES, SECANT_PASSES, CHANGE = 20, 400, 1e-8


_KEPT: dict[tuple[bytes, bytes, float], Floats] = {}
MOST_KEPT = 8


def single_tables(surface: LimitSurface, vertices: Floats, friction: float) -> Floats:
    """Rows (3 kinds, V corners or edges, 2, CELLS) x 8; kinds: sticking, sliding corner, edge; 2 faces or sides of a cone.

    The last few are kept, as many questions are asked about one object.
    """
    key = surface.edges.tobytes(), vertices.tobytes(), friction
    if key not in _KEPT:
        rows = np.zeros((6 * len(vertices) * CELLS, 8))
        fill_tables(surface, vertices, friction, rows)
        while len(_KEPT) >= MOST_KEPT:
            _KEPT.pop(next(iter(_KEPT)), None)
        _KEPT[key] = rows
    return _KEPT[key]


def tabulated(body: Body) -> Body:
    """The body with its tables, if it is a polygon with uniform pressure."""
    if body.surface.kind != UNIFORM_POLYGON or body.radius > 0.0 or len(body.vertices) < 3:
        return body
    return body._replace(single=single_tables(body.surface, body.vertices, body.friction))


@compiled
def fill_tables(surface: LimitSurface, vertices: Floats, friction: float, rows: Floats) -> None:
    """Fill the rows of ``single_tables``."""
    count = len(vertices)
    for i in range(count):
        x, y, after = vertices[i, 0], vertices[i, 1], (i + 1) % count
        ex, ey = vertices[after, 0] - x, vertices[after, 1] - y
        size = sqrt(ex * ex + ey * ey)
        for face in range(2):
            lean = friction if face == 0 else -friction
            fx, fy = (-ey - lean * ex) / size, (ex - lean * ey) / size
            first = (2 * i + face) * CELLS
            nu, turn = (0.0, 0.0, 0.0), 0.0
            for cell in range(CELLS):
                for node in range(4):
                    t = 2.0 * (cell + 0.5 + NODES[node]) / CELLS - 1.0
                    a, b = (1.0, t) if face == 0 else (t, 1.0)
                    q, turn = _sticking(surface, x, y, a, b, turn)
                    _add(rows[first + cell], node, q, turn)
                    nu = loaded(surface, x, y, a, b, nu)
                    p, k = _along_load(nu, x, y, a, b)
                    _add(rows[first + cell + 2 * count * CELLS], node, p, k)
            nu = (0.0, 0.0, 0.0)
            for cell in range(CELLS):
                for node in range(4):
                    t = (cell + 0.5 + NODES[node]) / CELLS
                    nu = loaded(surface, x + t * ex, y + t * ey, fx, fy, nu)
                    p, k = _along_load(nu, x + t * ex, y + t * ey, fx, fy)
                    _add(rows[first + cell + 4 * count * CELLS], node, p, k)


@inlined
def _add(row: Floats, node: int, one: float, other: float) -> None:
    """Add what a node contributes to the two cubics."""
    for power in range(4):
        row[power] += FIT[power, node] * one
        row[4 + power] += FIT[power, node] * other


@inlined
def _along_load(nu: Triple, x: float, y: float, fx: float, fy: float) -> tuple[float, float]:
    """(p, omega) where w = f + p f', from a twist of any size."""
    wx, wy = nu[0] - nu[2] * y, nu[1] + nu[2] * x
    along = wx * fx + wy * fy
    return (wy * fx - wx * fy) / along, nu[2] * (fx * fx + fy * fy) / along


@compiled
def loaded(surface: LimitSurface, x: float, y: float, fx: float, fy: float, guess: Triple) -> Triple:
    """The twist under the load f at (x, y), sized so that their power is 1.

    Newton's method from a guess, if there is one (not 0, 0, 0) and it leads there, else a sure descent.
    """
    moment = x * fy - y * fx
    a, b, c = guess
    for _ in range(NEWTON_PASSES if a != 0.0 or b != 0.0 or c != 0.0 else 0):
        metric = tangent_metric(surface, a, b, c)
        na, nb, nc = times(inverse(metric), fx, fy, moment)
        size = 1.0 / (na * fx + nb * fy + nc * moment)
        na, nb, nc = na * size, nb * size, nc * size
        change = squared(metric, na - a, nb - b, nc - c)
        a, b, c = na, nb, nc
        if change <= CHANGE * CHANGE * squared(metric, a, b, c):
            return a, b, c
    a, b, c = twist(surface, fx, fy, moment)
    size = 1.0 / (a * fx + b * fy + c * moment)
    return a * size, b * size, c * size


@compiled
def _sticking(surface: LimitSurface, x: float, y: float, wx: float, wy: float, turn: float) -> tuple[float, float]:
    """(q, omega) where the point (x, y) moves at w: the power lost has its minimum in omega there; ``turn`` is a guess."""
    for k in range(NEWTON_PASSES + SECANT_PASSES):
        a, b = wx + turn * y, wy - turn * x
        metric = tangent_metric(surface, a, b, turn) if k < NEWTON_PASSES else secant_metric(surface, a, b, turn)
        gx, gy, gw = times(metric, y, -x, 1.0)
        new = -(gx * wx + gy * wy) / (gx * y - gy * x + gw)
        change, turn = abs(new - turn), new
        if change * surface.length <= CHANGE * (abs(wx) + abs(wy)):
            break
    fx, fy, _ = times(secant_metric(surface, wx + turn * y, wy - turn * x, turn), wx + turn * y, wy - turn * x, turn)
    return (wx * fy - wy * fx) / (wx * fx + wy * fy), turn
