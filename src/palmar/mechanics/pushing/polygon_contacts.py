"""Where a disk or convex polygon touches the links of a hand.

Every link is a capsule about a segment, and the object a polygon about its reference point, rounded by a radius: a disk
is a polygon of one vertex. Candidates for a contact of a link are, each with its gap,

- a vertex against the link: distance of the vertex from the segment, less both radii;
- an end of the segment against an edge of the object, where it projects into the edge.

Both are true distances outside, so no pair that is apart ever counts as touching. A line link (half thickness 0) that
meets a polygon gets a skin of ``SKIN`` hand lengths: it makes the way of a corner around a fingertip smooth.
A link that has cut into a polygon's inside is reported by a large negative gap.
"""

from __future__ import annotations

from math import cos, hypot, inf, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.pushing.compiled import compiled
from palmar.mechanics.pushing.limit_surface import LimitSurface, disk_surface, polygon_surface

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
SKIN = 1e-6
CUT = 1e-6
"""Depth, in widths of the object, from which a link counts as inside it rather than touching."""
VERTEX, BEGIN, END = 0, 1, 2
MOST_ACTIVE = 12


class Body(NamedTuple):
    """Vertices (V, 2) counter-clockwise about the reference point, rounding radius, reach, least width, friction."""

    vertices: Floats
    radius: float
    reach: float
    width: float
    friction: float
    surface: LimitSurface


def disk_body(radius: float, friction: float, surface: LimitSurface | None = None) -> Body:
    """A disk of ``radius`` (m), with uniform pressure unless a limit surface is given."""
    r = float(radius)
    return Body(np.zeros((1, 2)), r, r, 2.0 * r, float(friction), surface or disk_surface(r))


def polygon_body(vertices: ArrayLike, friction: float, surface: LimitSurface | None = None) -> Body:
    """A convex polygon about its reference point (centre of pressure), with uniform pressure unless given otherwise."""
    corners = np.ascontiguousarray(vertices, dtype=float)
    edges = np.roll(corners, -1, axis=0) - corners
    outward = np.stack([edges[:, 1], -edges[:, 0]], axis=1) / np.hypot(edges[:, 0], edges[:, 1])[:, None]
    width = min(float(np.ptp(corners @ normal)) for normal in outward)
    reach = float(np.hypot(corners[:, 0], corners[:, 1]).max())
    return Body(corners, 0.0, reach, width, float(friction), surface or polygon_surface(corners))


@compiled
def contact_code(link: int, kind: int, index: int) -> int:
    """One integer for a candidate: the link's row, vertex or end of the link, number of the vertex or edge."""
    return (link * 3 + kind) * 16384 + index


@compiled
def link_of(code: int) -> int:
    """The link's row of a candidate."""
    return code // 16384 // 3


@compiled
def _holds(codes: Integers, count: int, code: int) -> bool:
    held = False
    for k in range(count):
        held = held or codes[k] == code
    return held


@compiled
def scan(
    body: Body, links: Floats, pairs: int, skin: float, x: float, y: float, theta: float,
    active: Integers, count: int, touch: float, found: Integers,
) -> tuple[float, float, int]:  # fmt: skip
    """(least gap of links without an active contact, that of inactive candidates of the others, number touching).

    The candidates with a gap of at most ``touch`` are written to ``found``. ``pairs`` = links of a finger. Of a link
    farther away than the object's reach a lower bound of the gap is taken.
    """
    c, s = cos(theta), sin(theta)
    free, near, touching = inf, inf, 0
    for link in range(2 * pairs + 1):
        row = links[link]
        ax, ay, bx, by = row[0] - x, row[1] - y, row[2] - x, row[3] - y
        ax, ay, bx, by = c * ax + s * ay, c * ay - s * ax, c * bx + s * by, c * by - s * bx
        offset = row[7] + body.radius + skin
        busy = False
        for k in range(count):
            busy = busy or link_of(active[k]) == link
        least = _beyond(ax, ay, bx, by) - body.reach - row[7] - skin
        if not busy and least > touch and (least >= free or least > body.reach):
            free = min(free, least)
            continue
        skips_begin = link > 0 and ((link - 1) % pairs > 0 or row[7] == 0.0)
        gap, touching = _vertices(
            body, link, ax, ay, bx, by, offset, skips_begin, active, count, touch, found, touching
        )
        if len(body.vertices) > 1:
            other, touching = _edges(
                body, link, ax, ay, bx, by, offset, skips_begin, active, count, touch, found, touching
            )
            gap = min(gap, other)
        if busy:
            near = min(near, gap)
        else:
            free = min(free, gap)
    return free, near, touching


@compiled
def _beyond(ax: float, ay: float, bx: float, by: float) -> float:
    """Distance of the origin from the segment a-b."""
    dx, dy = bx - ax, by - ay
    t = -(ax * dx + ay * dy) / (dx * dx + dy * dy)
    t = min(max(t, 0.0), 1.0)
    return hypot(ax + t * dx, ay + t * dy)


@compiled
def _vertices(
    body: Body, link: int, ax: float, ay: float, bx: float, by: float, offset: float, skips_begin: bool,
    active: Integers, count: int, touch: float, found: Integers, touching: int,
) -> tuple[float, int]:  # fmt: skip
    """Least inactive gap of the vertices to the segment, in the object's frame; ``found`` as in ``scan``."""
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    least = inf
    for i in range(len(body.vertices)):
        px, py = body.vertices[i, 0] - ax, body.vertices[i, 1] - ay
        t = (px * dx + py * dy) / square
        if t <= 0.0 and skips_begin:
            continue
        t = min(max(t, 0.0), 1.0)
        px, py = px - t * dx, py - t * dy
        within = least + offset if least > touch else touch + offset
        if px * px + py * py > within * within:
            continue
        gap, code = hypot(px, py) - offset, contact_code(link, VERTEX, i)
        if gap <= touch and touching < MOST_ACTIVE:
            found[touching] = code
            touching += 1
        if gap < least and not _holds(active, count, code):
            least = gap
    return least, touching


@compiled
def _edges(
    body: Body, link: int, ax: float, ay: float, bx: float, by: float, offset: float, skips_begin: bool,
    active: Integers, count: int, touch: float, found: Integers, touching: int,
) -> tuple[float, int]:  # fmt: skip
    """Least inactive gap of the segment's ends to the edges; minus the object's width if the segment cuts the inside."""
    least, size = inf, len(body.vertices)
    enter, leave, deep = 0.0, 1.0, CUT * body.width
    for i in range(size):
        j = i + 1 if i + 1 < size else 0
        vx, vy = body.vertices[i, 0], body.vertices[i, 1]
        ex, ey = body.vertices[j, 0] - vx, body.vertices[j, 1] - vy
        length = hypot(ex, ey)
        da, db = ((ax - vx) * ey - (ay - vy) * ex) / length, ((bx - vx) * ey - (by - vy) * ex) / length
        if da > -deep and db > -deep:
            leave = -1.0
        elif da > -deep:
            enter = max(enter, (da + deep) / (da - db))
        elif db > -deep:
            leave = min(leave, (da + deep) / (da - db))
        for kind in (BEGIN, END):
            d = da if kind == BEGIN else db
            if d <= -deep or (kind == BEGIN and skips_begin) or (d - offset > least and d - offset > touch):
                continue
            px, py = (ax - vx, ay - vy) if kind == BEGIN else (bx - vx, by - vy)
            along = px * ex + py * ey
            if along <= 0.0 or along >= length * length:
                continue
            gap, code = d - offset, contact_code(link, kind, i)
            if gap <= touch and touching < MOST_ACTIVE:
                found[touching] = code
                touching += 1
            if gap < least and not _holds(active, count, code):
                least = gap
    if leave > enter:
        least = -body.width
    return least, touching


@compiled
def side_of(body: Body, links: Floats, code: int, x: float, y: float, theta: float) -> float:
    """+1 or -1 where the object lies to the left or right of a link that a vertex touches between the ends, else 0."""
    link, kind, index = code // 16384 // 3, code // 16384 % 3, code % 16384
    if kind != VERTEX:
        return 0.0
    segment, c, s = links[link], cos(theta), sin(theta)
    vx, vy = body.vertices[index, 0], body.vertices[index, 1]
    px, py = x + c * vx - s * vy - segment[0], y + s * vx + c * vy - segment[1]
    dx, dy = segment[2] - segment[0], segment[3] - segment[1]
    t = (px * dx + py * dy) / (dx * dx + dy * dy)
    if not 0.0 <= t <= 1.0:
        return 0.0
    return 1.0 if dx * (y - segment[1]) - dy * (x - segment[0]) > 0.0 else -1.0


@compiled
def range_left(body: Body, links: Floats, code: int, side: float, x: float, y: float, theta: float) -> float:
    """Length (m) left before the contact changes its kind: a vertex between the ends reaches one (``side`` not 0) or,
    at an end, goes back between them; the end of a link leaves the edge it touches.
    """
    link, kind, index = code // 16384 // 3, code // 16384 % 3, code % 16384
    segment, c, s = links[link], cos(theta), sin(theta)
    vx, vy = body.vertices[index, 0], body.vertices[index, 1]
    px, py = x + c * vx - s * vy, y + s * vx + c * vy
    if kind == VERTEX:
        dx, dy = segment[2] - segment[0], segment[3] - segment[1]
        length = hypot(dx, dy)
        along = ((px - segment[0]) * dx + (py - segment[1]) * dy) / length
    else:
        follow = index + 1 if index + 1 < len(body.vertices) else 0
        ex, ey = body.vertices[follow, 0] - vx, body.vertices[follow, 1] - vy
        length = hypot(ex, ey)
        fx, fy = (segment[0], segment[1]) if kind == BEGIN else (segment[2], segment[3])
        along = ((fx - px) * (c * ex - s * ey) + (fy - py) * (s * ex + c * ey)) / length
    within = min(along, length - along)
    return within if side != 0.0 or kind != VERTEX else -within


@compiled
def write_contact(
    body: Body, links: Floats, skin: float, code: int, side: float, x: float, y: float, theta: float, row: Floats
) -> float:
    """Write the contact's row for ``contact_solve`` and return its gap.

    Beyond its range (see ``range_left``) a contact of a vertex on a given ``side``, or of an edge, is extended.
    """
    link, kind, index = code // 16384 // 3, code // 16384 % 3, code % 16384
    segment = links[link]
    c, s = cos(theta), sin(theta)
    vx, vy = body.vertices[index, 0], body.vertices[index, 1]
    px, py = x + c * vx - s * vy, y + s * vx + c * vy
    if kind == VERTEX:
        dx, dy = segment[2] - segment[0], segment[3] - segment[1]
        t = ((px - segment[0]) * dx + (py - segment[1]) * dy) / (dx * dx + dy * dy)
        if side == 0.0:
            t = min(max(t, 0.0), 1.0)
            fx, fy = segment[0] + t * dx, segment[1] + t * dy
            distance = hypot(px - fx, py - fy)
            nx, ny = (px - fx) / distance, (py - fy) / distance
        else:
            length = hypot(dx, dy)
            nx, ny = -side * dy / length, side * dx / length
            distance = (px - segment[0]) * nx + (py - segment[1]) * ny
        hx, hy = px - body.radius * nx, py - body.radius * ny
    else:
        follow = index + 1 if index + 1 < len(body.vertices) else 0
        ex, ey = body.vertices[follow, 0] - vx, body.vertices[follow, 1] - vy
        length = hypot(ex, ey)
        nx, ny = (-c * ey - s * ex) / length, (c * ex - s * ey) / length
        fx, fy = (segment[0], segment[1]) if kind == BEGIN else (segment[2], segment[3])
        distance = nx * (px - fx) + ny * (py - fy)
        hx, hy = fx + distance * nx, fy + distance * ny
    row[0], row[1], row[2], row[3] = hx - x, hy - y, nx, ny
    row[4] = segment[5] - segment[4] * (hy - segment[1])
    row[5] = segment[6] + segment[4] * (hx - segment[0])
    row[6] = body.friction
    return distance - segment[7] - body.radius - skin
