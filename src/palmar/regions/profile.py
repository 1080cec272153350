"""The profile of a hand: how far towards it a disk's centre can come, at each place across the way.

The hand moves along its y axis towards a disk that stays where it is. Seen from the hand the centre comes straight down,
and stops where it is a radius away from something first: on the upper envelope of the hand grown by R. Each piece of the
envelope belongs to the stretch of the hand that is touched there. Arcs are replaced by chords below them, so that the
true place is at most ``flattening`` farther out.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, Polygon
from shapely.geometry.base import BaseGeometry

from palmar.models.hand import Hand
from palmar.models.sensors import Stretch

Floats = NDArray[np.float64]
Span = tuple[int, float, float, float, float, float]
"""Curve, the ends (x, y), (x', y') of the part of it that is highest, change of slope at a crossing, 0 at other ends."""
QUARTER = 24
"""Chords to a quarter circle."""
DEAD = -1
"""Owner of a piece without a sensor."""


@dataclass(frozen=True)
class Piece:
    """A polyline (K, 2), x rising, of the envelope in the hand frame (m), and the sensor that is touched there, or DEAD.

    ``blur`` bounds how far (m) its ends may be off because of the chords.
    """

    owner: int
    points: Floats
    blur: float


@dataclass(frozen=True)
class Profile:
    """The pieces from left to right; beyond the first and last point nothing is touched."""

    pieces: tuple[Piece, ...]
    flattening: float

    @property
    def left(self) -> float:
        """The lowest x (m) at which something is touched."""
        return float(self.pieces[0].points[0, 0])

    @property
    def right(self) -> float:
        """The highest."""
        return float(self.pieces[-1].points[-1, 0])

    @property
    def top(self) -> float:
        """Highest point (m) of the envelope."""
        return max(float(each.points[:, 1].max()) for each in self.pieces)

    @property
    def bottom(self) -> float:
        """Lowest point (m) of the envelope."""
        return min(float(each.points[:, 1].min()) for each in self.pieces)

    def heights(self, x: Floats) -> Floats:
        """Height (m) of the envelope at each x (N,); -inf where nothing is touched."""
        found = np.full(np.shape(x), -np.inf)
        for each in self.pieces:
            at = np.interp(x, each.points[:, 0], each.points[:, 1], left=-np.inf, right=-np.inf)
            found = np.maximum(found, at)
        return found


def profile(hand: Hand, radius: float, stretches: tuple[Stretch, ...], opening: float) -> Profile:
    """The profile of a hand with both straight fingers at the base angle ``opening`` (rad) for a disk (radius in m)."""
    flattening = (radius + hand.half_thickness) * (1.0 - cos(pi / (4.0 * QUARTER)))
    return Profile(tuple(_envelope(_curves(hand, radius, stretches, opening), flattening)), flattening)


def body_lines(hand: Hand, opening: float) -> dict[str, tuple[Floats, Floats]]:
    """Begin (2,) and direction with length (2,) (m) of the palm, from its left end, and of every link, from its joint."""
    d = hand.half_palm
    lines = {"palm": (np.array([-d, 0.0]), np.array([2.0 * d, 0.0]))}
    for side, name in ((1.0, "right"), (-1.0, "left")):
        place = np.array([side * d, 0.0])
        for k, length in enumerate(hand.finger_links):
            along = np.array([side * length * cos(opening), length * sin(opening)])
            lines[f"{name}_{k + 1}"] = place, along
            place = place + along
    return lines


def _curves(hand: Hand, radius: float, stretches: tuple[Stretch, ...], opening: float) -> list[tuple[int, Floats]]:
    """The upper boundary of every grown stretch of the palm and the links."""
    curves = []
    for body, (place, along) in body_lines(hand, opening).items():
        rho = radius if body == "palm" else radius + hand.half_thickness
        curves += _of_body(body, place, along, rho, stretches)
    return curves


def _of_body(
    body: str, place: Floats, along: Floats, rho: float, stretches: tuple[Stretch, ...]
) -> list[tuple[int, Floats]]:
    """Offset lines over the stretches of one straight body, dead ones between them, and the caps at its ends."""
    length = float(np.hypot(*along))
    cuts = sorted(
        (max(each.begin, 0.0), min(each.end or length, length), k)
        for k, each in enumerate(stretches)
        if each.body == body
    )
    parts, done = [], 0.0
    for begin, end, owner in cuts:
        if begin > done + 1e-9 * length:
            parts.append((done, begin, DEAD))
        parts.append((max(begin, done), end, owner))
        done = max(done, end)
    if done < length * (1.0 - 1e-9):
        parts.append((done, length, DEAD))
    unit = along / length
    normal = np.array([-unit[1], unit[0]])
    if normal[1] < 0.0 or (normal[1] == 0.0 and normal[0] < 0.0):
        normal = -normal
    curves = []
    for begin, end, owner in parts:
        ends = place + unit * np.array([[begin], [end]]) + rho * normal
        if abs(ends[1, 0] - ends[0, 0]) > 1e-12 * length:
            curves.append((owner, ends[np.argsort(ends[:, 0])]))
    for centre, owner in ((place, parts[0][2]), (place + unit * length, parts[-1][2])):
        angles = np.linspace(pi, 0.0, 2 * QUARTER + 1)
        angles = np.sort(np.append(angles, atan2(normal[1], normal[0])))[::-1]
        curves.append((owner, centre + rho * np.stack([np.cos(angles), np.sin(angles)], axis=1)))
    return curves


def _envelope(curves: list[tuple[int, Floats]], flattening: float) -> list[Piece]:
    """The upper envelope of polylines, cut where the owner changes or where it jumps."""
    cuts = np.unique(np.concatenate([points[:, 0] for _, points in curves]))
    near = 1e-12 * (cuts[-1] - cuts[0])
    cuts = cuts[np.concatenate([[True], np.diff(cuts) > near])]
    at = np.array([np.interp(cuts, p[:, 0], p[:, 1]) for _, p in curves])
    over = np.array([(cuts >= p[0, 0] - 2.0 * near) & (cuts <= p[-1, 0] + 2.0 * near) for _, p in curves])
    low, high, there = at[:, :-1], at[:, 1:], over[:, :-1] & over[:, 1:]
    low, high = np.where(there, low, -np.inf), np.where(there, high, -np.inf)
    spans: list[Span] = []
    for k in np.flatnonzero(there.any(axis=0)):
        lines = np.flatnonzero(there[:, k])
        for here, *ends in _over_span(low[lines, k], high[lines, k], float(cuts[k]), float(cuts[k + 1])):
            spans.append((int(lines[int(here)]), ends[0], ends[1], ends[2], ends[3], ends[4]))
    return _joined(spans, [owner for owner, _ in curves], flattening)


def _over_span(low: Floats, high: Floats, begin: float, end: float) -> list[Span]:
    """The upper envelope of lines over one span: (line, x, y, x', y') from left to right."""
    rise = high - low
    here, share, found = int(np.lexsort((high, low))[-1]), 0.0, []
    while True:
        value, gain = low + share * rise, rise - rise[here]
        steeper = gain > 0.0
        meets = np.full(len(low), np.inf)
        meets[steeper] = share + (value[here] - value[steeper]) / gain[steeper]
        meets[meets <= share + 1e-12] = np.inf
        after = int(np.argmin(meets))
        stop = 1.0 if meets[after] >= 1.0 - 1e-12 else float(meets[after])
        ends = [end if each == 1.0 else begin + each * (end - begin) for each in (share, stop)]
        heights = [float(low[here] + each * rise[here]) for each in (share, stop)]
        crossing = float(gain[after]) / (end - begin) if stop < 1.0 else 0.0
        found.append((here, ends[0], heights[0], ends[1], heights[1], crossing))
        if stop == 1.0:
            return found
        share, here = stop, after


def _joined(spans: list[Span], owners: list[int], flattening: float) -> list[Piece]:
    """Neighbouring spans of one owner, where they meet, as one piece.

    Chords that hardly cross, or stand upright, tell nothing of where the arcs do, but on the profile it is.
    """
    pieces: list[tuple[int, list[tuple[float, float]], float]] = []
    before, heights = 0.0, [height for span in spans for height in (span[2], span[4])]
    most = hypot(spans[-1][3] - spans[0][1], max(heights) - min(heights)) if spans else 0.0
    for curve, x, y, x_end, y_end, crossing in spans:
        slope = (y_end - y) / max(x_end - x, 1e-300)
        after = _blur(slope, crossing, flattening)
        after = after if after < most else most
        if pieces and pieces[-1][0] == owners[curve]:
            owner, points, blur = pieces[-1]
            if abs(points[-1][0] - x) < 1e-9 and abs(points[-1][1] - y) < 1e-9:
                pieces[-1] = (owner, [*points, (x_end, y_end)], max(blur, after))
                before = after
                continue
        pieces.append((owners[curve], [(x, y), (x_end, y_end)], max(before, after)))
        before = after
    return [Piece(owner, np.array(points), blur) for owner, points, blur in pieces]


def _blur(slope: float, crossing: float, flattening: float) -> float:
    """How far from the arcs' two chords cross, whose slopes differ by ``crossing``: 2 e / sin of the angle; 0 for none."""
    return 2.0 * flattening * hypot(1.0, slope) * hypot(1.0, slope + crossing) / crossing if crossing > 0.0 else 0.0


def above(seen: Profile, height: float) -> BaseGeometry:
    """Centres (m) that the hand, coming straight up to where it is, has not touched: over the profile, or beside it."""
    rounded = shapely.union_all([LineString(each.points) for each in seen.pieces]).buffer(seen.flattening)
    return not_below(seen, height).difference(rounded)


def not_below(seen: Profile, height: float) -> BaseGeometry:
    """Centres (m) over the profile's chords, up to a ``height`` (m), or beside it: all that may not have been touched."""
    over = []
    for piece in seen.pieces:
        left, right = piece.points[0, 0], piece.points[-1, 0]
        over.append(shapely.make_valid(Polygon([*piece.points, (right, height), (left, height)])))
    beside = [
        shapely.box(seen.left - height, 0.0, seen.left, height),
        shapely.box(seen.right, 0.0, seen.right + height, height),
    ]
    return shapely.union_all([*over, *beside])
