"""Whether some height above the palm exists at which friction holds a squeezed polygon.

At a finger angle psi a side's elevation is min(e(T), psi - 90 deg), e(T) that of the boundary at the tip's height T over
the polygon's lowest corner; it falls neither with psi nor with T. So the postures (psi, T) whose sum of elevations is
at least -2 alpha are those on or above a falling staircase, T >= reach(psi). Call them good. Derived in
docs/derivations/polygons.md:

- Up to 90 deg, raising the object and closing further only raises the sum, so a hold exists if the fingers squeeze the
  object on the palm by then and some good posture up to 90 deg leaves room.
- Beyond, the heights blocked at one psi form an interval. Its upper end, the crest, is where a rising object is squeezed.
  A hold begins where the crest, while it rises, comes to lie under the staircase; that is at a step of it, or where
  the fingers, after passing under a former crest, come to squeeze above it. Both kinds of heights are tried exactly.
"""

from __future__ import annotations

import numpy as np

from palmar.mechanics.closure.polygon_friction import friction_needed
from palmar.mechanics.closure.polygon_outline import RIGHT_ANGLE, Bools, Floats, Indices
from palmar.mechanics.closure.polygon_squeeze import ANGLE_ROUNDING, Bout, halved, squeeze, touch

ANGLE_TOLERANCE = 1e-10
"""Friction angles (rad) that differ by less count as equal: the limit counts as held."""
NARROWEST = 1e-13
NODES = 49
"""Finger angles beyond 90 deg at which the crest is looked at."""


def reach(at: Bout, psi: Floats, alpha: Floats) -> Floats:
    """Least height T (m) of the tip over the lowest corner at which the elevations sum to -2 alpha; inf where none is."""
    half = np.arange(at.size)
    right, left, h = at.sides.at(half), at.sides.at(half + at.size), at.half_thickness
    steepest = psi - RIGHT_ANGLE
    least = np.maximum(-2.0 * alpha - steepest, -RIGHT_ANGLE)

    def right_height(e: Floats) -> Floats:
        lowered = np.maximum(e - ANGLE_ROUNDING, -RIGHT_ANGLE)
        return right.corner(right.support(lowered))[1] + h * np.sin(lowered)

    def left_height(e: Floats) -> Floats:
        lowered = np.maximum(-2.0 * alpha - e - ANGLE_ROUNDING, -RIGHT_ANGLE)
        return left.corner(left.support(lowered))[1] + h * np.sin(lowered)

    def clipped(edge: Indices) -> Floats:
        return np.minimum(np.maximum(right.elevation(edge), least), steepest)

    step = right.first_step(lambda edge: right_height(clipped(edge)) >= left_height(clipped(edge)))
    below = np.where(step > 0, clipped(right.stepped(step - 1)), least)
    above = np.where(step < right.edges, clipped(right.stepped(step)), steepest)
    if h > 0.0:
        below, above = halved(lambda e: right_height(e) < left_height(e), below, above)
    needed = np.minimum(
        np.maximum(right_height(below), left_height(below)), np.maximum(right_height(above), left_height(above))
    )
    return np.where(steepest < -alpha - ANGLE_ROUNDING, np.inf, needed)


def first_good(at: Bout, alpha: Floats, low: Floats, high: Floats, any_will_do: bool = False) -> Floats:
    """First finger angle in [low, high] (rad) with a good posture that leaves room; inf where there is none.

    With ``any_will_do`` any such angle instead of the first. Both ends lie on one side of 90 deg. Branch and bound: at
    one side of the hand the term of the play is largest at an end of an interval of angles and of one of lifts.
    """
    found = np.full(at.size, np.inf)
    item, a, b, lift_a, lift_b = (
        np.arange(at.size),
        low,
        high,
        highest_good(at, alpha, low),
        highest_good(at, alpha, high),
    )
    for psi, lift in ((a, lift_a), (b, lift_b)):
        good = _has_room(at, psi, lift)
        found[good] = np.minimum(found[good], psi[good])
    while len(item):
        open_ = (np.isinf(found[item]) if any_will_do else a < found[item]) & (b - a > NARROWEST)
        open_[open_] = _could_have_room(at.at(item[open_]), a[open_], b[open_], lift_a[open_], lift_b[open_])
        item, a, b, lift_a, lift_b = item[open_], a[open_], b[open_], lift_a[open_], lift_b[open_]
        here, middle = at.at(item), 0.5 * (a + b)
        lift = highest_good(here, alpha[item], middle)
        good = _has_room(here, middle, lift)
        np.minimum.at(found, item[good], middle[good])
        item, a, b = np.tile(item, 2), np.concatenate([a, middle]), np.concatenate([middle, b])
        lift_a, lift_b = np.concatenate([lift_a, lift]), np.concatenate([lift, lift_b])
    return found


def highest_good(at: Bout, alpha: Floats, psi: Floats) -> Floats:
    """Greatest lift (m) at which the fingers at psi are in a good posture, -inf where none is."""
    highest: Floats = at.finger_length * np.sin(psi) - reach(at, psi, alpha)
    return highest


def _has_room(at: Bout, psi: Floats, lift: Floats) -> Bools:
    """Whether the lift is not below the palm and leaves room."""
    room = lift >= -at.room
    room[room] = touch(at.at(room), psi[room], np.maximum(lift[room], 0.0)).play >= -at.room
    return room


def _could_have_room(at: Bout, a: Floats, b: Floats, lift_a: Floats, lift_b: Floats) -> Bools:
    """Whether a bound leaves open that the highest good posture somewhere between two angles has room."""
    change = at.finger_length * (np.sin(b) - np.sin(a))  # the staircase only falls, the tips rise before 90 deg
    highest = np.maximum(np.maximum(lift_b, lift_b - change), -1.0)
    lowest = np.clip(np.minimum(lift_a, lift_a + change), 0.0, np.maximum(highest, 0.0))
    could = highest >= -at.room
    some = np.flatnonzero(could)
    lifts = np.maximum(np.concatenate([lowest[some], highest[some]]), 0.0)
    terms = touch(at.at(np.tile(some, 4)), np.repeat([a[some], b[some]], 2, axis=0).ravel(), np.tile(lifts, 2)).terms
    could[some] = terms.reshape(2, 4, len(some)).max(axis=1).sum(axis=0) >= -at.room
    return could


def holds_off_palm(at: Bout, alpha: Floats) -> Bools:
    """Whether the friction angle alpha > 0 (rad) holds the polygon at some height, for each orientation (M,).

    Whatever it says is held is held. A hold that only a second crest offers is missed if the fingers turn less than
    about 2 deg between their passing under the first crest and their next passing.
    """
    upright = np.full(at.size, RIGHT_ANGLE)
    held = touch(at, upright, np.zeros(at.size)).play < -at.room
    early = np.flatnonzero(held)
    some = first_good(at.at(early), alpha[early], (upright - alpha)[early], upright[early], any_will_do=True)
    held[early] = np.isfinite(some)
    rest = np.flatnonzero(~held)
    first = first_good(at.at(rest), alpha[rest], upright[rest], np.full(len(rest), at.last_psi))
    rest, first = rest[np.isfinite(first)], first[np.isfinite(first)]
    held[rest] = _held(at.at(rest), alpha[rest], crest(at.at(rest), first))
    rest = rest[~held[rest]]
    held[rest] = _held_at_later_crest(at.at(rest), alpha[rest])
    return held


def _held(at: Bout, alpha: Floats, lift: Floats) -> Bools:
    held = lift >= 0.0
    held[held] = friction_needed(at.at(held), lift[held]) <= alpha[held] + ANGLE_TOLERANCE
    return held


def _held_at_later_crest(at: Bout, alpha: Floats) -> Bools:
    """Tries the crest wherever it comes to lie under the staircase, at the nodes there, and above each former crest."""
    if at.size == 0:
        return np.zeros(0, dtype=np.bool_)
    nodes = np.linspace(RIGHT_ANGLE, at.last_psi, NODES)
    item, psi = np.repeat(np.arange(at.size), NODES), np.tile(nodes, at.size)
    good = _good_with_room(at.at(item), alpha[item], psi)
    enters = np.flatnonzero(good[1:] & ~good[:-1] & (item[1:] == item[:-1]))
    here = at.at(item[enters])
    into = halved(lambda each: ~_good_with_room(here, alpha[item[enters]], each), psi[enters], psi[enters + 1])[1]
    lift = crest(at.at(item), psi)
    over = _above_crests(at, lift.reshape(-1, NODES), nodes)
    items = np.concatenate([item[enters], item[good], over[0]])
    lifts = np.concatenate([crest(here, into), lift[good], over[1]])
    held = np.zeros(at.size, dtype=np.bool_)
    np.logical_or.at(held, items, _held(at.at(items), alpha[items], lifts))
    return held


def _good_with_room(at: Bout, alpha: Floats, psi: Floats) -> Bools:
    return _has_room(at, psi, highest_good(at, alpha, psi))


def crest(at: Bout, psi: Floats) -> Floats:
    """Upper end (m) of the lifts that are blocked at each finger angle beyond 90 deg; -1 where none is.

    The play is convex in the lift, with the rate -tan e_R - tan e_L.
    """
    bottom, top = np.zeros(at.size), at.finger_length * np.sin(psi) + at.half_thickness
    least, _ = halved(lambda lift: touch(at, psi, lift).elevations.sum(axis=0) > 0.0, bottom, top)
    blocked = touch(at, psi, least).play < -at.room
    upper = np.full(at.size, -1.0)
    here = at.at(blocked)
    upper[blocked] = halved(lambda lift: touch(here, psi[blocked], lift).play < -at.room, least[blocked], top[blocked])[
        1
    ]
    return upper


def _above_crests(at: Bout, crests: Floats, psi: Floats) -> tuple[Indices, Floats]:
    """Items and lifts just above a crest that the fingers pass under, where they squeeze a higher object later."""
    falls = (crests[:, 1:-1] > np.maximum(crests[:, :-2], -0.5)) & (crests[:, 1:-1] >= crests[:, 2:])
    item, node = np.nonzero(falls)
    here, after, low = at.at(item), psi[node + 2], crests[item, node + 1]
    high = here.finger_length + here.half_thickness + low * 0.0

    def still(lift: Floats) -> Bools:
        caught: Bools = squeeze(here, lift) <= after
        return caught

    above = halved(still, low, high)[1]
    later = np.isfinite(squeeze(here, above))
    return item[later], above[later]
