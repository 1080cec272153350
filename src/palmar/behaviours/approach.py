"""What an approach tells: the hand goes straight towards the object until it feels it.

A belief is the set of places, in the hand frame, where the object's centre may be. The hand lines up beside it, below
everything it could touch, and goes along its y axis. Where the centre lies decides alone what is touched first, by the
hand's ``profile``; when that sensor fires, the centre is on its piece of the profile, straight under where it was. So
one approach turns a belief of any depth into a curve, and cuts its width at the ends of the stretches.

The object is taken to stay while it is touched (massive, or felt before it is pushed); it may move by at most the
sensors' displacement before it is felt, in any direction. The hand may be off its commanded pose by the pose error,
each time it moves. Every belief is in the frame of the commanded pose.

The object's radius may be up to a ``spread`` more than the one R that the profile is for. Where a disk of radius R' touches
first, a disk of radius R touches first if its centre is moved towards that contact by R' - R: it stays as far from all the
rest of the hand as the larger one does, or farther. Where R' touches nothing, R touches nothing. So a spread is to what is
felt as a pose error of its size, and to what is closed on it is none.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, Polygon, affinity
from shapely.geometry.base import BaseGeometry

from palmar.geometry.columns import edges, lowest
from palmar.regions.profile import DEAD, Piece, Profile

Floats = NDArray[np.float64]
EDGE = 1e-3
"""Share of the flattening by which pieces overlap, so that a place just over an end belongs to both."""
ARC = 8
"""Chords to a quarter circle where a belief is grown; it is grown by that much more."""
SPARE = 1.02
"""How much farther than must be an approach stays from what it must not touch."""


@dataclass(frozen=True)
class Doubt:
    """Displacement of the object before it is felt, pose error of the hand, and spread of the radius (m)."""

    displacement: float = 0.0
    pose_error: float = 0.0
    spread: float = 0.0

    @property
    def off(self) -> float:
        """How far (m) the object may seem to be, when it is felt, from where it is."""
        return self.pose_error + self.spread


@dataclass(frozen=True)
class Felt:
    """What an approach may end with: the sensor's number, None if nothing was touched; the belief seen from there."""

    sensor: int | None
    belief: BaseGeometry


@dataclass(frozen=True)
class Sweep:
    """An approach from (x, y) (m, in the hand frame before it) over at most ``distance`` (m), and all it may end with."""

    x: float
    y: float
    distance: float
    felt: tuple[Felt, ...]


def sweep(
    belief: BaseGeometry, profile: Profile, x: float, doubt: Doubt, distance: float | None = None
) -> Sweep | None:
    """An approach in line with x, over a ``distance`` (m) from below everything, or until all that can be touched has been.

    None where a part of the hand without a sensor may touch: the object would be pushed unfelt.
    """
    seen = affinity.translate(grow(belief, doubt.off), -x)
    _, low, _, high = seen.bounds
    begin = low - profile.top - profile.flattening
    farthest = high - profile.bottom - begin + profile.flattening
    way = farthest if distance is None else min(distance, farthest)
    growth = profile.flattening + doubt.displacement + doubt.off
    felt: dict[int, list[BaseGeometry]] = {}
    for piece in profile.pieces:
        spans = _spans(seen, piece, begin + way, profile.flattening)
        if spans and piece.owner == DEAD:
            return None
        felt.setdefault(piece.owner, []).extend(grow(_cut(piece, *span), growth + piece.blur) for span in spans)
    found = [Felt(owner, shapely.union_all(parts)) for owner, parts in felt.items() if parts]
    missed = affinity.translate(shapely.difference(affinity.translate(belief, -x), swept(profile, low, begin + way, doubt)),
                                0.0, -begin - way)  # fmt: skip
    if missed.area > 0.0:
        found.append(Felt(None, missed))
    return Sweep(x, begin, way, tuple(found))


def farthest(belief: BaseGeometry, profile: Profile, x: float, doubt: Doubt) -> float:
    """The distance (m) over which ``sweep`` at x may go before a part without a sensor could touch; inf without such."""
    dead = [each for each in profile.pieces if each.owner == DEAD]
    if not dead:
        return inf
    room = SPARE * (max(each.blur for each in dead) + profile.flattening)
    seen = grow(belief, doubt.off)
    lines = edges(affinity.translate(grow(seen, room), -x))
    first = inf
    for piece in dead:
        wide = piece.blur + EDGE * profile.flattening
        begin, end = float(piece.points[0, 0]) - wide, float(piece.points[-1, 0]) + wide
        corners = np.unique(lines[:, [0, 2]])
        corners = corners[(corners > begin) & (corners < end)]
        at = np.concatenate([[begin, end], piece.points[:, 0], corners])
        over = lowest(lines, at) - np.interp(at, piece.points[:, 0], piece.points[:, 1])
        first = min(first, float(over.min()))
    return first - (seen.bounds[1] - profile.top - profile.flattening)


def swept(profile: Profile, low: float, height: float, doubt: Doubt) -> BaseGeometry:
    """Places above ``low`` that are touched for certain by the time the hand is at ``height`` (m)."""
    under = [
        Polygon(
            [*(each.points + np.array([0.0, height])), (each.points[-1, 0], low - 1.0), (each.points[0, 0], low - 1.0)]
        )
        for each in profile.pieces
    ]
    touched = shapely.union_all([shapely.make_valid(each) for each in under])
    return touched.buffer(-_at_least(doubt.off), quad_segs=ARC)


def grow(belief: BaseGeometry, distance: float) -> BaseGeometry:
    """At least the Minkowski sum with a disk of radius ``distance`` (m)."""
    if distance <= 0.0:
        return belief
    return belief.buffer(_at_least(distance), quad_segs=ARC)


def _at_least(distance: float) -> float:
    """The distance (m) at which chords of a quarter circle's arc are nowhere nearer than the one asked for."""
    return float(distance / np.cos(np.pi / (4 * ARC)))


def _spans(belief: BaseGeometry, piece: Piece, height: float, flattening: float) -> list[tuple[float, float]]:
    """The intervals of x over which the belief lies where a piece passes by the time the hand is at ``height`` (m)."""
    wide = piece.blur + EDGE * flattening
    low, high = float(piece.points[0, 0]) - wide, float(piece.points[-1, 0]) + wide
    left, bottom, right, top = belief.bounds
    if right <= low or left >= high:
        return []
    inside = shapely.intersection(belief, shapely.box(low, bottom - 1.0, high, top + 1.0))
    if height + float(piece.points[:, 1].min()) < top:
        ends = [(low, piece.points[0, 1]), *piece.points, (high, piece.points[-1, 1])]
        passed = [(x, y + height) for x, y in ends]
        inside = shapely.intersection(
            inside, Polygon([*passed, (high, bottom - 1.0), (low, bottom - 1.0)]).buffer(piece.blur + flattening)
        )
    spans = [(each.bounds[0], each.bounds[2]) for each in shapely.get_parts(inside) if each.area > 0.0]
    joined: list[tuple[float, float]] = []
    for begin, end in sorted(spans):
        if joined and begin <= joined[-1][1]:
            joined[-1] = joined[-1][0], max(end, joined[-1][1])
        else:
            joined.append((begin, end))
    return joined


def _cut(piece: Piece, begin: float, end: float) -> LineString:
    """The part of a piece over an interval of x."""
    x, y = piece.points[:, 0], piece.points[:, 1]
    inner = (x > begin) & (x < end)
    ends = np.clip([begin, end], x[0], x[-1])
    heights = np.interp(ends, x, y)
    points = np.vstack([[ends[0], heights[0]], piece.points[inner], [ends[1], heights[1]]])
    return LineString(points)
