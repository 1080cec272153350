"""What touch buys: how wide an approach is certain to end in a grasp, with which opening, and with how few sensors.

An approach cuts what is known of the object at the ends of the sensors' stretches; its depth does not matter. A sensor is
good if all places at which it fires fit into the closing region at once: then one approach and one placing suffice. So
the pre-image of "approach, place, close" over a travel T is a strip of height T over every good piece of the profile,
beside the pre-image of closing alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import shapely
from shapely import LineString, MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.approach import Doubt, grow
from palmar.behaviours.planner import Opening, Planner
from palmar.geometry.planar_set import areal
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.sensors import Sensors, Stretch
from palmar.regions.profile import DEAD, Piece, Profile, body_lines
from palmar.studies.plan import opening_of, planner_of

HALVINGS = 20
NARROWEST = 1e-3
"""Stretches below this share of the finger's length are not asked for."""
OPENINGS = 31


@dataclass(frozen=True)
class Touch:
    """At one opening (rad), widths (m) across the way: touched in all, felt, felt and good, good and in one run.

    ``sensory`` is the pre-image (m, hand frame) of approaching over ``travel`` (m), placing and closing.
    """

    opening: float
    touched: float
    felt: float
    good: float
    connected: float
    travel: float
    sensory: MultiPolygon
    closing: MultiPolygon

    @property
    def ratio(self) -> float:
        """Of the connected part of the sensory pre-image to all of it; 0 where there is none."""
        return self.connected / self.good if self.good > 0.0 else 0.0


def touch_at(case: Case, opening: float, travel: float, closure: Closure = Closure.FRICTIONAL) -> Touch:
    """What the case's sensors buy with the fingers at one opening; raises NotCoveredError as ``plan`` does."""
    planner, stretches = planner_of(case, closure)
    return _seen_touch(planner, opening_of(case, stretches, opening, closure), travel)


def _seen_touch(planner: Planner, seen: Opening, travel: float) -> Touch:
    good = _good_sensors(planner, seen)
    pieces = seen.profile.pieces
    width = np.array([each.points[-1, 0] - each.points[0, 0] for each in pieces])
    felt = np.array([each.owner != DEAD for each in pieces])
    sure = np.array([each.owner in good for each in pieces])
    strips = [_strip(each, travel) for each, yes in zip(pieces, sure, strict=True) if yes]
    return Touch(
        seen.angle,
        float(width.sum()),
        float(width[felt].sum()),
        float(width[sure].sum()),
        _widest_run(width, sure),
        travel,
        areal(shapely.union_all(strips)),
        seen.target.region,
    )


def touch_by_opening(case: Case, travel: float, closure: Closure = Closure.FRICTIONAL) -> tuple[Touch, ...]:
    """The same over all openings of the hand, from open to where the tips would touch the object in the middle."""
    planner, stretches = planner_of(case, closure)
    low, high = case.hand.base_limits
    angles = np.linspace(low, min(high, 0.5 * np.pi), OPENINGS)
    return tuple(_seen_touch(planner, opening_of(case, stretches, float(each), closure), travel) for each in angles)


def fewest_stretches(case: Case, opening: float, closure: Closure = Closure.FRICTIONAL) -> tuple[Stretch, ...] | None:
    """The fewest binary sensors, each on one link or the palm, with which one approach suffices; None if none do.

    From one end of each body to the other every stretch is made as long as still fits: a part of a belief that fits
    fits, so no cover has fewer.
    """
    bodies = [Stretch(body="palm")]
    for side in ("right", "left"):
        bodies += [Stretch(body=f"{side}_{k + 1}") for k in range(len(case.hand.finger_links))]
    whole = case.model_copy(update={"sensors": Sensors(layout=tuple(bodies))})
    doubt = Doubt(case.sensors.displacement, case.sensors.pose_error)
    planner, _ = planner_of(whole, closure)
    planner = replace(planner, doubt=doubt)
    seen = opening_of(whole, tuple(bodies), opening, closure)
    found: list[Stretch] = []
    for k, body in enumerate(bodies):
        cut = _cover(case, planner, seen, k, body.body)
        if cut is None:
            return None
        found += cut
    return tuple(found)


def _cover(case: Case, planner: Planner, seen: Opening, number: int, body: str) -> list[Stretch] | None:
    """Greedy stretches over the pieces of one body."""
    cuts: list[float] = []
    profile = seen.profile
    for piece in (each for each in profile.pieces if each.owner == number):
        begin, end = float(piece.points[0, 0]), float(piece.points[-1, 0])
        while begin < end - 1e-12:
            reach = _longest(planner, profile, piece, begin, end)
            if reach - begin < min(NARROWEST * case.hand.finger_length, 0.5 * (end - begin)):
                return None
            begin = reach
            cuts.append(begin)
    return _as_stretches(case, body, seen.angle, profile, cuts[:-1])


def _longest(planner: Planner, profile: Profile, piece: Piece, begin: float, end: float) -> float:
    """The largest x up to which a stretch from ``begin`` still fits."""
    if _fits(planner, profile, piece, begin, end):
        return end
    low, high = begin, end
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if _fits(planner, profile, piece, begin, middle):
            low = middle
        else:
            high = middle
    return low


def _fits(planner: Planner, profile: Profile, piece: Piece, begin: float, end: float) -> bool:
    x = np.concatenate([[begin], piece.points[(piece.points[:, 0] > begin) & (piece.points[:, 0] < end), 0], [end]])
    curve = LineString(np.stack([x, np.interp(x, piece.points[:, 0], piece.points[:, 1])], axis=1))
    growth = profile.flattening + planner.doubt.displacement + planner.doubt.pose_error + piece.blur
    return planner.closing(grow(curve, growth)) is not None


def _good_sensors(planner: Planner, seen: Opening) -> set[int]:
    """Sensors whose whole regions fit."""
    curves: dict[int, list[BaseGeometry]] = {}
    growth = seen.profile.flattening + planner.doubt.displacement + planner.doubt.pose_error
    for each in seen.profile.pieces:
        if each.owner != DEAD:
            curves.setdefault(each.owner, []).append(grow(LineString(each.points), growth + each.blur))
    return {owner for owner, parts in curves.items() if planner.closing(shapely.union_all(parts)) is not None}


def _strip(piece: Piece, travel: float) -> Polygon:
    return Polygon([*piece.points, *(piece.points[::-1] + np.array([0.0, travel]))])


def _widest_run(width: np.ndarray, good: np.ndarray) -> float:
    """The widest run of neighbouring good pieces."""
    best = run = 0.0
    for each, yes in zip(width, good, strict=True):
        run = run + float(each) if yes else 0.0
        best = max(best, run)
    return best


def _as_stretches(case: Case, body: str, opening: float, profile: Profile, cuts: list[float]) -> list[Stretch]:
    """Cuts at x (m) on the profile of one body as stretches along it, from its near to its far end."""
    place, along = body_lines(case.hand, opening)[body]
    length = float(np.hypot(*along))
    feet = []
    for x in cuts:
        y = float(profile.heights(np.array([x]))[0])
        feet.append(float(np.clip((np.array([x, y]) - place) @ along / length, 0.0, length)))
    inner = sorted(each for each in feet if 1e-6 * length < each < (1.0 - 1e-6) * length)
    ends = [0.0, *inner, length]
    return [Stretch(body=body, begin=begin, end=end) for begin, end in pairwise(ends)]
