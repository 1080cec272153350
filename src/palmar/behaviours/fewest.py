"""How many approaches there must be: what no plan can do, whatever its offsets and distances.

Said of every plan that approaches along y in one of the directions, with the fingers at one of the openings of the
``Planner``, at any offset and over any distance, touches with no part that has no sensor, and closes from one of these
openings after it has come straight from below. Even without errors such a plan meets everything that is found here, so
nothing depends on how beliefs are grown.

A belief that does not fit into the outer side of any region takes an approach. It takes more than n of them if for every
offset there is a distance T (infinite, if need be) such that

- over T or more a part without a sensor touches, or a sensor may have fired whose places take more than n - 1;
- over T or less what may be left untouched takes more than n - 1:

the farther an approach goes, the more is felt and the less is left. Offsets are dealt with by intervals: what is touched
surely, and left surely, for all offsets of one; an interval that proves nothing is halved. All that is left for
every offset is tried first as one set; a set takes no fewer approaches than a part of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import inf

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.passing import Marks, Passing, View
from palmar.behaviours.planner import Planner
from palmar.behaviours.policy import seen_turned
from palmar.behaviours.unfitting import Outer, outer_of, surely_unfit
from palmar.geometry.columns import spans

Floats = NDArray[np.float64]
INTERVALS, HALVINGS = 12, 5
"""Intervals of offsets at first, and how often each may be halved."""
MOST_LOOKS = 1500
"""Intervals looked at before the proof is given up."""
PARTS = 48
"""Ends of a sensor's places are moved inwards to so many marks of its piece, so that few proofs serve all offsets."""
DEEPEST = 8


@dataclass
class Fewest:
    """Proofs for one planner, kept from question to question."""

    planner: Planner
    looks: int = 0
    known: dict[tuple[int, int, float, int, Marks], bool] = field(default_factory=dict)

    def __post_init__(self) -> None:
        flattening = max(each.profile.flattening for each in self.planner.openings)
        self.slack = 2.0 * DEEPEST * flattening
        """By how much (m) any place may be off because of chords, however deep."""
        self.outers: tuple[Outer, ...] = tuple(outer_of(each.outer, self.slack) for each in self.planner.openings)
        self.passings = tuple(Passing.of(each.profile, self.slack) for each in self.planner.openings)

    def least(self, belief: BaseGeometry, most: int, facing: float = 0.0) -> int:
        """The number of approaches, up to ``most``, below which there is proved to be no plan."""
        return next((each for each in range(most) if not self.rules_out(belief, each, facing)), most)

    def rules_out(self, belief: BaseGeometry, most: int, facing: float = 0.0, looks: int = MOST_LOOKS) -> bool:
        """Whether it is proved, within so many ``looks`` at intervals, that no plan has at most ``most`` approaches."""
        self.looks = looks
        return self._rules_out(belief, most, facing)

    def _rules_out(self, belief: BaseGeometry, most: int, facing: float) -> bool:
        views = self.planner.turned(belief, facing)
        if not all(surely_unfit(each, seen) for _, seen in views for each in self.outers):
            return False
        if most == 0 or self._too_wide(views, most):
            return True
        left: list[BaseGeometry] = []
        for turn, seen in views:
            view = View.of(seen)
            for number, passing in enumerate(self.passings):
                for begin, end in passing.offsets(view, INTERVALS):
                    rest = self._halved(view, number, (begin, end), most, facing + turn, HALVINGS)
                    if rest is None:
                        return False
                    left += [seen_turned(each, -turn) for each in rest]
        if most == 1:
            return True
        return self._all_rule_out(left, most - 1, facing)

    def _all_rule_out(self, left: list[BaseGeometry], most: int, facing: float) -> bool:
        """Whether every one of some beliefs takes more approaches: all at once by what they share, else each."""
        shared = shapely.intersection_all(left)
        if not shared.is_empty and self._rules_out(shared, most, facing):
            return True
        return all(self.looks > 0 and self._rules_out(each, most, facing) for each in left)

    def _too_wide(self, views: list[tuple[float, BaseGeometry]], most: int) -> bool:
        """Whether so many approaches, and one region for what is never felt, are narrower than the belief."""
        if len(views) > 1:
            return False
        across = max(each.profile.right - each.profile.left for each in self.planner.openings)
        region = max(each.size[0] for each in self.outers)
        wide = sum(end - begin for begin, end in spans(views[0][1]))
        return wide > most * (across + 2.0 * self.slack) + region + 2.0 * self.slack

    def _halved(
        self, view: View, number: int, between: tuple[float, float], most: int, facing: float, halvings: int
    ) -> list[BaseGeometry] | None:
        """What surely is left, for each part of an interval of offsets, where that takes too many; None if unproved."""
        self.looks -= 1
        if self.looks < 0:
            return None
        for rest in self._left(view, number, between, most, facing):
            if all(surely_unfit(each, seen) for _, seen in self.planner.turned(rest, facing) for each in self.outers):
                return [rest]
        if halvings == 0:
            return None
        found: list[BaseGeometry] = []
        middle = 0.5 * (between[0] + between[1])
        for part in ((between[0], middle), (middle, between[1])):
            more = self._halved(view, number, part, most, facing, halvings - 1)
            if more is None:
                return None
            found += more
        return found

    def _left(
        self, view: View, number: int, between: tuple[float, float], most: int, facing: float
    ) -> Iterator[BaseGeometry]:
        """What surely is left by some distance at or beyond which the approach is no use; first what is left in the end.

        If the first suffices there is no need to look for a distance, but for more approaches the last is worth more.
        """
        passing = self.passings[number]
        if most == 1:
            yield passing.left(view, between, inf)
        height = passing.dead_by(view, between)
        for sensor in passing.sensors:
            height = min(height, self._felt_by(view, number, sensor, between, most, facing))
        if most > 1 or height < inf:
            yield passing.left(view, between, height)

    def _felt_by(
        self, view: View, number: int, sensor: int, between: tuple[float, float], most: int, facing: float
    ) -> float:
        """A height by which a sensor surely may have fired at places that take too many approaches; inf without one."""
        passing = self.passings[number]
        low, high = 0, len(heights := passing.heights(view, between, sensor))
        if high == 0 or not self._bad(number, sensor, passing.felt(view, between, sensor, inf, PARTS), most, facing):
            return inf
        while low < high:
            middle = (low + high) // 2
            marks = passing.felt(view, between, sensor, float(heights[middle]), PARTS)
            if self._bad(number, sensor, marks, most, facing):
                high = middle
            else:
                low = middle + 1
        return float(heights[low]) if low < len(heights) else inf

    def _bad(self, number: int, sensor: int, marks: Marks, most: int, facing: float) -> bool:
        """Whether a sensor's places between marks (piece, first, last) take more than most - 1 approaches."""
        if not marks:
            return False
        key = (number, sensor, facing, most, marks)
        if key not in self.known:
            places = self.passings[number].places(marks, PARTS)
            self.known[key] = self._rules_out(places, most - 1, facing)
        return self.known[key]
