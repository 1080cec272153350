"""What comes after an impact, or after sustained contact has ended: flight, or sustained contact, and with what.

A rebound with the speed v' towards which the wall accelerates by the demand gamma > 0 is followed by others after
2 v' / gamma, 2 e v' / gamma, ...: for e < 1 infinitely many in the time 2 v' / (gamma (1 - e)). Once the hops are lower than
``HOP``, that is taken at once: the disk stays in contact. What this changes is of the order of the hop, v'^2. Where
gamma <= 0 the wall draws back and the disk leaves, at whatever speed. For e = 1 hops never end; only a disk that already
moves with the wall stays.
"""

from __future__ import annotations

from math import atan2, hypot, inf, pi, sqrt

from palmar.mechanics.compiled import compiled
from palmar.mechanics.impact.capture_state import (
    FLIGHT,
    LEFT_BODY,
    LEFT_OTHER,
    LEFT_UNTIL,
    MODE,
    MOST_TOUCHING,
    ONE,
    TWO,
    VX,
    VY,
    Bench,
    T,
    X,
    Y,
    hold,
)
from palmar.mechanics.impact.contact_view import BASE, END, PALM, SIDE, demand, gap_at, wall_at
from palmar.mechanics.impact.finger_motion import CaptureHand
from palmar.mechanics.impact.holding import fastest_rate, foot_within, move_between, place_between
from palmar.mechanics.impact.next_contact import TOUCH

HOP = 1e-12
"""Height of hops, in reaches, that are sustained contact if e < 1."""
HOP_ELASTIC = 1e-28
"""The same for e = 1: the rounding of a speed."""
ROUNDING = 1e-14
"""Part of the speed that is none."""


@compiled
def _look_at(hand: CaptureHand, at: Bench, body: int, feature: int, side: float, near: float, count: int) -> int:
    """Add the contact to those that touch if it does and parts slowly; returns their number."""
    s = at.state
    gap, foot = gap_at(hand, at.fingers, body, feature, side, s[T], s[X], s[Y])
    if abs(gap) > near or not foot_within(hand, body, feature, foot) or count == MOST_TOUCHING:
        return count
    row = at.touching[count]
    nx, ny, wx, wy, _ = wall_at(hand, at.fingers, body, feature, side, s[T], s[X], s[Y])
    row[0], row[1], row[2], row[3], row[4] = body, feature, side, nx, ny
    row[5] = demand(hand, at.fingers, body, feature, side, s[T], s[X], s[Y], s[VX], s[VY])
    row[6] = (s[VX] - wx) * nx + (s[VY] - wy) * ny
    return count + 1


@compiled
def look(hand: CaptureHand, at: Bench, near: float) -> int:
    """Write the contacts with gaps of at most ``near`` to ``touching``; returns their number."""
    n = len(hand.lengths)
    count = _look_at(hand, at, PALM, SIDE, 1.0 if at.state[Y] > 0.0 else -1.0, near, 0)
    for f in range(2):
        count = _look_at(hand, at, 1 + f * n, BASE, 1.0, near, count)
        for j in range(n):
            b = 1 + f * n + j
            count = _look_at(hand, at, b, SIDE, 1.0, near, count)
            count = _look_at(hand, at, b, SIDE, -1.0, near, count)
            count = _look_at(hand, at, b, END, 1.0, near, count)
    return count


@compiled
def _others_part(at: Bench, count: int, i: int, j: int, ax: float, ay: float, slow: float) -> bool:
    """Whether, with the acceleration (ax, ay), no touching contact but i and j is run into."""
    for k in range(count):
        row = at.touching[k]
        if k != i and k != j and row[6] <= slow and row[3] * ax + row[4] * ay < row[5] - 1e-9 * abs(row[5]):
            return False
    return True


@compiled
def _slow_enough(parting: float, load: float, hop: float) -> bool:
    return load > 0.0 and parting * parting <= 2.0 * load * hop


@compiled
def _two(hand: CaptureHand, at: Bench, count: int, hop: float, slow: float) -> bool:
    """Hold by the first two contacts whose loads are positive."""
    for i in range(count):
        for j in range(i + 1, count):
            one, other = at.touching[i], at.touching[j]
            cosine = one[3] * other[3] + one[4] * other[4]
            square = 1.0 - cosine * cosine
            if square < 1e-12:
                continue
            first, second = (one[5] - cosine * other[5]) / square, (other[5] - cosine * one[5]) / square
            if not (_slow_enough(one[6], first, hop) and _slow_enough(other[6], second, hop)):
                continue
            ax, ay = first * one[3] + second * other[3], first * one[4] + second * other[4]
            if _others_part(at, count, i, j, ax, ay, slow):
                hold(at, 0, i)
                hold(at, 1, j)
                at.state[MODE] = TWO
                place_between(hand, at)
                return True
    return False


@compiled
def _one(hand: CaptureHand, at: Bench, count: int, hop: float, slow: float) -> bool:
    """Hold by the first contact whose demand is positive."""
    s = at.state
    for i in range(count):
        row = at.touching[i]
        if row[1] == BASE or row[0] == PALM or not _slow_enough(row[6], row[5], hop):
            continue
        if _others_part(at, count, i, i, row[5] * row[3], row[5] * row[4], slow):
            gap, _ = gap_at(hand, at.fingers, int(row[0]), int(row[1]), row[2], s[T], s[X], s[Y])
            s[VX], s[VY] = s[VX] - row[6] * row[3], s[VY] - row[6] * row[4]
            s[X], s[Y] = s[X] - gap * row[3], s[Y] - gap * row[4]
            hold(at, 0, i)
            s[MODE] = ONE
            return True
    return False


@compiled
def settle(hand: CaptureHand, at: Bench, e: float, parting: float, body: int, frictional: bool, reach: float) -> None:
    """Choose the mode after contact with ``body``, from which the disk parts at the speed ``parting``."""
    s = at.state
    hop = (HOP if e < 1.0 else HOP_ELASTIC) * reach
    fastest, speed = fastest_rate(hand, at.fingers), hypot(s[VX], s[VY])
    scale = fastest * (fastest * reach + 2.0 * speed)
    slow = max(sqrt(2.0 * scale * hop), ROUNDING * speed)
    s[MODE], s[LEFT_BODY], s[LEFT_OTHER] = FLIGHT, -1.0, -1.0
    if parting > slow:
        return
    count = look(hand, at, 4.0 * hop + 10.0 * TOUCH * reach)
    if (not frictional and _two(hand, at, count, hop, slow)) or _one(hand, at, count, hop, slow):
        return
    s[LEFT_BODY] = body
    for k in range(count):
        if int(at.touching[k, 0]) != body and abs(at.touching[k, 6]) <= slow:
            s[LEFT_OTHER] = at.touching[k, 0]
    s[LEFT_UNTIL] = sqrt(0.5 * TOUCH * reach / scale) if scale > 0.0 else inf


@compiled
def pressed_from_all_sides(at: Bench, count: int) -> bool:
    """Whether no direction leads away from all touching contacts: no two neighbouring normals are more than pi apart."""
    for i in range(count):
        following = 2.0 * pi
        for k in range(count):
            one, other = at.touching[i], at.touching[k]
            turn = atan2(one[3] * other[4] - one[4] * other[3], one[3] * other[3] + one[4] * other[4])
            turn = turn if turn > 1e-9 else turn + 2.0 * pi
            following = min(following, turn)
        if following > pi + 1e-9:
            return False
    return count >= 2


@compiled
def still_between(
    hand: CaptureHand, at: Bench, e: float, frictional: bool, reach: float,
    b1: int, f1: int, s1: int, b2: int, f2: int, s2: int,
) -> None:  # fmt: skip
    """The limit of impacts to and fro between two contacts without time between them, for e < 1: neither is approached."""
    for k in range(2):
        row = at.touching[k]
        row[0], row[1], row[2] = (b1, f1, s1) if k == 0 else (b2, f2, s2)
        hold(at, k, k)
    move_between(hand, at)
    settle(hand, at, e, 0.0, b2, frictional, reach)
    at.state[LEFT_OTHER] = b1
