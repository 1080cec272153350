"""One step of a disk without friction before a closing hand: a smooth path, and how far it is from being a motion.

Without friction the centre moves with the shortest velocity that makes room (docs/derivations/sweeping.md): a sum of
load times normal over at most two links. Over a step those two stay the same. The path is the cubic through both ends with
their velocities, and the velocity in the middle agrees as well (Hermite, Simpson). What the path is off is measured at its
quarters: ``audit``. So nothing about the path has to be believed.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, compiled_to_allocate, inlined
from palmar.mechanics.pushing.hand_pose import LINK_WIDTH, MOST_LINKS, MOVING, HandMotion, place_links
from palmar.mechanics.pushing.link_view import GAP, NX, NY, SPEED, VIEW_WIDTH, view_all, view_link

Floats = NDArray[np.float64]
MOST = 2 * MOST_LINKS + 1
ROUNDS, PARALLEL = 3, 1e-9
AT_BEGIN, AT_MIDDLE, AT_END, AT_QUARTER = range(4)


class Path(NamedTuple):
    """A step's cubic: both ends and their velocities; the loads' greatest values; what ``audit`` finds.

    ``rest`` (m/rad) is what the velocity is off a sum of positive loads times normals; ``drift`` (m) how far loaded
    contacts are from touching; ``first``, ``second`` the greatest load of either, ``low_first``, ``low_second`` the
    least; ``least`` (m) the least gap of the rest.
    """

    x: float
    y: float
    vx: float
    vy: float
    rest: float
    drift: float
    first: float
    second: float
    low_first: float
    low_second: float
    least: float


class Room(NamedTuple):
    """Links (4, MOST, LINK_WIDTH) and views (4, MOST, VIEW_WIDTH) at a step's begin, middle, end and at a quarter."""

    links: Floats
    views: Floats


@compiled_to_allocate
def room() -> Room:
    """A fresh one."""
    return Room(np.zeros((4, MOST, LINK_WIDTH)), np.zeros((4, MOST, VIEW_WIDTH)))


@inlined
def loads_of(views: Floats, i: int, j: int, vx: float, vy: float, given: bool) -> tuple[float, float, float]:
    """Loads on the links i and j (-1: none) that give the velocity, or, if none is given, keep up with both links.

    Returns (first load, second load, what is left of a given velocity, m/rad). A velocity is a sum over two normals.
    """
    if i < 0:
        return 0.0, 0.0, sqrt(vx * vx + vy * vy) if given else 0.0
    a = views[i]
    s = vx * a[NX] + vy * a[NY] if given else a[SPEED]
    if j < 0:
        return s, 0.0, abs(vx * a[NY] - vy * a[NX]) if given else 0.0
    b = views[j]
    g = a[NX] * b[NX] + a[NY] * b[NY]
    r = vx * b[NX] + vy * b[NY] if given else b[SPEED]
    scale = 1.0 / (1.0 - g * g)
    return (s - g * r) * scale, (r - g * s) * scale, 0.0


@inlined
def _velocity(views: Floats, i: int, j: int) -> tuple[float, float]:
    first, second, _ = loads_of(views, i, j, 0.0, 0.0, False)
    vx, vy = 0.0, 0.0
    if i >= 0:
        vx, vy = first * views[i, NX], first * views[i, NY]
    if j >= 0:
        vx, vy = vx + second * views[j, NX], vy + second * views[j, NY]
    return vx, vy


@compiled
def shortest(views: Floats, count: int, touch: float, slack: float) -> tuple[bool, int, int, float, float]:
    """The shortest velocity that makes room at the links that touch: (whether there is one, its two links, itself)."""
    best, bi, bj, bx, by = inf, -1, -1, 0.0, 0.0
    for i in range(-1, count):
        if i >= 0 and views[i, GAP] > touch:
            continue
        for j in range(-1, i if i >= 0 else 0):
            if j >= 0 and views[j, GAP] > touch:
                continue
            if j >= 0 and abs(views[i, NX] * views[j, NY] - views[i, NY] * views[j, NX]) < PARALLEL:
                continue
            first, second, _ = loads_of(views, i, j, 0.0, 0.0, False)
            if first < 0.0 or second < 0.0:
                continue
            vx, vy = _velocity(views, i, j)
            if vx * vx + vy * vy >= best:
                continue
            fits = True
            for k in range(count):
                short = views[k, SPEED] - vx * views[k, NX] - vy * views[k, NY]
                fits = fits and (views[k, GAP] > touch or short <= slack)
            if fits:
                best, bi, bj, bx, by = vx * vx + vy * vy, i, j, vx, vy
    return best < inf, bi, bj, bx, by


@compiled
def _onto(links: Floats, views: Floats, radius: float, i: int, j: int, x: float, y: float) -> tuple[float, float]:
    """Shift (x, y) to touch both links, whose views are filled there."""
    for _ in range(4):
        view_link(links[i], x, y, radius, views[i])
        if j >= 0:
            view_link(links[j], x, y, radius, views[j])
        a, off = views[i], views[i, GAP]
        if j < 0:
            if abs(off) < 1e-15:
                break
            x, y = x - off * a[NX], y - off * a[NY]
            continue
        b, away = views[j], views[j, GAP]
        if max(abs(off), abs(away)) < 1e-15:
            break
        scale = 1.0 / (a[NX] * b[NY] - a[NY] * b[NX])
        x, y = x - (off * b[NY] - away * a[NY]) * scale, y - (away * a[NX] - off * b[NX]) * scale
    view_link(links[i], x, y, radius, views[i])
    if j >= 0:
        view_link(links[j], x, y, radius, views[j])
    return x, y


@inlined
def middle(
    x: float, y: float, vx: float, vy: float, ex: float, ey: float, wx: float, wy: float, h: float
) -> tuple[float, float, float, float]:
    """Place and velocity in the middle of the cubic from (x, y) to (ex, ey)."""
    return (
        0.5 * (x + ex) + 0.125 * h * (vx - wx), 0.5 * (y + ey) + 0.125 * h * (vy - wy),
        1.5 * (ex - x) / h - 0.25 * (vx + wx), 1.5 * (ey - y) / h - 0.25 * (vy + wy),
    )  # fmt: skip


@compiled
def step(
    hand: HandMotion, radius: float, at: Room, t: float, x: float, y: float, vx: float, vy: float, i: int, j: int, h: float
) -> Path:  # fmt: skip
    """The path of one step from (x, y) with its velocity; fills links and views at the middle and the end."""
    count = 2 * len(hand.links) + 1
    place_links(hand, t + 0.5 * h, MOVING, MOVING, at.links[AT_MIDDLE])
    place_links(hand, t + h, MOVING, MOVING, at.links[AT_END])
    mid, end = at.views[AT_MIDDLE], at.views[AT_END]
    ex, ey, wx, wy, mx, my = x + h * vx, y + h * vy, vx, vy, x, y
    if i >= 0:
        for k in range(ROUNDS):
            ex, ey = _onto(at.links[AT_END], end, radius, i, j, ex, ey)
            wx, wy = _velocity(end, i, j)
            if k == ROUNDS - 1:
                break
            mx, my, _, _ = middle(x, y, vx, vy, ex, ey, wx, wy, h)
            view_link(at.links[AT_MIDDLE, i], mx, my, radius, mid[i])
            if j >= 0:
                view_link(at.links[AT_MIDDLE, j], mx, my, radius, mid[j])
            ux, uy = _velocity(mid, i, j)
            ex, ey = x + h * (vx + 4.0 * ux + wx) / 6.0, y + h * (vy + 4.0 * uy + wy) / 6.0
    mx, my, ux, uy = middle(x, y, vx, vy, ex, ey, wx, wy, h)
    view_all(at.links[AT_MIDDLE], count, mx, my, radius, mid)
    view_all(at.links[AT_END], count, ex, ey, radius, end)
    return _audited(hand, radius, at, t, x, y, vx, vy, i, j, h, (ex, ey, wx, wy), (ux, uy))


@compiled
def _audited(
    hand: HandMotion, radius: float, at: Room, t: float, x: float, y: float, vx: float, vy: float, i: int, j: int,
    h: float, end: tuple[float, float, float, float], centre: tuple[float, float],
) -> Path:  # fmt: skip
    """The path with what it is off, measured at its quarters and its middle and doubled."""
    count, mid, quarter = 2 * len(hand.links) + 1, at.views[AT_MIDDLE], at.views[AT_QUARTER]
    ex, ey, wx, wy = end
    first, second, rest = loads_of(mid, i, j, centre[0], centre[1], True)
    low_first, low_second, drift, least = first, second, 0.0, inf
    for side in range(2):
        s = 0.25 if side == 0 else 0.75
        b, c = (0.84375, 0.140625) if side == 0 else (0.15625, 0.046875)
        d, e = (0.15625, -0.046875) if side == 0 else (0.84375, -0.140625)
        px, py = b * x + d * ex + h * (c * vx + e * wx), b * y + d * ey + h * (c * vy + e * wy)
        c, e = (0.1875, -0.3125) if side == 0 else (-0.3125, 0.1875)
        qx, qy = 1.125 * (ex - x) / h + c * vx + e * wx, 1.125 * (ey - y) / h + c * vy + e * wy
        place_links(hand, t + s * h, MOVING, MOVING, at.links[AT_QUARTER])
        view_all(at.links[AT_QUARTER], count, px, py, radius, quarter)
        one, two, off = loads_of(quarter, i, j, qx, qy, True)
        first, second, rest = max(first, one), max(second, two), max(rest, off)
        low_first, low_second = min(low_first, one), min(low_second, two)
        for k in range(count):
            if k in (i, j):
                drift = max(drift, max(abs(quarter[k, GAP]), abs(mid[k, GAP])))
            else:
                least = min(least, min(quarter[k, GAP], min(mid[k, GAP], at.views[AT_END, k, GAP])))
    rest = 2.0 * rest - min(low_first, 0.0) - min(low_second, 0.0)
    spread, other = 0.5 * (first - low_first), 0.5 * (second - low_second)
    return Path(
        ex, ey, wx, wy, rest, 2.0 * drift, max(first + spread, 0.0), max(second + other, 0.0),
        max(low_first - spread, 0.0), max(low_second - other, 0.0), least,
    )  # fmt: skip
