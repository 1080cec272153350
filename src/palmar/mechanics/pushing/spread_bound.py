"""How fast the motions of two disks without friction can part: a bound over a ball about one of them.

Derived in docs/derivations/certified_region.md. Two centres a distance d apart, d at most ``ball``, obey
d d' <= sum of load times allowance over the contacts of both. A contact between the ends of a link has no allowance as
long as the other centre is before the link, too; about a tip it is d^2 / (2 rho). The loads of the disk that is followed
are known, those of all others in the ball are bounded: at most two contacts carry, and every contact that any of them
can have is among the links within ``ball`` of touching.
"""

from __future__ import annotations

from math import acos, asin, atan2, cos, inf, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing.link_view import BEFORE, BEHIND, GAP, NX, NY, UX, UY, bend, guarded, neighbour

Floats = NDArray[np.float64]
CONE, MOST_SPEED, WEIGHT, ANGLE, STRAY, ONLY_END, LEAST_SPEED = range(7)
REACH_WIDTH = 7
"""Columns for a link: half angle (rad) of the normals that disks in the ball can meet, bound of the speed along them
(m/rad), allowance over d^2 (1/m), direction of the middle normal (rad), by how much (m) the step adds to the ball, and the
end (0, 1) at which all contacts are, or -1; least speed along the normals."""
OPPOSED, NARROWEST = 1e-4, 1e-3
"""Two contacts that come so near (rad) to opposing each other, or three to spanning the plane, are given up."""
WIDEST = 0.9
"""Part of a link's rho that a ball may measure while the link can touch a disk in it."""


class Growth(NamedTuple):
    """Bounds over a step: relative growth (1/rad) of the ball, inf if given up; sum of loads (m/rad) of any disk in it."""

    rate: float
    loads: float


@compiled
def soft(
    links: Floats, pairs: int, link: int, x: float, y: float, radius: float, seen: Floats, ball: float, half_step: float
) -> bool:
    """Whether a disk in the ball may be at, or beyond, an end of the link that is not guarded by its neighbour."""
    if seen[BEFORE] < ball and not guarded(
        links, pairs, link, 0, x, y, radius, max(-seen[BEFORE], 0.0) + ball, half_step
    ):
        return True
    return seen[BEHIND] < ball and not guarded(
        links, pairs, link, 1, x, y, radius, max(-seen[BEHIND], 0.0) + ball, half_step
    )


@inlined
def own_weight(seen: Floats, rho: float, ball: float, stray: float) -> float:
    """Allowance over d^2 (1/m) of a contact of the disk that is followed, at a link with a soft end.

    A disk beyond the end by at most s = d - (length from the foot to the end) is at most rho - sqrt(rho^2 - s^2) lower.
    """
    full = 0.5 / rho
    over = ball + stray - min(seen[BEFORE], seen[BEHIND])
    if over >= ball or over >= rho:
        return full
    return min(full, (rho - sqrt(rho * rho - over * over)) / (ball * ball))


@compiled
def reach_link(
    links: Floats, pairs: int, link: int, x: float, y: float, radius: float, seen: Floats, ball: float,
    half_step: float, bent: float, reached: Floats,
) -> None:  # fmt: skip
    """Fill ``reached`` with what disks in the ball can meet at a link; ``bent`` bounds the hand's acceleration."""
    row, stray = links[link], reached[STRAY]
    rho, wide, turn = radius + row[7], ball + stray, abs(row[4]) * half_step
    nx, ny, ux, uy = seen[NX], seen[NY], seen[UX], seen[UY]
    if soft(links, pairs, link, x, y, radius, seen, wide, half_step):
        reached[CONE] = asin(min(wide / (seen[GAP] + rho), 1.0)) + turn
        reached[WEIGHT] = 0.5 / rho
        reached[ONLY_END] = 0.0 if seen[BEFORE] < -wide else (1.0 if seen[BEHIND] < -wide else -1.0)
    else:
        dx, dy = row[2] - row[0], row[3] - row[1]
        length = sqrt(dx * dx + dy * dy)
        side = 1.0 if dx * (y - row[1]) - dy * (x - row[0]) > 0.0 else -1.0
        nx, ny = -side * dy / length, side * dx / length
        reached[CONE], reached[WEIGHT], reached[ONLY_END] = turn, 0.0, -1.0
    speed = sqrt(ux * ux + uy * uy)
    away = acos(min(max((ux * nx + uy * ny) / speed, -1.0), 1.0)) if speed > 0.0 else 0.0
    along = speed * cos(max(away - reached[CONE], 0.0))
    reached[MOST_SPEED] = max(along + abs(row[4]) * wide + bent * half_step, 0.0)
    along = speed * cos(min(away + reached[CONE], pi))
    reached[LEAST_SPEED] = along - abs(row[4]) * wide - bent * half_step
    reached[ANGLE] = atan2(ny, nx)


@inlined
def turned(angle: float) -> float:
    """An angle in (-pi, pi]."""
    while angle > pi:
        angle -= 2.0 * pi
    while angle <= -pi:
        angle += 2.0 * pi
    return angle


@inlined
def _one_contact(links: Floats, pairs: int, i: int, j: int, x: float, y: float) -> bool:
    """Whether two links meet at a joint that is convex seen from (x, y): no disk there has a contact with both."""
    low, high = min(i, j), max(i, j)
    if low == 0 or high != low + 1 or (low - 1) // pairs != (high - 1) // pairs:
        return False
    other, other_end = neighbour(pairs, low, 1)
    return bend(links, low, 1, other, other_end, x, y)[1] < 0.0


@inlined
def _tips_apart(links: Floats, reached: Floats, i: int, j: int, half_step: float) -> tuple[float, float]:
    """Least and greatest distance in the step of the two ends at which all contacts in the ball with the links are.

    (0, inf) unless all are at one end, for both links.
    """
    one, other = reached[i, ONLY_END], reached[j, ONLY_END]
    if one < 0.0 or other < 0.0:
        return 0.0, inf
    a, b = links[i], links[j]
    length_a, length_b = (0.0 if one == 0.0 else 1.0), (0.0 if other == 0.0 else 1.0)
    ax, ay = a[0] + length_a * (a[2] - a[0]), a[1] + length_a * (a[3] - a[1])
    bx, by = b[0] + length_b * (b[2] - b[0]), b[1] + length_b * (b[3] - b[1])
    ux, uy = a[5] - a[4] * (ay - a[1]), a[6] + a[4] * (ax - a[0])
    vx, vy = b[5] - b[4] * (by - b[1]), b[6] + b[4] * (bx - b[0])
    apart, play = sqrt((ax - bx) ** 2 + (ay - by) ** 2), sqrt((ux - vx) ** 2 + (uy - vy) ** 2) * half_step
    return apart - play, apart + play


@compiled
def angle_between(
    links: Floats, pairs: int, i: int, j: int, x: float, y: float, radius: float, reached: Floats,
    half_step: float, bent: float,
) -> float:  # fmt: skip
    """Greatest angle (rad) between the normals of a disk in the ball that touches both links; -1 if none can.

    About two ends G apart it is 2 arcsin(G / (2 rho)), whatever the disk, and no disk touches both if G > 2 rho.
    """
    one, other = reached[i], reached[j]
    if _one_contact(links, pairs, i, j, x, y):
        return -1.0
    middle, play = abs(turned(one[ANGLE] - other[ANGLE])), one[CONE] + other[CONE]
    low, high = middle - play, min(middle + play, pi)
    rho = radius + links[i, 7]
    if links[j, 7] != links[i, 7]:
        return high
    near, far = _tips_apart(links, reached, i, j, half_step)
    near, far = near - bent * half_step * half_step, far + bent * half_step * half_step
    if near > 2.0 * rho:
        return -1.0
    if far < 2.0 * rho:
        high = min(high, 2.0 * asin(far / (2.0 * rho)))
    if near > 0.0:
        least = 2.0 * asin(near / (2.0 * rho))
        if least > high:
            return -1.0
    return high if high >= low else -1.0


@compiled
def _spans(reached: Floats, i: int, j: int, k: int) -> bool:
    """Whether three normals out of their cones may span the plane, nearly."""
    one = turned(reached[j, ANGLE] - reached[i, ANGLE])
    two = turned(reached[k, ANGLE] - reached[i, ANGLE])
    own = reached[i, CONE]
    low = min(-own, min(one - reached[j, CONE], two - reached[k, CONE]))
    high = max(own, max(one + reached[j, CONE], two + reached[k, CONE]))
    return high - low >= pi - NARROWEST


@inlined
def in_corner(least: float, most: float, ball: float, radius: float) -> bool:
    """Whether two contacts hold one another's growth back, their normals between ``least`` and ``most`` (rad) apart.

    A disk that touches both is in a corner of what is allowed, and no other disk in the ball is so low as both allowances
    admit: if it has the one, it has less than none at the other, and only the difference of the loads makes them part.
    """
    part = 0.5 * ball / radius
    if least < 0.5 * pi or most >= pi or part >= 0.5:
        return False
    return sin(most) * sqrt(1.0 - part * part) > part * (1.0 - cos(most))


@compiled
def growth_of_others(
    links: Floats, pairs: int, x: float, y: float, radius: float, views: Floats, ball: float,
    half_step: float, bent: float, reached: Floats,
) -> Growth:  # fmt: skip
    """What the contacts of all disks in the ball add to its growth; ``reached[:, STRAY]`` is given."""
    count = 2 * pairs + 1
    rate, loads = 0.0, 0.0
    for i in range(count):
        one = reached[i]
        if views[i, GAP] > ball + one[STRAY]:
            one[MOST_SPEED] = -1.0
            continue
        if ball + one[STRAY] > WIDEST * (radius + links[i, 7]):
            return Growth(inf, inf)
        reach_link(links, pairs, i, x, y, radius, views[i], ball, half_step, bent, one)
        rate, loads = max(rate, one[WEIGHT] * one[MOST_SPEED]), max(loads, one[MOST_SPEED])
        for j in range(i):
            other = reached[j]
            if other[MOST_SPEED] < 0.0:
                continue
            apart = angle_between(links, pairs, i, j, x, y, radius, reached, half_step, bent)
            if apart < 0.0:
                continue
            if apart > pi - OPPOSED:
                return Growth(inf, inf)
            for k in range(j):
                if (
                    reached[k, MOST_SPEED] >= 0.0
                    and _spans(reached, i, j, k)
                    and angle_between(links, pairs, i, k, x, y, radius, reached, half_step, bent) >= 0.0
                    and angle_between(links, pairs, j, k, x, y, radius, reached, half_step, bent) >= 0.0
                ):
                    return Growth(inf, inf)
            against = max(-cos(apart), 0.0)
            scale = 1.0 / (1.0 - against * against)
            a = (one[MOST_SPEED] + against * other[MOST_SPEED]) * scale
            b = (other[MOST_SPEED] + against * one[MOST_SPEED]) * scale
            loads = max(loads, a + b)
            least = abs(turned(one[ANGLE] - other[ANGLE])) - one[CONE] - other[CONE]
            if in_corner(least, apart, ball, radius):
                rate = max(rate, one[WEIGHT] * (one[MOST_SPEED] - other[LEAST_SPEED]))
                rate = max(rate, other[WEIGHT] * (other[MOST_SPEED] - one[LEAST_SPEED]))
            else:
                rate = max(rate, one[WEIGHT] * a + other[WEIGHT] * b)
    return Growth(rate, loads)
