"""The staircase of good postures, and whether any of them leaves a polygon room between the fingers.

A posture is a finger angle psi and the height T of the tips over the polygon's lowest corner. A side's elevation is then
min(e(T), psi - 90 deg), e(T) that of the boundary at height T; it falls neither with psi nor with T. So the postures whose
elevations sum to at least -2 alpha, called good, are those on or above a falling staircase, T >= reach(psi).
"""

from __future__ import annotations

import numpy as np

from palmar.mechanics.closure.bracketing import halved
from palmar.mechanics.closure.polygon_outline import RIGHT_ANGLE, Bools, Floats, Indices
from palmar.mechanics.closure.polygon_squeeze import ANGLE_ROUNDING, Bout, touch

NARROWEST = 1e-13
"""Angles (rad) closer than this are not told apart."""
BESIDE = 4.0 * ANGLE_ROUNDING
"""How far (rad) from a step of the staircase its other side is looked at."""
LEVEL = 1e-13
"""Heights that differ by this share of the finger length are one level."""
SHORT = 1e-6


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

    With ``any_will_do`` any such angle instead of the first. Both ends lie on one side of 90 deg. Branch and bound,
    split at the steps of the staircase. Where room appears between two steps some angle there is given, not the first.
    """
    found = np.full(at.size, np.inf)
    for psi in (low, high):
        good = has_room(at, psi, reach(at, psi, alpha))
        found[good] = np.minimum(found[good], psi[good])
    item, a, b = np.arange(at.size), low, high
    tip_a, tip_b = reach(at, a, alpha), reach(at, b - BESIDE, alpha)
    while len(item):
        open_ = (np.isinf(found[item]) if any_will_do else a < found[item]) & (b - a > NARROWEST)
        level = tip_a - tip_b < LEVEL * at.finger_length
        open_ &= ~(level & (b >= found[item]))
        wide, flat = open_ & ~level, open_ & level
        open_[wide] = _could_have_room(at.at(item[wide]), a[wide], b[wide], tip_a[wide], tip_b[wide])
        open_[flat] = _could_have_room_on_level(at.at(item[flat]), a[flat], b[flat], tip_b[flat])
        item, level, a, b, tip_a, tip_b = item[open_], level[open_], a[open_], b[open_], tip_a[open_], tip_b[open_]
        here, middle = at.at(item), 0.5 * (a + b)
        middle[~level] = _nearest_step(here.at(~level), alpha[item[~level]], a[~level], b[~level])
        tip, before = reach(here, middle, alpha[item]), reach(here, middle - BESIDE, alpha[item])
        good = has_room(here, middle, tip)
        np.minimum.at(found, item[good], middle[good])
        item, a, b = np.tile(item, 2), np.concatenate([a, middle]), np.concatenate([middle, b])
        tip_a, tip_b = np.concatenate([tip_a, tip]), np.concatenate([before, tip_b])
    return found


def has_room(at: Bout, psi: Floats, tip: Floats) -> Bools:
    """Whether the highest good posture, with the tip just so far over the lowest corner, is off the palm and has room."""
    lift = at.finger_length * np.sin(psi) - tip
    room = lift >= -at.room
    room[room] = touch(at.at(room), psi[room], np.maximum(lift[room], 0.0)).play >= -at.room
    return room


def _could_have_room(at: Bout, a: Floats, b: Floats, tip_a: Floats, tip_b: Floats) -> Bools:
    """Whether a bound leaves open that the highest good posture somewhere between two angles has room.

    Each side's term is largest at an end of the interval of angles, and at an end of that of lifts.
    """
    heights = at.finger_length * np.sin([a, b])
    highest, lowest = heights.max(axis=0) - tip_b, np.maximum(heights.min(axis=0) - tip_a, 0.0)
    could: Bools = highest >= -at.room
    some = np.flatnonzero(could)
    lifts = np.maximum(np.concatenate([np.minimum(lowest, highest)[some], highest[some]]), 0.0)
    terms = touch(at.at(np.tile(some, 4)), np.repeat([a[some], b[some]], 2, axis=0).ravel(), np.tile(lifts, 2)).terms
    could[some] = terms.reshape(2, 4, len(some)).max(axis=1).sum(axis=0) >= -at.room
    return could


def _could_have_room_on_level(at: Bout, a: Floats, b: Floats, tip: Floats) -> Bools:
    """The same with the tip always so far over the lowest corner.

    A side's term is then L cos psi and a part that only grows with psi; below 90 deg the play has one peak.
    """
    play = touch(at, b, np.maximum(at.finger_length * np.sin(b) - tip, 0.0)).play
    could: Bools = at.finger_length * np.sin([a, b]).max(axis=0) - tip >= -at.room
    could &= play + 2.0 * at.finger_length * (np.cos(a) - np.cos(b)) >= -at.room
    early = could & (b <= RIGHT_ANGLE)
    here = at.at(early)
    could[early] = (_slope_on_level(here, a[early], tip[early]) > 0.0) & (
        _slope_on_level(here, b[early], tip[early]) < 0.0
    )
    return could


def _slope_on_level(at: Bout, psi: Floats, tip: Floats) -> Floats:
    here = touch(at, psi, np.maximum(at.finger_length * np.sin(psi) - tip, 0.0))
    along = at.finger_length * np.cos(psi)
    by_side = np.where(here.at_tip, -at.finger_length * np.sin(psi), here.rates - np.tan(here.elevations) * along)
    slope: Floats = by_side.sum(axis=0)
    return slope


def _nearest_step(at: Bout, alpha: Floats, a: Floats, b: Floats) -> Floats:
    """The step of the staircase before the middle of an interval, else the one after it, else the middle."""
    middle = 0.5 * (a + b)
    tip, near = reach(at, middle, alpha), 1e-12 * at.finger_length
    chosen = middle
    for shift in (-near, near):
        elevations = at.sides.boundary(np.tile(tip + shift, 2), at.half_thickness)[1].reshape(2, -1)
        least, total = elevations.min(axis=0), elevations.sum(axis=0)
        steepest = np.where(least >= -alpha, -alpha, -2.0 * alpha - least)
        step = np.where(total >= -2.0 * alpha, RIGHT_ANGLE + steepest, np.inf)
        inside = (step > a + SHORT * (b - a)) & (step < b - SHORT * (b - a))
        chosen = np.where(inside, step, chosen)
    return chosen
