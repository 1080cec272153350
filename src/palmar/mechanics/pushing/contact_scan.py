"""The gaps between an object and the links of a hand at one pose: what touches, and how far away the rest is.

The candidates are those of ``polygon_contacts``. A link that has cut into a polygon's inside is reported by a large
negative gap. Of a link farther away than the object's reach a lower bound of the gap is taken.
"""

from __future__ import annotations

from math import inf, sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing.polygon_contacts import (
    BEGIN,
    END,
    MOST_ACTIVE,
    VERTEX,
    Body,
    Scale,
    contact_code,
    kind_of,
    link_of,
)

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
BESIDE = 1e-10
"""Part of the next link from which a vertex beyond a link's end is beside that one: no vertex falls between the two."""


@compiled
def touching_candidates(
    body: Body, links: Floats, rows: int, scale: Scale, x: float, y: float, theta: float,
    touch: float, found: Integers, apart: Floats,
) -> tuple[float, int]:  # fmt: skip
    """(least gap, number of candidates with a gap of at most ``touch``); those are written to ``found``.

    ``apart`` gets, for each link, the least gap of its other candidates, or less. ``rows``: see ``row_count``.
    """
    c, s = cosine_sine(theta)
    least, touching = inf, 0
    for link in range(rows):
        gap, other, touching = _gaps_of(body, links, link, rows, scale, x, y, c, s, found, 0, touch, found, touching)
        apart[link] = other
        least = min(least, gap)
    return least, touching


@inlined
def further_gaps(
    body: Body, links: Floats, rows: int, scale: Scale, x: float, y: float, theta: float,
    active: Integers, count: int, apart: Floats, far: float, found: Integers,
) -> tuple[float, float]:  # fmt: skip
    """(least gap of links without an active contact, that of inactive candidates of the others).

    Links without an active contact are left out if ``apart`` says that they are farther off than ``far``; where there is
    one, a further candidate may begin right beside it. ``found`` is for scratch.
    """
    c, s = cosine_sine(theta)
    free, near = inf, inf
    for link in range(rows):
        busy = False
        for k in range(count):
            busy = busy or link_of(active[k]) == link
        if apart[link] > far and not busy:
            continue
        gap, _, _ = _gaps_of(body, links, link, rows, scale, x, y, c, s, active, count, -inf, found, 0)
        if busy:
            near = min(near, gap)
        else:
            free = min(free, gap)
    return free, near


@inlined
def _gaps_of(
    body: Body, links: Floats, link: int, rows: int, scale: Scale, x: float, y: float, c: float, s: float,
    active: Integers, count: int, touch: float, found: Integers, touching: int,
) -> tuple[float, float, int]:  # fmt: skip
    """(least gap of the link's inactive candidates, that of those above ``touch`` or less, number found so far).

    Of a link in touch, whose contacts drift within a stride, only a deeper cut counts, and vertices are seen to pass it;
    so too where contacts are looked for anew, after a shift that may have taken the object a little into palm or wall.
    """
    row = links[link]
    ax, ay, bx, by = row[0] - x, row[1] - y, row[2] - x, row[3] - y
    ax, ay, bx, by = c * ax + s * ay, c * ay - s * ax, c * bx + s * by, c * by - s * bx
    bound = _beyond(ax, ay, bx, by) - body.reach - row[7] - scale.skin
    if bound > body.reach:
        return bound, bound, touching
    offset = row[7] + body.radius + scale.skin
    pairs = (rows - 1) // 2
    flat = link == 0 or link > 2 * pairs
    skips_begin = not flat and ((link - 1) % pairs > 0 or row[7] == 0.0)
    deep, beyond = scale.cut, 0.0
    if touch > 0.0:
        deep, beyond = scale.deep, (2.0 * scale.deep if flat else 0.0)
    for k in range(count):
        if link_of(active[k]) == link:
            deep = scale.deep
            beyond = 2.0 * deep if kind_of(active[k]) == VERTEX and beyond >= 0.0 else -1.0
    fx, fy = 0.0, 0.0
    if not flat and link % pairs > 0:
        follow = links[link + 1]
        gx, gy = follow[2] - follow[0], follow[3] - follow[1]
        fx, fy = c * gx + s * gy, c * gy - s * gx
    gap, other, touching = _vertices(
        body, link, ax, ay, bx, by, offset, beyond, skips_begin, fx, fy, active, count, touch, found, touching
    )
    if len(body.vertices) > 1:
        gap2, other2, touching = _edges(
            body, link, ax, ay, bx, by, offset, deep, skips_begin, active, count, touch, found, touching
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
    body: Body, link: int, ax: float, ay: float, bx: float, by: float, offset: float, beyond: float, skips_begin: bool,
    fx: float, fy: float,
    active: Integers, count: int, touch: float, found: Integers, touching: int,
) -> tuple[float, float, int]:  # fmt: skip
    """As ``_gaps_of``, of the vertices to the segment, in the object's frame.

    (fx, fy) leads along the link that follows, if any: a vertex beyond the end but beside that one is left to it.
    A vertex past the link, seen from the reference point, by less than ``beyond`` has a negative distance.
    """
    dx, dy = bx - ax, by - ay
    square_inverse = 1.0 / (dx * dx + dy * dy)
    least, other, skipped = inf, inf, inf
    for i in range(len(body.vertices)):
        px, py = body.vertices[i, 0] - ax, body.vertices[i, 1] - ay
        t = (px * dx + py * dy) * square_inverse
        if (t <= 0.0 and skips_begin) or (t >= 1.0 and (px - dx) * fx + (py - dy) * fy > BESIDE * (fx * fx + fy * fy)):
            px, py = (px, py) if t <= 0.0 else (px - dx, py - dy)
            skipped = min(skipped, px * px + py * py)
            continue
        t = min(max(t, 0.0), 1.0)
        px, py = px - t * dx, py - t * dy
        square, within = px * px + py * py, other + offset
        if square > within * within:
            continue
        distance, code = sqrt(square), contact_code(link, VERTEX, i)
        if distance < beyond and (dx * py - dy * px) * (dy * ax - dx * ay) < 0.0:
            distance = -distance
        gap = distance - offset
        if _holds(active, count, code):
            continue
        least = min(least, gap)
        if gap > touch:
            other = min(other, gap)
        elif touching < MOST_ACTIVE:
            found[touching] = code
            touching += 1
    return least, min(other, sqrt(skipped) - offset), touching


@inlined
def _edges(
    body: Body, link: int, ax: float, ay: float, bx: float, by: float, offset: float, deep: float, skips_begin: bool,
    active: Integers, count: int, touch: float, found: Integers, touching: int,
) -> tuple[float, float, int]:  # fmt: skip
    """As ``_gaps_of``, of the segment's ends to the edges; minus the width if the segment cuts the inside."""
    least, other, skipped = inf, inf, inf
    enter, leave = 0.0, 1.0
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
            if kind == BEGIN and skips_begin:
                skipped = min(skipped, d) if d > 0.0 else skipped
                continue
            if d <= -deep or d - offset > other:
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
    return least, min(other, skipped - offset), touching
