"""Where a disk or convex polygon touches the links of a hand.

Every link is a capsule about a segment, and the object a polygon about its reference point, rounded by a radius: a disk
is a polygon of one vertex. Candidates for a contact of a link are, each with its gap,

- a vertex against the link: distance of the vertex from the segment, less both radii;
- an end of the segment against an edge of the object, where it projects into the edge.

Both are true distances outside, so no pair that is apart ever counts as touching. A line link (half thickness 0) that
meets a polygon gets a skin of ``SKIN`` hand lengths: it makes the way of a corner around a fingertip smooth.
``contact_scan`` looks for them.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing.limit_surface import LimitSurface, disk_surface, polygon_surface

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
SKIN = 1e-6
"""Skin in hand lengths, and never less than ten times the error of a stride, which it has to hide."""
TOUCH = 2e-8
"""Gaps up to this part of the finger's length touch."""
CUT = 1e-6
"""Depth, in widths of the object, from which a link is inside it."""
VERTEX, BEGIN, END = 0, 1, 2
MOST_ACTIVE = 12


class Body(NamedTuple):
    """Vertices (V, 2) counter-clockwise about the reference point, rounding radius, reach, least width, friction.

    ``edges`` (V, 3): direction (x, y) and length of the edge that begins at each vertex. ``single``: ``single_tables``, if
    they have been made.
    """

    vertices: Floats
    edges: Floats
    radius: float
    reach: float
    width: float
    friction: float
    surface: LimitSurface
    single: Floats = np.empty((0, 8))


def disk_body(radius: float, friction: float, surface: LimitSurface | None = None) -> Body:
    """A disk of ``radius`` (m), with uniform pressure unless a limit surface is given."""
    r = float(radius)
    return Body(np.zeros((1, 2)), np.zeros((1, 3)), r, r, 2.0 * r, float(friction), surface or disk_surface(r))


def polygon_body(vertices: ArrayLike, friction: float, surface: LimitSurface | None = None) -> Body:
    """A convex polygon about its reference point (centre of pressure), with uniform pressure unless given otherwise."""
    corners = np.ascontiguousarray(vertices, dtype=float)
    steps = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    edges = np.column_stack([steps / lengths[:, None], lengths])
    outward = np.stack([edges[:, 1], -edges[:, 0]], axis=1)
    width = min(float(np.ptp(corners @ normal)) for normal in outward)
    reach = float(np.hypot(corners[:, 0], corners[:, 1]).max())
    return Body(corners, edges, 0.0, reach, width, float(friction), surface or polygon_surface(corners))


class Scale(NamedTuple):
    """Lengths (m): skin of line links against polygons, gap that touches, error allowed per stride, depths of a cut.

    A link deeper than ``cut`` in a polygon counts as inside it rather than touching; ``deep`` if it touches already.
    """

    skin: float
    touch: float
    error: float
    cut: float
    deep: float


@compiled
def scale_of(length: float, body: Body, tolerance: float) -> Scale:
    """The kernel's small lengths for fingers of ``length`` (m)."""
    cut, error = CUT * body.width, tolerance * length
    skin = max(SKIN * length, 10.0 * error) if body.radius == 0.0 else 0.0
    return Scale(skin, TOUCH * length, error, cut, cut + 4.0 * error)


@inlined
def contact_code(link: int, kind: int, index: int) -> int:
    """One integer for a candidate: the link's row, vertex or end of the link, number of the vertex or edge."""
    return (link * 3 + kind) * 16384 + index


@inlined
def kind_of(code: int) -> int:
    """VERTEX, BEGIN or END."""
    return code // 16384 % 3


@inlined
def link_of(code: int) -> int:
    """The link's row of a candidate."""
    return code // 16384 // 3


@compiled
def side_of(body: Body, links: Floats, code: int, x: float, y: float, theta: float) -> float:
    """+1 or -1 where the object lies to the left or right of a link that a vertex touches between the ends, else 0."""
    link, kind, index = code // 16384 // 3, code // 16384 % 3, code % 16384
    if kind != VERTEX:
        return 0.0
    segment = links[link]
    c, s = cosine_sine(theta)
    vx, vy = body.vertices[index, 0], body.vertices[index, 1]
    px, py = x + c * vx - s * vy - segment[0], y + s * vx + c * vy - segment[1]
    dx, dy = segment[2] - segment[0], segment[3] - segment[1]
    t = (px * dx + py * dy) / (dx * dx + dy * dy)
    if not 0.0 <= t <= 1.0:
        return 0.0
    return 1.0 if dx * (y - segment[1]) - dy * (x - segment[0]) > 0.0 else -1.0


@inlined
def range_left(body: Body, links: Floats, code: int, side: float, x: float, y: float, c: float, s: float) -> float:
    """Length (m) left before the contact changes its kind: a vertex between the ends reaches one (``side`` not 0) or,
    at an end, goes back between them; the end of a link leaves the edge it touches.
    """
    link, kind, index = code // 16384 // 3, code // 16384 % 3, code % 16384
    segment = links[link]
    vx, vy = body.vertices[index, 0], body.vertices[index, 1]
    px, py = x + c * vx - s * vy, y + s * vx + c * vy
    if kind == VERTEX:
        dx, dy = segment[2] - segment[0], segment[3] - segment[1]
        length = sqrt(dx * dx + dy * dy)
        along = ((px - segment[0]) * dx + (py - segment[1]) * dy) / length
    else:
        ex, ey, length = body.edges[index, 0], body.edges[index, 1], body.edges[index, 2]
        fx, fy = (segment[0], segment[1]) if kind == BEGIN else (segment[2], segment[3])
        along = (fx - px) * (c * ex - s * ey) + (fy - py) * (s * ex + c * ey)
    within = min(along, length - along)
    return within if side != 0.0 or kind != VERTEX else -within


@inlined
def write_contact(
    body: Body, links: Floats, skin: float, code: int, side: float, x: float, y: float, c: float, s: float, row: Floats
) -> float:
    """Write the contact's row for ``contact_solve`` and return its gap; c, s are the cosine and sine of the angle.

    Beyond its range (see ``range_left``) a contact of a vertex on a given ``side``, or of an edge, is extended.
    """
    link, kind, index = code // 16384 // 3, code // 16384 % 3, code % 16384
    segment = links[link]
    vx, vy = body.vertices[index, 0], body.vertices[index, 1]
    px, py = x + c * vx - s * vy, y + s * vx + c * vy
    if kind == VERTEX:
        dx, dy = segment[2] - segment[0], segment[3] - segment[1]
        t = ((px - segment[0]) * dx + (py - segment[1]) * dy) / (dx * dx + dy * dy)
        if side == 0.0:
            t = min(max(t, 0.0), 1.0)
            fx, fy = segment[0] + t * dx, segment[1] + t * dy
            nx, ny = px - fx, py - fy
            distance = sqrt(nx * nx + ny * ny)
            nx, ny = nx / distance, ny / distance
        else:
            length = sqrt(dx * dx + dy * dy)
            nx, ny = -side * dy / length, side * dx / length
            distance = (px - segment[0]) * nx + (py - segment[1]) * ny
        hx, hy = px - body.radius * nx, py - body.radius * ny
    else:
        ex, ey = body.edges[index, 0], body.edges[index, 1]
        nx, ny = -c * ey - s * ex, c * ex - s * ey
        fx, fy = (segment[0], segment[1]) if kind == BEGIN else (segment[2], segment[3])
        distance = nx * (px - fx) + ny * (py - fy)
        hx, hy = fx + distance * nx, fy + distance * ny
    row[0], row[1], row[2], row[3] = hx - x, hy - y, nx, ny
    row[4] = segment[5] - segment[4] * (hy - segment[1])
    row[5] = segment[6] + segment[4] * (hx - segment[0])
    row[6] = body.friction
    return distance - segment[7] - body.radius - skin
