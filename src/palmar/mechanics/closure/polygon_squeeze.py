"""Two fingers close on a convex polygon held at a height: the play between them, and where it ends.

Notation: D half palm width, L finger length, h half finger thickness, psi finger angle (0 = open), lift = height of
the polygon's lowest corner above the palm. A finger of thickness 2 h about its joint line touches the polygon where
the joint line touches the polygon grown by h, so lines and capsules are one case.

At a fixed lift the polygon can slide sideways between the fingers by the play

    g(psi) = sum over both sides of min over heights y in [0, L sin psi] of (D + y cot psi - x(y)),

x(y) being the grown polygon's boundary, a concave function. Each minimum is attained where the boundary's normal has the
elevation psi - 90 deg, or at the height of the fingertip (or of the base) if that point lies beyond the finger.
The squeeze is the first zero of g as psi grows. Up to 90 deg g only falls. Beyond, with e the elevation at the contact:

- while a finger touches with its side, its term falls and is concave, with the rate -y / sin^2 psi;
- once it touches with its tip it does so from then on, with the rate -L sin(psi - e) / cos e: the term falls until
  e < psi - 180 deg, when the tip goes on under the object, and is rising and convex from there;
- with both tips in touch g is falling, then rising.

So the first zero is found for certain, in three stages. Derived in docs/derivations/polygons.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import asin, atan2, hypot, pi

import numpy as np
from numpy.typing import ArrayLike

from palmar.mechanics.closure.bracketing import falling_zero, halved
from palmar.mechanics.closure.polygon_outline import RIGHT_ANGLE, Bools, Floats, Indices, Views, views

ROUNDING = 2e-13
"""Play above minus this share of the lengths involved counts as room."""
ANGLE_ROUNDING = 1e-12
FLATTEST = 1e-9
"""The fingers stay this far (rad) from the palm line, where their cotangent is infinite."""
NEARLY_FLAT = 1e-3 - RIGHT_ANGLE


@dataclass(frozen=True)
class Bout:
    """One polygon at M orientations before one hand (m)."""

    sides: Views
    half_palm: float
    finger_length: float
    half_thickness: float

    @property
    def size(self) -> int:
        """Number M of orientations."""
        return len(self.sides.angle) // 2

    @property
    def room(self) -> float:
        """How far (m) the play may seem negative by rounding."""
        return ROUNDING * (self.half_palm + self.finger_length + float(np.abs(self.sides.corners).max()))

    @property
    def last_psi(self) -> float:
        """Finger angle at which the finger's round tip rests on the palm."""
        return pi - max(asin(min(self.half_thickness / self.finger_length, 1.0)), FLATTEST)

    def at(self, index: Indices | Bools) -> Bout:
        """Some of the orientations."""
        chosen = np.flatnonzero(index) if index.dtype == np.bool_ else index
        return replace(self, sides=self.sides.at(np.concatenate([chosen, chosen + self.size])))


def bout(
    vertices: ArrayLike, orientations: ArrayLike, half_palm: float, finger_length: float, half_thickness: float
) -> Bout:
    """A polygon, (N, 2) counter-clockwise in m, at each orientation (M,) in rad before a hand."""
    return Bout(views(vertices, orientations), half_palm, finger_length, half_thickness)


@dataclass(frozen=True)
class Touch:
    """What the fingers at one angle do to the polygon.

    Each side's term of the play (m) and its rate over psi, the elevation of the contact normal (rad), and whether the
    tip makes the contact: all (2, M).
    """

    terms: Floats
    rates: Floats
    elevations: Floats
    at_tip: Bools

    @property
    def play(self) -> Floats:
        """The play g (M,) in m."""
        both: Floats = self.terms[0] + self.terms[1]
        return both

    @property
    def rate(self) -> Floats:
        """Rate (M,) of the play over psi."""
        both: Floats = self.rates[0] + self.rates[1]
        return both


def touch(at: Bout, psi: Floats, lift: Floats) -> Touch:
    """Play and contacts at finger angles psi (M,) in rad and lifts (M,) in m."""
    sides, length, h = at.sides, at.finger_length, at.half_thickness
    angle, raised = np.concatenate([psi, psi]), np.concatenate([lift, lift])
    cosine, sine = np.tile(np.cos(psi), 2), np.tile(np.sin(psi), 2)
    x, y = sides.corner(sides.support(angle - RIGHT_ANGLE))
    y = y + raised
    height, tip_height = y - h * cosine, length * sine
    term = at.half_palm + (y * cosine - h) / sine - x
    rate = -height / sine**2
    elevation = angle - RIGHT_ANGLE
    at_tip = height > tip_height
    tips = np.flatnonzero(at_tip)
    if len(tips):
        x_tip, e = sides.at(tips).boundary(tip_height[tips] - raised[tips], h)
        term[tips] = at.half_palm + length * cosine[tips] - x_tip
        rate[tips] = -length * (sine[tips] - cosine[tips] * np.tan(e))
        elevation[tips] = e
    bases = np.flatnonzero((height < 0.0) & ~at_tip) if h > 0.0 else tips[:0]
    if len(bases):
        x_base, elevation[bases] = sides.at(bases).boundary(-raised[bases], h)
        term[bases], rate[bases] = at.half_palm - x_base, 0.0
    shape = (2, at.size)
    return Touch(term.reshape(shape), rate.reshape(shape), elevation.reshape(shape), at_tip.reshape(shape))


def squeeze(at: Bout, lift: Floats) -> Floats:
    """Finger angle psi (rad) at which closing ends at each lift (M,) in m; inf where the fingers pass the polygon by."""
    upright = np.full(at.size, RIGHT_ANGLE)
    reached = lift - at.half_thickness <= at.finger_length
    early = reached & (touch(at, upright, lift).play < -at.room)
    psi = np.full(at.size, np.inf)
    psi[early] = squeeze_before(at.at(early), lift[early])
    late = reached & ~early
    psi[late] = squeeze_beyond(at.at(late), lift[late])
    return psi


def squeeze_before(at: Bout, lift: Floats) -> Floats:
    """The zero below 90 deg, where the play only falls; the angle at which the tips come level if there was no room."""
    level = np.arcsin(np.clip((lift - at.half_thickness) / at.finger_length, 0.0, 1.0))
    return _zero(at, lift, np.maximum(level, FLATTEST), np.full(at.size, RIGHT_ANGLE))


def squeeze_beyond(at: Bout, lift: Floats) -> Floats:
    """The first zero of the play beyond 90 deg, where there is room at 90 deg; inf where there is none."""
    upright = np.full(at.size, RIGHT_ANGLE)
    level = pi - np.arcsin(np.clip((lift - at.half_thickness) / at.finger_length, 0.0, 1.0))  # below, the tips miss it
    end = np.clip(level - ANGLE_ROUNDING, upright, at.last_psi)
    undercuts, tip_starts = _undercut_starts(at, lift), _tip_starts(at, lift)
    falls = np.clip(undercuts.min(axis=0), upright, end)
    tips = np.clip(tip_starts.max(axis=0), falls, end)
    found = np.full(at.size, np.inf)
    closed = touch(at, falls, lift).play < -at.room
    found[closed] = _zero(at.at(closed), lift[closed], upright[closed], falls[closed])
    rises = falls + ANGLE_ROUNDING
    mixed = ~closed & (tips > rises)
    side = undercuts.argmin(axis=0)
    found[mixed] = _zero_beside_rising_tip(at.at(mixed), lift[mixed], rises[mixed], tips[mixed], side[mixed])
    rest = np.isinf(found)
    found[rest] = _zero_between_tips(at.at(rest), lift[rest], tips[rest], end[rest])
    return found


def _tip_starts(at: Bout, lift: Floats) -> Floats:
    """Angle beyond 90 deg (2, M) from which on each finger touches with its tip."""
    sides, length, h, raised = at.sides, at.finger_length, at.half_thickness, np.concatenate([lift, lift])

    def beyond_when_flush(edge: Indices) -> Bools:
        e = sides.elevation(edge)
        beyond: Bools = (e >= 0.0) & (raised + sides.corner(edge)[1] + h * np.sin(e) >= length * np.cos(e))
        return beyond

    step = sides.first_step(beyond_when_flush)
    height = raised + sides.corner(sides.stepped(step))[1]
    passing = pi - np.arcsin(np.clip(height / hypot(length, h), -1.0, 1.0)) - atan2(h, length)
    flush = RIGHT_ANGLE + np.where(step > 0, sides.elevation(sides.stepped(step - 1)), -RIGHT_ANGLE)
    starts: Floats = np.maximum(np.maximum(passing, flush), RIGHT_ANGLE)
    return starts.reshape(2, at.size)


def _undercut_starts(at: Bout, lift: Floats) -> Floats:
    """Angle beyond 90 deg (2, M) from which on each tip goes on under the object."""
    sides, length, h, raised = at.sides, at.finger_length, at.half_thickness, np.concatenate([lift, lift])

    def left_before(edge: Indices) -> Bools:
        e = sides.elevation(edge)
        height = raised + sides.corner(edge)[1] + h * np.sin(e)
        left: Bools = e >= -np.arcsin(np.clip(height / length, -1.0, 1.0))
        return left

    step = sides.first_step(left_before)
    height = raised + sides.corner(sides.stepped(step))[1]
    passing = pi - np.arcsin(np.clip(height / (length + h), -1.0, 1.0))
    flush = pi + np.where(step > 0, sides.elevation(sides.stepped(step - 1)), -RIGHT_ANGLE)
    starts: Floats = np.maximum(passing, flush)
    return starts.reshape(2, at.size)


def _zero(at: Bout, lift: Floats, low: Floats, high: Floats) -> Floats:
    """Where a play that falls from low to high ends."""

    def play(some: Indices, psi: Floats) -> tuple[Floats, Floats]:
        here = touch(at.at(some), psi, lift[some])
        return here.play + at.room, here.rate

    return falling_zero(play, low, high)


def _zero_between_tips(at: Bout, lift: Floats, low: Floats, high: Floats) -> Floats:
    """Both tips touch from ``low`` on: the play falls, then rises."""
    least, _ = halved(lambda psi: touch(at, psi, lift).rate < 0.0, low, high)
    found = np.full(at.size, np.inf)
    closed = touch(at, least, lift).play < -at.room
    found[closed] = _zero(at.at(closed), lift[closed], low[closed], least[closed])
    return found


def _zero_beside_rising_tip(at: Bout, lift: Floats, low: Floats, high: Floats, tip: Indices) -> Floats:
    """One finger's side touches, the other's tip goes on under the object: a concave term that falls, a convex that rises.

    Branch and bound: the chord bounds the first term from below, its end tangents the second; the sum is monotone
    where the largest rate of the first and the largest of the second add up to less than 0.
    """
    first_a, first_b = np.full(at.size, np.inf), np.full(at.size, np.inf)
    item, a, b = np.arange(at.size), low, high
    while len(item):
        here, side, each = at.at(item), tip[item], np.arange(len(item))
        at_a, at_b = touch(here, a, lift[item]), touch(here, b, lift[item])
        alive = (_lowest(at_a, at_b, b - a, side) < -at.room) & (a < first_a[item])
        steepest = at_b.rates[side, each] + at_a.rates[1 - side, each]
        settled = (steepest < 0.0) | (b - a < 1e-13)
        hit = np.flatnonzero(alive & settled & (at_b.play < -at.room))
        hit = hit[np.argsort(-a[hit])]  # of several hits of one item the first one counts
        first_a[item[hit]], first_b[item[hit]] = a[hit], b[hit]
        split = alive & ~settled
        item, middle = np.tile(item[split], 2), 0.5 * (a + b)[split]
        a, b = np.concatenate([a[split], middle]), np.concatenate([middle, b[split]])
    closed = np.isfinite(first_a)
    first_a[closed] = _zero(at.at(closed), lift[closed], first_a[closed], first_b[closed])
    return first_a


def _lowest(at_a: Touch, at_b: Touch, width: Floats, tip: Indices) -> Floats:
    """Lower bound of the play between two angles where one term is concave and the other, a tip's, convex."""
    each = np.arange(len(tip))
    tip_a, tip_b = at_a.terms[tip, each], at_b.terms[tip, each]
    rate_a, rate_b = at_a.rates[tip, each], at_b.rates[tip, each]
    side_a, side_b = at_a.terms[1 - tip, each], at_b.terms[1 - tip, each]
    bend = rate_b - rate_a
    steep = at_b.elevations[tip, each] < NEARLY_FLAT  # the tangent would be all rounding there
    meet = np.clip((tip_a - tip_b + rate_b * width) / np.where((bend > 0.0) & ~steep, bend, np.inf), 0.0, width)
    meet = np.where(steep, width, meet)
    chord = side_a + (side_b - side_a) * meet / np.where(width > 0.0, width, 1.0)
    tangent_b = np.where(steep, -np.inf, tip_b - rate_b * (width - meet))
    inside = chord + np.maximum(tip_a + rate_a * meet, tangent_b)
    lowest: Floats = np.minimum(np.minimum(at_a.play, at_b.play), inside)
    return lowest
