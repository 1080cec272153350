"""Where in a stride a new contact begins, or one that there is leaves its range: a sure look-out.

The stride's interpolant is searched for the first moment at which another candidate's gap has fallen to zero: an
interval is left only where bounds on the closing speed (links not in touch) or on the change of the closing speed
(further points of links in touch) rule a contact out, or where it is shorter than ``FINEST``.
"""

from __future__ import annotations

from math import inf, sqrt

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing.closing_course import pose_after
from palmar.mechanics.pushing.closing_flight import in_flight, turn_to_touch
from palmar.mechanics.pushing.closing_motion import LEFT, RIGHT, TIME, Bench
from palmar.mechanics.pushing.contact_scan import further_gaps
from palmar.mechanics.pushing.crossing import next_point
from palmar.mechanics.pushing.hand_pose import HandMotion, fastest_turn, place_links, row_count
from palmar.mechanics.pushing.polygon_contacts import Body, Scale, link_of, range_left

PASSES = 120
CLOSEST = 1e-13
"""Bracket (rad) in which a new candidate appears (a tip that comes before an edge); time goes on by that."""
FINEST = 1e-4
"""Intervals (rad) in which a further contact that came and went would go unnoticed."""
LONGEST_SEARCH = 0.05
"""A contact's begin is located from a bracket not longer than this (rad)."""


@inlined
def gaps_after(
    hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale, far: float, h: float, part: float
) -> tuple[float, float]:
    """Least gaps at the fraction ``part``: of links not in touch, and of further candidates of those in touch.

    Links not in touch that began the stride farther than ``far`` away are left out.
    """
    x, y, theta = pose_after(at, h, part)
    place_links(hand, at.state[TIME] + part * h, at.state[RIGHT], at.state[LEFT], at.links)
    return further_gaps(body, at.links, row_count(hand), scale, x, y, theta, at.active, count, at.apart, far, at.found)


@inlined
def closing_speed(hand: HandMotion, at: Bench, reach: float) -> float:
    """Bound (m/rad) on how fast a link and the object approach in the stride whose stages are filled; links placed."""
    speed, turn = 0.0, 0.0
    for i in range(7):
        k = at.stages[i]
        speed, turn = max(speed, k[0] * k[0] + k[1] * k[1]), max(turn, abs(k[2]))
    fastest = abs(hand.vx) + abs(hand.vy)
    if hand.wall < inf:  # a tip on the wall and the base that gives way to it
        fastest += 2.0 * hand.links.sum() * fastest_turn(hand)
    for link in range(1, 2 * len(hand.links) + 1):
        row = at.links[link]
        length = sqrt((row[2] - row[0]) ** 2 + (row[3] - row[1]) ** 2) + row[7]
        fastest = max(fastest, sqrt(row[5] * row[5] + row[6] * row[6]) + abs(row[4]) * length)
    return fastest + 1.1 * (sqrt(speed) + reach * turn)


@inlined
def _gaps_now(at: Bench, rows: int, count: int) -> tuple[float, float]:
    """As ``gaps_after`` at the state, or less, from ``at.apart``."""
    free, near = inf, inf
    for link in range(rows):
        busy = False
        for k in range(count):
            busy = busy or link_of(at.active[k]) == link
        if busy:
            near = min(near, at.apart[link])
        else:
            free = min(free, at.apart[link])
    return free, near


@inlined
def first_touch(
    hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale, h: float, part: float
) -> float:  # fmt: skip
    """Fraction of the stride h, at most ``part``, at which the first new contact touches (gap of 0 to ``touch``)."""
    speed = closing_speed(hand, at, body.reach)
    far = speed * h * part + scale.touch
    free, near = _gaps_now(at, row_count(hand), count)
    bend = 0.5 * speed * (1.0 + speed / body.reach * 0.25)
    level = 0.5 * scale.touch
    if count == 0 and free > far:
        return part
    if min(free, near) <= level:
        free, near = gaps_after(hand, body, at, count, scale, inf, h, 0.0)
        if min(free, near) <= level:  # more touches than is known of
            return min(part, FINEST / h)
    if in_flight(hand, at, count):
        meets = turn_to_touch(hand, body, at, level + body.radius + hand.half_thickness + scale.skin) / h
        if meets >= part:
            return part
        next_free, next_near = gaps_after(hand, body, at, count, scale, inf, h, meets)
        if abs(min(next_free, next_near) - level) <= 0.4 * scale.touch:
            return meets
    a, step = 0.0, _sure_step(free, near, speed, bend, h)
    before, at_before = 0.0, inf
    while a < part:
        b = min(a + step, part)
        next_free, next_near = gaps_after(hand, body, at, count, scale, far, h, b)
        span = (b - a) * h
        if min(next_free, next_near) <= level:
            if span <= LONGEST_SEARCH:
                return _locate(
                    hand, body, at, count, scale, far, h, a, b,
                    min(free, near), min(next_free, next_near), before, at_before,
                )  # fmt: skip
            step = 0.5 * (b - a)
            continue
        clear = free + next_free > speed * span and 4.0 * min(near, next_near) > bend * span * span
        if clear or span <= FINEST:
            before, at_before = a, min(free, near)
            a, free, near = b, next_free, next_near
            step = _sure_step(free, near, speed, bend, h)
        else:
            step = 0.5 * (b - a)
    return part


@inlined
def _sure_step(free: float, near: float, speed: float, bend: float, h: float) -> float:
    """Part of the stride h over which new contacts can be ruled out if the gaps at its end are about as large."""
    return max(min(1.8 * free / speed, 1.8 * sqrt(near / bend)), FINEST) / h


@inlined
def first_change(hand: HandMotion, body: Body, at: Bench, count: int, slack: float, h: float, part: float) -> float:
    """Fraction of the stride, at most ``part``, at which an active contact is out of its range by ``slack``."""
    low, high = 0.0, part
    if _least_range(hand, body, at, count, h, part) > -slack:
        return part
    for _ in range(60):
        middle = 0.5 * (low + high)
        least = _least_range(hand, body, at, count, h, middle)
        if least > -slack:
            low = middle
        else:
            high = middle
            if least > -3.0 * slack:
                return high
    return high


@inlined
def _least_range(hand: HandMotion, body: Body, at: Bench, count: int, h: float, part: float) -> float:
    x, y, theta = pose_after(at, h, part)
    place_links(hand, at.state[TIME] + part * h, at.state[RIGHT], at.state[LEFT], at.links)
    least = inf
    c, s = cosine_sine(theta)
    for k in range(count):
        least = min(least, range_left(body, at.links, at.active[k], at.sides[k], x, y, c, s))
    return least


@compiled
def _locate(
    hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale, far: float, h: float,
    a: float, b: float, at_a: float, at_b: float, before: float, at_before: float,
) -> float:  # fmt: skip
    """Where in [a, b] the least gap falls to half of ``touch``; ``before`` a, where ``at_before`` is known, helps."""
    level, jump = 0.5 * scale.touch, -0.5 * body.width
    x1, f1, x2, f2 = a, at_a - level, before, at_before - level
    if at_b > jump and (at_before == inf or before == a):
        x2, f2 = b, at_b - level
    for k in range(PASSES):
        part = next_point(a, b, x1, f1, x2, f2, k)
        free, near = gaps_after(hand, body, at, count, scale, far, h, part)
        gap = min(free, near)
        if abs(gap - level) <= 0.4 * scale.touch:
            return part
        if gap > level:
            a = part
        else:
            b = part
        if jump < gap < inf:
            x1, f1, x2, f2 = part, gap - level, x1, f1
        if b - a <= CLOSEST / h:
            break
    return max(b, CLOSEST / h)
