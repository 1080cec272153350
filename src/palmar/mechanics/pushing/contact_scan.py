"""The gaps between an object and the links of a hand at one pose: what touches, and how far away the rest is.

The candidates are those of ``polygon_contacts``. A link that has cut into a polygon's inside is reported by a large
negative gap. Of a link farther away than the object's reach a lower bound of the gap is taken.
"""

from __future__ import annotations

from math import cos, inf, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.compiled import compiled, inlined
from palmar.mechanics.pushing.polygon_contacts import BEGIN, END, MOST_ACTIVE, VERTEX, Body, contact_code, link_of

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
CUT = 1e-6
"""Depth, in widths of the object, from which a link counts as inside it rather than touching."""


@compiled
def touching_candidates(
    body: Body, links: Floats, pairs: int, skin: float, x: float, y: float, theta: float,
    touch: float, found: Integers, apart: Floats,
) -> tuple[float, int]:  # fmt: skip
    """(least gap, number of candidates with a gap of at most ``touch``); those are written to ``found``.

    ``apart`` gets, for each link, the least gap of its other candidates. ``pairs`` = links of a finger.
    """
    c, s = cos(theta), sin(theta)
    least, touching = inf, 0
    for link in range(2 * pairs + 1):
        gap, other, touching = _gaps_of(body, links, link, pairs, skin, x, y, c, s, found, 0, touch, found, touching)
        apart[link] = other
        least = min(least, gap)
    return least, touching


@inlined
def further_gaps(
    body: Body, links: Floats, pairs: int, skin: float, x: float, y: float, theta: float,
    active: Integers, count: int, apart: Floats, far: float, found: Integers,
) -> tuple[float, float]:  # fmt: skip
    """(least gap of links without an active contact, that of inactive candidates of the others).

    Links of which ``apart`` says that they are farther off than ``far`` are left out; ``found`` is for scratch.
    """
    c, s = cos(theta), sin(theta)
    free, near = inf, inf
    for link in range(2 * pairs + 1):
        if apart[link] > far:
            continue
        busy = False
        for k in range(count):
            busy = busy or link_of(active[k]) == link
        gap, _, _ = _gaps_of(body, links, link, pairs, skin, x, y, c, s, active, count, -inf, found, 0)
        if busy:
            near = min(near, gap)
        else:
            free = min(free, gap)
    return free, near


@inlined
def _gaps_of(
    body: Body, links: Floats, link: int, pairs: int, skin: float, x: float, y: float, c: float, s: float,
    active: Integers, count: int, touch: float, found: Integers, touching: int,
) -> tuple[float, float, int]:  # fmt: skip
    """(least gap of the link's inactive candidates, that of those above ``touch``, number found so far)."""
    row = links[link]
    ax, ay, bx, by = row[0] - x, row[1] - y, row[2] - x, row[3] - y
    ax, ay, bx, by = c * ax + s * ay, c * ay - s * ax, c * bx + s * by, c * by - s * bx
    bound = _beyond(ax, ay, bx, by) - body.reach - row[7] - skin
    if bound > body.reach:
        return bound, bound, touching
    offset = row[7] + body.radius + skin
    skips_begin = link > 0 and ((link - 1) % pairs > 0 or row[7] == 0.0)
    gap, other, touching = _vertices(
        body, link, ax, ay, bx, by, offset, skips_begin, active, count, touch, found, touching
    )
    if len(body.vertices) > 1:
        gap2, other2, touching = _edges(
            body, link, ax, ay, bx, by, offset, skips_begin, active, count, touch, found, touching
        )
        gap, other = min(gap, gap2), min(other, other2)
    return gap, other, touching


@inlined
def _holds(codes: Integers, count: int, code: int) -> bool:
    held = False
    for k in range(count):
        held = held or codes[k] == code
    return held


@inlined
def _beyond(ax: float, ay: float, bx: float, by: float) -> float:
    """Distance of the origin from the segment a-b."""
    dx, dy = bx - ax, by - ay
    t = -(ax * dx + ay * dy) / (dx * dx + dy * dy)
    t = min(max(t, 0.0), 1.0)
    px, py = ax + t * dx, ay + t * dy
    return sqrt(px * px + py * py)


@inlined
def _vertices(
    body: Body, link: int, ax: float, ay: float, bx: float, by: float, offset: float, skips_begin: bool,
    active: Integers, count: int, touch: float, found: Integers, touching: int,
) -> tuple[float, float, int]:  # fmt: skip
    """As ``_gaps_of``, of the vertices to the segment, in the object's frame."""
    dx, dy = bx - ax, by - ay
    scale = 1.0 / (dx * dx + dy * dy)
    least, other = inf, inf
    for i in range(len(body.vertices)):
        px, py = body.vertices[i, 0] - ax, body.vertices[i, 1] - ay
        t = (px * dx + py * dy) * scale
        if t <= 0.0 and skips_begin:
            continue
        t = min(max(t, 0.0), 1.0)
        px, py = px - t * dx, py - t * dy
        square, within = px * px + py * py, other + offset
        if square > within * within:
            continue
        gap, code = sqrt(square) - offset, contact_code(link, VERTEX, i)
        if _holds(active, count, code):
            continue
        least = min(least, gap)
        if gap > touch:
            other = min(other, gap)
        elif touching < MOST_ACTIVE:
            found[touching] = code
            touching += 1
    return least, other, touching


@inlined
def _edges(
    body: Body, link: int, ax: float, ay: float, bx: float, by: float, offset: float, skips_begin: bool,
    active: Integers, count: int, touch: float, found: Integers, touching: int,
) -> tuple[float, float, int]:  # fmt: skip
    """As ``_gaps_of``, of the segment's ends to the edges; minus the width if the segment cuts the inside."""
    least, other = inf, inf
    enter, leave, deep = 0.0, 1.0, CUT * body.width
    for i in range(len(body.vertices)):
        vx, vy = body.vertices[i, 0], body.vertices[i, 1]
        ex, ey, length = body.edges[i, 0], body.edges[i, 1], body.edges[i, 2]
        da, db = (ax - vx) * ey - (ay - vy) * ex, (bx - vx) * ey - (by - vy) * ex
        if da > -deep and db > -deep:
            leave = -1.0
        elif da > -deep:
            enter = max(enter, (da + deep) / (da - db))
        elif db > -deep:
            leave = min(leave, (da + deep) / (da - db))
        for kind in (BEGIN, END):
            d = da if kind == BEGIN else db
            if d <= -deep or (kind == BEGIN and skips_begin) or d - offset > other:
                continue
            px, py = (ax - vx, ay - vy) if kind == BEGIN else (bx - vx, by - vy)
            along = px * ex + py * ey
            if along <= 0.0 or along >= length or _holds(active, count, contact_code(link, kind, i)):
                continue
            gap = d - offset
            least = min(least, gap)
            if gap > touch:
                other = min(other, gap)
            elif touching < MOST_ACTIVE:
                found[touching] = contact_code(link, kind, i)
                touching += 1
    if leave > enter:
        least, other = -body.width, -body.width
    return least, other, touching
