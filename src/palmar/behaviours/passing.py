"""What a hand surely touches, and surely leaves, for all offsets of an interval.

At offset x a place b of the belief is touched by the time the hand is at height t if b_y <= t + Y(b_x - x), with the
profile Y. For offsets between x0 and x1, b_x - x is anywhere in [b_x - x1, b_x - x0]: the least Y there says when the place
is touched for certain, the greatest until when it is left. A sensor that surely is what touches at all columns
between a and b of the belief may fire at all places u of its piece between a - x0 and b - x1, whatever the offset.

Profiles are chords below arcs, and sensors' places chords too: intervals are widened by ``slack``, heights spared by it.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor, inf

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, MultiLineString, Polygon
from shapely.geometry.base import BaseGeometry

from palmar.geometry.columns import edges, lowest, spans
from palmar.regions.profile import DEAD, Piece, Profile

Floats = NDArray[np.float64]
Pair = tuple[float, float]
Marks = tuple[tuple[int, int, int], ...]
COLUMNS = 48
"""Columns of a belief."""
BESIDE = 1e-9
"""Beside a corner the lower boundary may jump."""


@dataclass(frozen=True)
class View:
    """A belief as the hand sees it; ends (C + 1,) of its columns, and by what height each holds a place everywhere (C,)."""

    belief: BaseGeometry
    runs: tuple[Pair, ...]
    ends: Floats
    highest: Floats

    @staticmethod
    def of(belief: BaseGeometry) -> View:
        """Columns of equal width."""
        left, _, right, _ = belief.bounds
        ends, lines = np.linspace(left, right, COLUMNS + 1), edges(belief)
        corners = np.unique(lines[:, [0, 2]])
        near = BESIDE * max(right - left, 1e-300)
        at = np.unique(np.concatenate([ends, corners, ends - near, ends + near, corners - near, corners + near]))
        at = at[(at >= left) & (at <= right)]
        low = lowest(lines, at)
        highest = np.full(COLUMNS, -inf)
        for shift in (-near, 0.0, near):
            column = np.clip(np.searchsorted(ends, at + shift) - 1, 0, COLUMNS - 1)
            np.maximum.at(highest, column, low)
        return View(belief, tuple(spans(belief)), ends, highest)


@dataclass(frozen=True)
class Passing:
    """A profile: its corners (K, 2) from left to right; intervals of x that surely are dead; pieces by sensor."""

    profile: Profile
    slack: float
    corners: Floats
    dead: tuple[Pair, ...]
    sensors: dict[int, tuple[int, ...]]

    @staticmethod
    def of(profile: Profile, slack: float) -> Passing:
        """The profile of one opening."""
        dead: list[Pair] = []
        for each in profile.pieces:
            begin, end = float(each.points[0, 0]) + each.blur, float(each.points[-1, 0]) - each.blur
            if each.owner == DEAD and dead and begin - each.blur <= dead[-1][1] + 2.0 * BESIDE:
                dead[-1] = dead[-1][0], end
            elif each.owner == DEAD:
                dead.append((begin, end))
        sensors: dict[int, list[int]] = {}
        for number, each in enumerate(profile.pieces):
            if each.owner != DEAD:
                sensors.setdefault(each.owner, []).append(number)
        corners = np.concatenate([each.points for each in profile.pieces])
        return Passing(profile, slack, corners, tuple(dead), {key: tuple(each) for key, each in sensors.items()})

    def offsets(self, view: View, parts: int) -> list[Pair]:
        """All offsets at which anything may be touched, in intervals."""
        left, right = view.ends[0], view.ends[-1]
        first, last = left - self.profile.right - self.slack, right - self.profile.left + self.slack
        return [(float(a), float(b)) for a, b in pairwise(np.linspace(first, last, parts + 1))]

    def dead_by(self, view: View, between: Pair) -> float:
        """The height (m) by which a part without a sensor surely touches; inf if it may never."""
        if not self.dead:
            return inf
        # For a single place it is enough that all it may be seen at is dead.
        low, high = self._seen(view.ends[:-1], view.ends[1:], between)
        inside = np.zeros(len(low), dtype=np.bool_)
        for begin, end in self.dead:
            inside |= (low >= begin) & (high <= end)
        inside &= np.isfinite(view.highest)
        if not inside.any():
            return inf
        return float((view.highest[inside] + self.slack - self._least(low[inside], high[inside])).min())

    def heights(self, view: View, between: Pair, sensor: int) -> Floats:
        """Heights (m), rising, at which one more column surely is touched where a sensor may be what touches."""
        low, high = self._seen(view.ends[:-1], view.ends[1:], between)
        pieces = [self.profile.pieces[each] for each in self.sensors[sensor]]
        begin = min(float(each.points[0, 0]) for each in pieces)
        end = max(float(each.points[-1, 0]) for each in pieces)
        here = (high > begin) & (low < end) & np.isfinite(view.highest)
        found = view.highest[here] + self.slack - self._least(low[here], high[here])
        return np.unique(found[np.isfinite(found)])

    def felt(self, view: View, between: Pair, sensor: int, height: float, parts: int) -> Marks:
        """Where a sensor may fire whatever the offset, by a height (m): runs of its pieces from mark to mark."""
        runs = view.runs if height == inf else self._touched(view, between, height)
        found = []
        for number in self.sensors[sensor]:
            begin, end = self._sure(self.profile.pieces[number])
            if end <= begin:
                continue
            for first, last in runs:
                low = max(begin, first - between[0] + self.slack)
                high = min(end, last - between[1] - self.slack)
                marks = ceil(parts * (low - begin) / (end - begin)), floor(parts * (high - begin) / (end - begin))
                if marks[1] > marks[0]:
                    found.append((number, *marks))
        return tuple(found)

    def places(self, marks: Marks, parts: int) -> BaseGeometry:
        """The places (m) of sensors' pieces between marks."""
        lines = []
        for number, first, last in marks:
            piece = self.profile.pieces[number]
            begin, end = self._sure(piece)
            low, high = (begin + (end - begin) * each / parts for each in (first, last))
            x = np.concatenate(
                [[low], piece.points[(piece.points[:, 0] > low) & (piece.points[:, 0] < high), 0], [high]]
            )
            lines.append(LineString(np.stack([x, np.interp(x, piece.points[:, 0], piece.points[:, 1])], axis=1)))
        return lines[0] if len(lines) == 1 else MultiLineString(lines)

    def left(self, view: View, between: Pair, height: float) -> BaseGeometry:
        """What surely is left untouched when the hand is at a height (m), whatever the offset; infinite: beside the hand."""
        bottom = view.belief.bounds[1] - 1.0
        begin = self.profile.left + between[0] - self.slack
        end = self.profile.right + between[1] + self.slack
        if height == inf:
            return shapely.difference(view.belief, shapely.box(begin, bottom, end, view.belief.bounds[3] + 1.0))
        ends = np.linspace(begin, end, 2 * COLUMNS + 1)
        tops = height + self._greatest(*self._seen(ends[:-1], ends[1:], between)) + 2.0 * self.slack
        stairs = np.stack([np.repeat(ends, 2)[1:-1], np.repeat(np.maximum(tops, bottom), 2)], axis=1)
        return shapely.difference(
            view.belief, shapely.make_valid(Polygon([(begin, bottom - 1.0), *stairs, (end, bottom - 1.0)]))
        )

    def _touched(self, view: View, between: Pair, height: float) -> tuple[Pair, ...]:
        """Runs of columns that surely are touched by a height."""
        low, high = self._seen(view.ends[:-1], view.ends[1:], between)
        yes = view.highest + self.slack - self._least(low, high) <= height
        yes &= np.isfinite(view.highest)
        steps = np.flatnonzero(np.diff(np.concatenate([[False], yes, [False]]).astype(int)))
        return tuple((float(view.ends[a]), float(view.ends[b])) for a, b in steps.reshape(-1, 2))

    def _sure(self, piece: Piece) -> Pair:
        """Between which x a piece surely is what touches."""
        spare = piece.blur + self.slack
        return float(piece.points[0, 0]) + spare, float(piece.points[-1, 0]) - spare

    def _seen(self, low: Floats, high: Floats, between: Pair) -> tuple[Floats, Floats]:
        """Where columns are seen, for all offsets of an interval."""
        return low - between[1] - self.slack, high - between[0] + self.slack

    def _least(self, low: Floats, high: Floats) -> Floats:
        """The least height of the profile over intervals of x; -inf where nothing may be touched in a part of one."""
        ends = np.minimum(self.profile.heights(low), self.profile.heights(high))
        x, y = self.corners.T
        inner = np.where((x >= low[:, None]) & (x <= high[:, None]), y, inf).min(axis=1)
        found: Floats = np.minimum(ends, inner)
        return found

    def _greatest(self, low: Floats, high: Floats) -> Floats:
        ends = np.maximum(self.profile.heights(low), self.profile.heights(high))
        x, y = self.corners.T
        inner = np.where((x >= low[:, None]) & (x <= high[:, None]), y, -inf).max(axis=1)
        found: Floats = np.maximum(ends, inner)
        return found
