"""The true pre-image of the closing motion on a table: straight fingers, a disk with centred pressure (chapter 3).

Every start lies on one way tau = const of ``closing_family`` and shares its fate. Where the fate changes from one
tau to the next is bisected; the region is what lies between the ways so found, the open hand and the axis. The way of
the last disk caught replaces the source's spiral and its chord: its part on the link is the spiral with the right
Delta, its part on the tip the outer boundary. Derived in docs/derivations/exact_region.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, atan, ceil, cos, pi, sqrt

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon
from shapely.geometry.base import BaseGeometry

from palmar.geometry.planar_set import EMPTY, areal, grown, outline, with_mirror_image
from palmar.geometry.quadrant import in_quadrant
from palmar.mechanics.pushing.closing import close_on_few
from palmar.mechanics.pushing.closing_family import (
    JUST_AFTER,
    NO_START,
    NO_WAY,
    begin_of_way,
    clearance,
    contact_on_way,
    end_of_way,
    fates,
    return_of_way,
    tau_limits,
    telling_taus,
    way_points,
    ways_may_return,
)
from palmar.mechanics.pushing.closing_tables import TIP_NODES, ClosingHand, Tables
from palmar.mechanics.pushing.closing_tip import HALF
from palmar.mechanics.pushing.first_touch import first_contacts
from palmar.models.outcome import Outcome

Floats = NDArray[np.float64]
SAMPLES, ASIDE = 256, (1e-6, 1e-4, 1e-3, 1e-2)
"""Ways looked at, besides those so far (rad) to both sides of every way that is known to tell: a range of fates in which
none of them falls would be missed."""
FEWEST, SHARE, SPARE = 32, 0.9, 1.02
"""Chords of a way at first; part of the tolerance that curves aim at; allowance for a way moved aside."""
MOST = 2**18
"""Chords of a way at last: disks a thousandth of the finger's length and less ask for more, and are flattened more."""
SNAP = 1e-12
"""Corners this near (radii) to axis and palm line lie on them."""


@dataclass(frozen=True)
class ExactSets:
    """Centre region, its outer side, contact and whole region (both halves, m); bound of the flattening (m).

    ``ways``: the tau (rad) between which starts are caught, None standing for "up to the palm and the joint".
    """

    centre: MultiPolygon
    outer: MultiPolygon
    contact: MultiPolygon
    whole: MultiPolygon
    flattening: float
    ways: tuple[tuple[float, float | None], ...]


@dataclass(frozen=True)
class ExactSides:
    """Inner and outer side of the right half (m), the bound (m) of their distance from the true boundary, and ``ways``."""

    inner: BaseGeometry
    outer: BaseGeometry
    flattening: float
    ways: tuple[tuple[float, float | None], ...]


@dataclass(frozen=True)
class _Closing:
    """A hand, its tables, its friction angle, and how far (m) curves may be flattened."""

    hand: ClosingHand
    tables: Tables
    alpha: float
    tolerance: float


@dataclass(frozen=True)
class _Way:
    """The part of a way from one angle of the finger to another (rad), its corners (N, 2) and the chords' error (m)."""

    tau: float
    begin: float
    end: float
    points: Floats
    bound: float


def exact_sets(hand: ClosingHand, tables: Tables, tolerance: float) -> ExactSets:
    """The regions of one hand and disk, boundaries flattened to about ``tolerance`` (m): inner and outer side."""
    sides = exact_sides(hand, tables, tolerance)
    if sides.inner.is_empty:
        return ExactSets(EMPTY, with_mirror_image(sides.outer), EMPTY, EMPTY, sides.flattening, sides.ways)
    centre = with_mirror_image(sides.inner)
    whole, grown_bound = grown(centre, hand.radius, tolerance)
    contact = with_mirror_image(_contacts(hand, sides.inner))
    flattening = max(sides.flattening, grown_bound)
    return ExactSets(centre, with_mirror_image(sides.outer), contact, whole, flattening, sides.ways)


def exact_sides(hand: ClosingHand, tables: Tables, tolerance: float) -> ExactSides:
    """The right half of the centre region, inner and outer side, which is all that decides about a start."""
    closing = _Closing(hand, tables, atan(hand.friction), tolerance)
    ways = caught_ways(closing)
    return ExactSides(*_halves(closing, ways), ways)


def caught_ways(closing: _Closing) -> tuple[tuple[float, float | None], ...]:
    """The intervals of tau in which the disk is caught."""
    return tuple((low, high) for low, high, caught in _runs(closing, False) if caught)


def _runs(closing: _Closing, returned: bool) -> list[tuple[float, float | None, bool]]:
    """Intervals of tau with whether the disk is caught, rising; None for the end of the last one: up to the hand."""
    low, high = tau_limits(closing.hand, closing.tables)
    known = telling_taus(closing.hand, closing.tables, closing.alpha)
    telling = [tau + side * aside for tau in known for aside in ASIDE for side in (-1.0, 1.0)]
    taus = np.sort([*np.linspace(low, high, SAMPLES + 2)[1:-1], *(tau for tau in telling if low < tau < high)])
    kinds, ends = np.empty(len(taus), np.int8), np.empty(len(taus))
    fates(closing.hand, closing.tables, closing.alpha, taus, returned, kinds, ends)
    begins = np.flatnonzero(np.diff(kinds, prepend=NO_WAY))
    runs = []
    for k, after in zip(begins, [*begins[1:], len(kinds)], strict=True) if len(begins) else ():
        stop = None if after == len(kinds) or kinds[after] == NO_WAY else float(ends[after])
        if kinds[k] != NO_WAY:
            runs.append((float(ends[k]), stop, bool(kinds[k])))
    return runs


def _halves(
    closing: _Closing, ways: tuple[tuple[float, float | None], ...]
) -> tuple[BaseGeometry, BaseGeometry, float]:
    """Inner and outer side of the right half, and the bound (m) of their distance from the true boundary."""
    inner: BaseGeometry = EMPTY
    outer: BaseGeometry = EMPTY
    worst = SHARE * closing.tolerance  # that of arcs, see _arc_corners
    for low, high in ways:
        inside, outside, bound = _between(closing, low, high, False)
        inner, outer = (inside, outside) if outer.is_empty else (inner | inside, outer | outside)
        worst = max(worst, bound)
    for low, high, caught in _runs(closing, True) if ways_may_return(closing.hand) else ():
        inside, outside, _ = _between(closing, low, high, True)
        inner, outer = (inner | inside, outer | outside) if caught else (inner - outside, outer - inside)
    for part, kept in _untouched(closing):
        inner, outer = (inner | part, outer | part) if kept else (inner - part, outer - part)
    return inner, outer, worst


def _between(
    closing: _Closing, low: float, high: float | None, returned: bool
) -> tuple[BaseGeometry, BaseGeometry, float]:
    """Starts between two ways: from the inner and the outer side, and the error (m) of the chords."""
    inside, outside, bound = _up_to_way(closing, low, returned)
    if high is None:
        return inside, outside, bound
    nearer, farther, other = _up_to_way(closing, high, returned)
    return inside - farther, outside - nearer, max(bound, other)


def _up_to_way(closing: _Closing, tau: float, returned: bool) -> tuple[BaseGeometry, BaseGeometry, float]:
    """The right half's starts from the hand out to a way, or to its part that has returned; and the error (m).

    From the inner and the outer side: the way is moved towards the hand, or outwards, by the error of its chords. Ways lie
    apart by at least R cos alpha per radian of tau, since the contact moves out at R or more and the motion leans by at
    most alpha from the normal. Where they spread more the way is moved farther: the error returned is chords and move
    together, and there are as many chords as keep it within the tolerance, up to ``MOST``.
    """
    few = _way(closing, tau, returned, FEWEST)
    if few is None:
        return EMPTY, EMPTY, 0.0
    spread = closing.hand.radius * cos(closing.alpha)
    moved = 1.0 + _widest_spread(closing, few) / spread
    chords = min(max(FEWEST, ceil(FEWEST * sqrt(few.bound * moved / (SHARE * closing.tolerance)))), MOST)
    worst, bound = few.bound * (FEWEST / chords) ** 2, 0.0
    while worst > bound:
        bound = SPARE * worst
        aside = bound / spread
        near, far = _way(closing, tau + aside, returned, chords), _way(closing, tau - aside, returned, chords)
        worst = max(near.bound if near else 0.0, far.bound if far else 0.0)
    return _enclosed(closing, near, returned, True), _enclosed(closing, far, returned, False), bound * moved


def _widest_spread(closing: _Closing, way: _Way) -> float:
    """How far (m) ways near this one are apart per radian of tau, at most: r' <= rho on the link, rho beta' on the tip."""
    hand, tables = closing.hand, closing.tables
    _, beta = contact_on_way(hand, tables, way.tau, way.end)
    passed = tables.rate[: ceil(beta / HALF * (TIP_NODES - 1)) + 1]
    return (hand.radius + hand.half_thickness) * max(1.0, float(passed.max()))


def _way(closing: _Closing, tau: float, returned: bool, chords: int) -> _Way | None:
    """A way, or its part that has returned, drawn with so many chords; None where no disk can stand on it."""
    hand, tables = closing.hand, closing.tables
    first = return_of_way if returned else begin_of_way
    begin = first(hand, tables, closing.alpha, tau)
    if not begin < hand.last:
        return None
    begin += JUST_AFTER if returned else 0.0
    end = end_of_way(hand, tables, closing.alpha, tau, begin)
    points = np.empty((chords + 1, 2))
    bound = way_points(hand, tables, tau, begin, end, points)
    return _Way(tau, begin, end, points, bound)


def _enclosed(closing: _Closing, way: _Way | None, returned: bool, clear: bool) -> BaseGeometry:
    """The right half's starts from the hand out to a way."""
    if way is None:
        return EMPTY
    hand, radius = closing.hand, closing.hand.radius
    x, y = way.points[-1]
    back, closure = pi, np.array([[0.0, max(y, radius)], [0.0, radius]])
    if way.end >= hand.last and x > 1e-9 * radius and y > radius * (1.0 + 1e-9):
        back = hand.last + HALF
        around = _clearance(closing, way.tau, way.end, back, clear)
        closure = around[len(around) // 2 :][::-1]
    start = np.array([[way.points[0, 0], radius]]) if returned else _clearance(closing, way.tau, way.begin, back, clear)
    return in_quadrant(np.concatenate([way.points, closure, start]), radius, SNAP * radius)


def _clearance(closing: _Closing, tau: float, psi: float, back: float, clear: bool) -> Floats:
    """The clearance of the finger at psi, from the joint out to the way tau: as many corners about joint as about end."""
    reach, beta = contact_on_way(closing.hand, closing.tables, tau, psi)
    points = np.empty((2 * _arc_corners(closing, max(back - psi - HALF, beta)), 2))
    clearance(closing.hand, psi, back, reach, beta, clear, points)
    return points


def _arc_corners(closing: _Closing, angle: float) -> int:
    """Corners of an arc of radius rho over this angle (rad), its chords and tangents off by at most SHARE tolerances."""
    rho = closing.hand.radius + closing.hand.half_thickness
    return 3 + ceil(angle / (2.0 * acos(1.0 / (1.0 + SHARE * closing.tolerance / rho))))


def _untouched(closing: _Closing) -> list[tuple[BaseGeometry, bool]]:
    """Parts of the right half that no finger reaches, each with whether a disk there is enclosed in the end."""
    hand = closing.hand
    points = np.empty((2 * _arc_corners(closing, HALF), 2))
    clearance(hand, hand.last, pi, hand.length, HALF, False, points)
    top = np.array([[0.0, points[-1, 1]], [0.0, hand.radius]])
    pocket = in_quadrant(np.concatenate([points, top]), hand.radius, SNAP * hand.radius)
    parts = [part for part in shapely.get_parts(pocket) if part.area > 1e-9 * hand.radius**2]
    if not parts:
        return []
    inside = np.array([shapely.point_on_surface(part).coords[0] for part in parts])
    codes = np.empty(len(parts), np.int8)
    close_on_few(hand, closing.tables, closing.alpha, inside, codes, np.empty((len(parts), 5)))
    return [
        (part, bool(code <= Outcome.CAGED.code)) for part, code in zip(parts, codes, strict=True) if code != NO_START
    ]


def _contacts(hand: ClosingHand, half: BaseGeometry) -> MultiPolygon:
    """First contact points on the right finger for the centres of a right half."""
    pieces = []
    for part in areal(half).geoms:
        ring = shapely.get_coordinates(shapely.segmentize(part.exterior, 0.02 * hand.length))
        touched = np.empty((len(ring), 2))
        first_contacts(hand, ring, touched)
        touched = touched[np.isfinite(touched[:, 0])]
        if len(touched) > 2:
            pieces.append(outline(touched))
    return areal(pieces[0] if len(pieces) == 1 else shapely.union_all(pieces))
