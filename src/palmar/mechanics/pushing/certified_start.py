"""Whether all disks that start in a ball are caught, or none of them: one motion followed, and a bound on the rest.

No friction, any hand of ``hand_pose``. The disk in the middle of the ball is followed by ``sweeping_step``; the ball
that holds all others grows as ``spread_bound`` says, and by what the path is off. Caught is certain as soon as the
tips are too close for any disk in the ball to leave the pocket, now and at all base angles that may follow
(``enclosure``); lost is certain at the end of the motion, if the ball is outside the pocket then and nothing could
stall a finger on the way. Everything else is left open. Proof: docs/derivations/certified_region.md.
"""

from __future__ import annotations

from math import acos, exp, inf, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.batch import in_parts
from palmar.mechanics.compiled import compiled, compiled_to_allocate, inlined
from palmar.mechanics.pushing.closing_end import in_pocket, opening
from palmar.mechanics.pushing.enclosure import Closed
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion, place_links
from palmar.mechanics.pushing.link_view import BEFORE, BEHIND, GAP, LEVEL, NX, NY, slip, view_all
from palmar.mechanics.pushing.spread_bound import (
    REACH_WIDTH,
    STRAY,
    growth_of_others,
    in_corner,
    own_weight,
    soft,
)  # fmt: skip
from palmar.mechanics.pushing.sweeping_step import (
    AT_BEGIN,
    AT_END,
    AT_MIDDLE,
    MOST,
    Path,
    Room,
    room,
    shortest,
    step,
)  # fmt: skip

Floats = NDArray[np.float64]
OPEN, CAUGHT, LOST, OVERLAPS = range(4)
TOUCH, SLACK = 1e-11, 1e-9
"""Gap that touches, and speed within which a contact keeps up, in finger lengths."""
LONGEST, SHORTEST, MOST_STEPS, MOST_TRIES = 0.1, 1e-12, 6_000, 60
FINE, ROUGH = 0.5, 0.01
"""A step adds to the ball at most half of it, or this part of the distance that a link keeps, while contacts count."""
OPPOSING = -0.5
"""Cosine of the angle between normals from which the growth of the ball depends much on that angle."""
HONEST = 2e-3
"""What a path is off may add this part of the ball per radian."""
ROOM_LEFT = 1.99
"""In disk radii: no segment of this length leads past a link, or is both in the pocket and outside."""
ROWS_PER_TASK = 16


class Ball(NamedTuple):
    """Time (rad), centre (m), radius (m) of a ball of disks on their way."""

    t: float
    x: float
    y: float
    size: float


@compiled
def _bent(hand: HandMotion) -> float:
    """Bound (m/rad^2) on the acceleration of any point of a link."""
    total, turn = 0.0, 1.0
    for j in range(len(hand.links)):
        turn += hand.ratios[0, j]
        total += hand.links[j] * turn * turn
    return total


@inlined
def _stride(links: Floats, pairs: int, views: Floats, at: Ball, vx: float, vy: float, radius: float) -> float:
    """A step over which little that counts comes into reach."""
    h, count = LONGEST, 2 * pairs + 1
    for k in range(count):
        seen, row = views[k], links[k]
        turn, pace = max(abs(row[4]), 0.1), slip(row, at.x, at.y, vx, vy)
        h = min(h, 0.3 / turn)
        least, most = FINE * at.size, 0.3 * radius
        if seen[GAP] > at.size:
            allowed = max(0.9 * (seen[GAP] - at.size), least)
        else:
            against = _most_opposed(views, count, k, at.size)
            if soft(links, pairs, k, at.x, at.y, radius, seen, at.size, 0.0):
                allowed = least if against < OPPOSING else max(least, ROUGH * (radius + row[7]))
            else:
                allowed = max(max(least, ROUGH * radius), min(min(seen[BEFORE], seen[BEHIND]) - at.size, most))
                if against < OPPOSING:
                    h = min(h, max(0.1 * sqrt(2.0 * max(1.0 + against, 0.0)) / turn, SHORTEST))
        if pace * h > allowed:
            h = allowed / pace
    return h


@inlined
def _most_opposed(views: Floats, count: int, link: int, size: float) -> float:
    """Least cosine of the angle between this link's normal and that of another which the ball may soon meet; else 1."""
    one, least = views[link], 1.0
    for k in range(count):
        other = views[k]
        if k != link and other[GAP] <= 3.0 * size:
            least = min(least, one[NX] * other[NX] + one[NY] * other[NY])
    return least


@inlined
def _own_rate(
    links: Floats, pairs: int, x: float, y: float, radius: float, views: Floats, reached: Floats, path: Path,
    i: int, j: int, ball: float, half: float,
) -> float:  # fmt: skip
    """What the contacts of the disk that is followed add to the relative growth (1/rad)."""
    one, other, play = 0.0, 0.0, 0.0
    for k in (i, j):
        if k < 0:
            continue
        wide, rho, weight = ball + reached[k, STRAY], radius + links[k, 7], 0.0
        if soft(links, pairs, k, x, y, radius, views[k], wide, half):
            weight = own_weight(views[k], rho, ball, reached[k, STRAY])
        if k == i:
            one = weight
        else:
            other = weight
        play += 1.1 * reached[k, STRAY] / rho + abs(links[k, 4]) * half
    if j >= 0:
        between = views[i, NX] * views[j, NX] + views[i, NY] * views[j, NY]
        apart = acos(min(max(between, -1.0), 1.0))
        if in_corner(apart - play, apart + play, ball, radius):
            return max(max(one * (path.first - path.low_second), other * (path.second - path.low_first)), 0.0)
    return one * path.first + other * path.second


@inlined
def _grown(
    pairs: int, radius: float, bent: float, room_: Room, reached: Floats, path: Path, i: int, j: int,
    at: Ball, vx: float, vy: float, h: float,
) -> float:  # fmt: skip
    """Size of the ball after a step, inf if it is given up.

    With b the part that does not grow with the ball, d' <= rate d + b from the size e on stays below
    (e + b h) exp(rate h). The rate is for a ball that is a little larger, which has to be enough.
    """
    links, views, half = room_.links[AT_MIDDLE], room_.views[AT_MIDDLE], 0.5 * h
    mx = 0.5 * (at.x + path.x) + 0.125 * h * (vx - path.vx)
    my = 0.5 * (at.y + path.y) + 0.125 * h * (vy - path.vy)
    ux = 1.5 * (path.x - at.x) / h - 0.25 * (vx + path.vx)
    uy = 1.5 * (path.y - at.y) / h - 0.25 * (vy + path.vy)
    begin_x = 6.0 * (path.x - at.x) / (h * h) - (4.0 * vx + 2.0 * path.vx) / h
    begin_y = 6.0 * (path.y - at.y) / (h * h) - (4.0 * vy + 2.0 * path.vy) / h
    end_x = -6.0 * (path.x - at.x) / (h * h) + (2.0 * vx + 4.0 * path.vx) / h
    end_y = -6.0 * (path.y - at.y) / (h * h) + (2.0 * vy + 4.0 * path.vy) / h
    bow = sqrt(max(begin_x * begin_x + begin_y * begin_y, end_x * end_x + end_y * end_y))
    for k in range(2 * pairs + 1):
        turn, pace = abs(links[k, 4]), slip(links[k], mx, my, ux, uy)
        force = bent + bow + turn * (2.0 * pace + turn * (radius + links[k, 7] + abs(views[k, GAP])))
        reached[k, STRAY] = (pace + 0.5 * force * half / (1.0 - turn * h)) * half
    deep = max(path.drift, max((bent + bow) * h * h / 128.0 - path.least, 0.0))
    ball = 1.02 * at.size
    for _ in range(4):
        others = growth_of_others(links, pairs, mx, my, radius, views, ball, half, bent, reached)
        if others.rate == inf:
            return inf
        rate = others.rate + _own_rate(links, pairs, mx, my, radius, views, reached, path, i, j, ball, half)
        off = path.rest + deep * (path.first + path.second + others.loads) / at.size
        size = (at.size + off * h) * exp(rate * h)
        if size <= ball:
            return size
        ball = 1.02 * size
    return inf


@compiled
def _enclosed(links: Floats, pairs: int, views: Floats, at: Ball, radius: float, closed: bool) -> int:
    """CAUGHT if every disk of the ball is in the pocket and it is ``closed``, LOST if none is in it, else OPEN.

    The way from the centre to another disk of the ball passes no link, for both keep their distance, and not between
    the tips, from which the centre is farther than the ball is wide. Closed counts only while the tips are what is
    nearest in the two fingers: then the pocket of ``in_pocket`` is the one that the disk cannot leave.
    """
    ax, ay, bx, by = links[pairs, 2], links[pairs, 3], links[2 * pairs, 2], links[2 * pairs, 3]
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    part = ((at.x - ax) * dx + (at.y - ay) * dy) / square if square > 0.0 else 0.0
    part = min(max(part, 0.0), 1.0)
    px, py = at.x - ax - part * dx, at.y - ay - part * dy
    if px * px + py * py <= at.size * at.size:
        return OPEN
    if at.size > ROOM_LEFT * radius:
        for k in range(2 * pairs + 1):
            if views[k, GAP] <= at.size:
                return OPEN
    if not in_pocket(links, pairs, at.x, at.y):
        return LOST
    apart = sqrt(square)
    near = apart < 2.0 * (radius + links[1, 7]) and opening(links, pairs) >= apart - 2.0 * links[1, 7] - LEVEL
    return CAUGHT if closed and near else OPEN


@compiled
def certify(hand: HandMotion, radius: float, closed: Closed, start: Ball, room_: Room, reached: Floats) -> int:
    """CAUGHT, LOST or OPEN for all valid starts in the ball; OVERLAPS if its centre is no valid start."""
    pairs, length, bent, at = len(hand.links), hand.links.sum(), _bent(hand), start
    count, touch, slack = 2 * pairs + 1, TOUCH * length, SLACK * length
    links, views = room_.links[AT_BEGIN], room_.views[AT_BEGIN]
    place_links(hand, at.t, MOVING, MOVING, links)
    view_all(links, count, at.x, at.y, radius, views)
    for k in range(count):
        if views[k, GAP] < -touch:
            return OVERLAPS
    for _ in range(MOST_STEPS):
        ended = at.t >= hand.last
        if ended and opening(links, pairs) >= 2.0 * radius:
            return LOST
        if ended or at.t >= min(closed.caught_from, closed.lost_from):
            verdict = _enclosed(links, pairs, views, at, radius, at.t >= closed.caught_from)
            if ended or verdict == CAUGHT or (verdict == LOST and at.t >= closed.lost_from):
                return verdict
        moves, i, j, vx, vy = shortest(views, count, touch, slack)
        if not moves:
            return OPEN
        h = min(_stride(links, pairs, views, at, vx, vy, radius), hand.last - at.t)
        if at.t < closed.caught_from < at.t + h:
            h = closed.caught_from - at.t
        at = _advance(hand, radius, bent, room_, reached, at, vx, vy, i, j, h, touch)
        if at.size == inf:
            return OPEN
        for k in range(count):
            for c in range(8):
                links[k, c], views[k, c] = room_.links[AT_END, k, c], room_.views[AT_END, k, c]
    return OPEN


@inlined
def _advance(
    hand: HandMotion, radius: float, bent: float, room_: Room, reached: Floats, at: Ball,
    vx: float, vy: float, i: int, j: int, h: float, touch: float,
) -> Ball:  # fmt: skip
    """The ball after a step of at most h, cut where a further link begins to touch; size inf if it is given up."""
    pairs = len(hand.links)
    for _ in range(MOST_TRIES):
        path = step(hand, radius, room_, at.t, at.x, at.y, vx, vy, i, j, h)
        cut = _first_cut(room_.views[AT_BEGIN], room_.views[AT_END], 2 * pairs + 1, i, j, touch)
        if cut < 1.0 and h > SHORTEST:
            h = max(h * cut, SHORTEST)
            continue
        off = path.rest + path.drift * (path.first + path.second) / at.size
        if off > HONEST * at.size and h > SHORTEST:
            h *= 0.5
            continue
        size = _grown(pairs, radius, bent, room_, reached, path, i, j, at, vx, vy, h)
        return Ball(at.t + h, path.x, path.y, size)
    return Ball(at.t, at.x, at.y, inf)


@inlined
def _first_cut(before: Floats, after: Floats, count: int, i: int, j: int, touch: float) -> float:
    """Fraction of the step, by false position, at which the first further link touches; 1 if none does."""
    part = 1.0
    for k in range(count):
        if k in (i, j) or after[k, GAP] >= -touch:
            continue
        gap = max(before[k, GAP], touch)
        part = min(part, (gap + 0.5 * touch) / (gap - after[k, GAP]))
    return part


@compiled_to_allocate
def certify_rows(hand: HandMotion, radius: float, closed: Closed, starts: Floats, codes: NDArray[np.int8]) -> None:
    """``certify`` for each row (x, y, size of the ball) of ``starts``."""
    room_, reached = room(), np.zeros((MOST, REACH_WIDTH))
    for k in range(len(starts)):
        ball = Ball(hand.first, starts[k, 0], starts[k, 1], starts[k, 2])
        codes[k] = certify(hand, radius, closed, ball, room_, reached)


def certify_all(
    hand: HandMotion, radius: float, closed: Closed, starts: Floats, threads: int | None = None
) -> NDArray[np.int8]:
    """Batch: ``starts`` (N, 3), x, y and size of each ball (m), all valid starts in which it speaks for -> codes (N,)."""
    rows, codes = np.ascontiguousarray(starts, dtype=float), np.zeros(len(starts), np.int8)

    def part(some: slice) -> None:
        certify_rows(hand, radius, closed, rows[some], codes[some])

    in_parts(part, len(rows), ROWS_PER_TASK, threads)
    return codes
