"""How a point stands before each link of a hand: gap, normal, speed of the hand, and how far the foot is from the ends.

A link keeps the centre of a disk of radius R at least rho = R + its half thickness away from its segment. Between links
that meet at a joint, the end of one may be *guarded* by the other (``guarded``): then a disk can touch the one only
between its ends there, and never falls below its line beyond that end.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, inlined

Floats = NDArray[np.float64]
GAP, NX, NY, SPEED, BEFORE, BEHIND, UX, UY = range(8)
VIEW_WIDTH = 8
"""Columns: gap (m); unit normal from the nearest point; normal speed of the hand there (m/rad); lengths along the link
from its begin to the foot of the perpendicular and from there to its end, negative off the link; velocity of the hand at
the nearest point."""
LEVEL = 1e-12
"""A neighbour that leans away by no more (rad) counts as straight on."""


@inlined
def view_link(row: Floats, x: float, y: float, radius: float, seen: Floats) -> None:
    """Fill ``seen`` for one link."""
    dx, dy = row[2] - row[0], row[3] - row[1]
    length = sqrt(dx * dx + dy * dy)
    dx, dy = dx / length, dy / length
    px, py = x - row[0], y - row[1]
    along = px * dx + py * dy
    t = min(max(along, 0.0), length)
    nx, ny = px - t * dx, py - t * dy
    distance = sqrt(nx * nx + ny * ny)
    nx, ny = nx / distance, ny / distance
    ux, uy = row[5] - row[4] * t * dy, row[6] + row[4] * t * dx
    seen[GAP], seen[NX], seen[NY], seen[SPEED] = distance - radius - row[7], nx, ny, ux * nx + uy * ny
    seen[BEFORE], seen[BEHIND], seen[UX], seen[UY] = along, length - along, ux, uy


@compiled
def view_all(links: Floats, count: int, x: float, y: float, radius: float, seen: Floats) -> None:
    """``view_link`` of the first ``count`` links."""
    for k in range(count):
        view_link(links[k], x, y, radius, seen[k])


@inlined
def slip(row: Floats, x: float, y: float, vx: float, vy: float) -> float:
    """Speed (m/rad) in the link's frame of a point at (x, y) that moves at (vx, vy) in the table's."""
    rx, ry = vx - row[5] + row[4] * (y - row[1]), vy - row[6] - row[4] * (x - row[0])
    return sqrt(rx * rx + ry * ry)


@inlined
def neighbour(pairs: int, link: int, end: int) -> tuple[int, int]:
    """(row, end) of what is joined to the ``end`` (0 begin, 1 end) of a link, (-1, 0) at a tip."""
    if link == 0:
        return (1, 0) if end == 1 else (pairs + 1, 0)
    place = (link - 1) % pairs
    if end == 0:
        if place > 0:
            return link - 1, 1
        return (0, 1) if link == 1 else (0, 0)
    return (link + 1, 0) if place < pairs - 1 else (-1, 0)


@compiled
def bend(links: Floats, link: int, end: int, other: int, other_end: int, x: float, y: float) -> tuple[float, float]:
    """(cosine, sine) of the turn from a link's outward direction at its end to its neighbour, towards the side of (x, y)."""
    row, next_row = links[link], links[other]
    sign, next_sign = (1.0 if end == 1 else -1.0), (1.0 if other_end == 0 else -1.0)
    dx, dy = sign * (row[2] - row[0]), sign * (row[3] - row[1])
    fx, fy = next_sign * (next_row[2] - next_row[0]), next_sign * (next_row[3] - next_row[1])
    scale = 1.0 / sqrt((dx * dx + dy * dy) * (fx * fx + fy * fy))
    cross = dx * (y - row[1]) - dy * (x - row[0])
    side = 1.0 if cross > 0.0 else -1.0
    return (dx * fx + dy * fy) * scale, side * (dx * fy - dy * fx) * scale


@compiled
def guarded(
    links: Floats, pairs: int, link: int, end: int, x: float, y: float, radius: float, excess: float, half_step: float
) -> bool:
    """Whether the neighbour keeps every disk that is beyond this end by at most ``excess`` (m) above the link's line.

    With phi the turn of ``bend``, rho and rho_n the distances that the link and its neighbour keep: a place beyond the
    end by s, before the neighbour, has the height (rho_n + s sin phi) / cos phi over the line, which is at least rho if
    rho_n >= rho cos phi and sin phi >= 0. It is before the neighbour if s cos phi + rho sin phi is at most its length.
    All within ``half_step`` (rad) of the moment at which the links are.
    """
    other, other_end = neighbour(pairs, link, end)
    if other < 0:
        return False
    c, s = bend(links, link, end, other, other_end, x, y)
    turn = abs(links[link, 4] - links[other, 4]) * half_step
    row, next_row = links[link], links[other]
    rho, rho_next = radius + row[7], radius + next_row[7]
    length = sqrt((next_row[2] - next_row[0]) ** 2 + (next_row[3] - next_row[1]) ** 2)
    c_most, s_most = c + turn, abs(s) + turn
    return (
        c > turn
        and s - turn >= -LEVEL
        and rho_next >= rho * min(c_most, 1.0)
        and excess * c_most + rho * s_most <= length
        and excess * s_most < rho_next
    )
