"""The plan with the fewest approaches: an AND-OR search over beliefs, deeper one approach at a time.

A belief is done if it fits into the region at some place and opening. Else an approach cuts it, and every part must be
done with one approach fewer. Offsets are tried on a grid across the belief, from the middle outwards, and where it just
passes a part without a sensor. An approach goes on until all that can be touched has been; if that does not do, it is
stopped before. The farther it goes, the more a sensor may have felt and the less is left, so that of all distances the
longest is best after which every sensor still has a way on: it is bisected, from where a part without a sensor would touch.

Numbers of approaches that ``fewest`` rules out are not searched. "None with so many" is otherwise said of the grid, and
only if the search came to its end within the number of approaches looked at that it is given.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.approach import Felt, Sweep, farthest, sweep
from palmar.behaviours.fewest import Fewest
from palmar.behaviours.planner import Opening, Planner
from palmar.behaviours.policy import Approach, Branch, Close, Lost, Policy, approaches, is_guaranteed

Floats = NDArray[np.float64]
BESIDE = 1e-6
"""Gap between a belief and a part without a sensor that it just passes, as a share of its width."""
LOOKS, LOOKS_A_SWEEP = 100, 6.0
"""Intervals of offsets looked at to see that a belief need not be searched, and how many take as long as an approach."""
EFFORT = 150
"""First moves compared where no plan was found."""
HALVINGS = 5
"""Of the distance of an approach that is stopped."""


@dataclass(frozen=True)
class Found:
    """A policy; the number of approaches below which there is none (``fewest``).

    ``exhausted``: whether the search came to its end; ``sweeps``: how many approaches were looked at.
    """

    policy: Policy
    least: int
    exhausted: bool
    sweeps: int

    @property
    def minimal(self) -> bool:
        """Whether the policy is certain and no other needs fewer approaches, whatever their offsets and distances."""
        return is_guaranteed(self.policy) and approaches(self.policy) == self.least


@dataclass(frozen=True)
class Move:
    """An approach to try: the hand turns, sees the belief as ``seen``, and goes in line with x (m); ``facing`` then (rad).

    ``dead``: a part without a sensor may touch if it goes on to the end.
    """

    turn: float
    facing: float
    seen: BaseGeometry
    opening: Opening
    x: float
    dead: bool


def fewest_approaches(planner: Planner, belief: BaseGeometry, most: int, facing: float = 0.0) -> Found:
    """The policy with the fewest approaches in the worst case, up to ``most``; else one that leaves little."""
    search = Search(planner, Fewest(planner))
    least = 0
    for depth in range(most + 1):
        if least == depth and search.fewest.rules_out(belief, depth, facing):
            least = depth + 1
            continue
        found = search.solve(belief, depth, facing)
        if found is not None:
            return Found(found, least, not search.spent, search.sweeps)
    return Found(search.best_effort(belief, most, facing), least, not search.spent, search.sweeps)


def moves(planner: Planner, belief: BaseGeometry, facing: float) -> list[Move]:
    """For each opening and turn offsets across the belief: middle, flush with a side, outwards, and beside dead parts."""
    steps = np.concatenate(
        [[0.0], *((each, -each) for each in np.arange(1, planner.offsets + 1) / (planner.offsets + 1.0))]
    )
    found: list[list[Move]] = []
    for turn, seen in planner.turned(belief, facing):
        found.append([])
        across = _across(seen, planner.doubt.off)
        left, right = float(across.min()), float(across.max())
        near = BESIDE * (right - left)
        for each in planner.openings:
            reach = 0.5 * (right - left + each.profile.right - each.profile.left)
            beside = np.concatenate([right - each.dead[:, 0] + near, left - each.dead[:, 1] - near])
            flush = np.array([left - each.profile.left - near, right - each.profile.right + near])
            offsets = 0.5 * (left + right) + reach * steps
            offsets = np.concatenate([offsets[:1], flush, offsets[1:], beside])
            low = across[:, 0] - offsets[:, None, None]
            high = across[:, 1] - offsets[:, None, None]
            touched = np.any((high > each.dead[:, :1]) & (low < each.dead[:, 1:]), axis=(1, 2))
            found[-1] += [
                Move(turn, facing + turn, seen, each, float(x), dead)
                for x, dead in zip(offsets, touched.tolist(), strict=True)
            ]
    return [move for same in zip(*found, strict=True) for move in same]


@dataclass
class Search:
    """One search, the approaches it has looked at, and the time that proofs took, counted in approaches."""

    planner: Planner
    fewest: Fewest
    sweeps: int = 0
    proofs: float = 0.0
    spent: bool = False
    closings: dict[tuple[bytes, float], Close | None] = field(default_factory=dict)

    def solve(self, belief: BaseGeometry, depth: int, facing: float) -> Policy | None:
        """A policy within so many approaches; None if none was found."""
        closing = self.closing(belief, facing)
        if closing is not None or depth == 0 or self._is_hopeless(belief, depth, facing):
            return closing
        late: list[tuple[Move, Sweep | None]] = []
        for move in moves(self.planner, belief, facing):
            if move.dead:
                late.append((move, None))
                continue
            found = self._through(belief, move, depth, late)
            if found is not None or self.spent:
                return found
        for move, seen in late:
            found = self._stopped(belief, move, seen, depth)
            if found is not None or self.spent:
                return found
        return None

    def _is_hopeless(self, belief: BaseGeometry, depth: int, facing: float) -> bool:
        """Whether a short look proves that a belief need not be searched."""
        proved = self.fewest.rules_out(belief, depth, facing, LOOKS)
        self.proofs += (LOOKS - self.fewest.looks) / LOOKS_A_SWEEP
        return proved

    def closing(self, belief: BaseGeometry, facing: float) -> Close | None:
        """The planner's proof for a belief, looked for once."""
        key = shapely.to_wkb(belief), facing
        if key not in self.closings:
            self.closings[key] = self.planner.closing(belief, facing)
        return self.closings[key]

    def swept(self, move: Move, distance: float | None = None) -> Sweep | None:
        """An approach that touches something; None for any other, or when enough have been looked at."""
        if self.sweeps + self.proofs >= self.planner.most_sweeps:
            self.spent = True
            return None
        self.sweeps += 1
        swept = sweep(move.seen, move.opening.profile, move.x, self.planner.doubt, distance)
        return None if swept is None or all(each.sensor is None for each in swept.felt) else swept

    def stopped(self, move: Move) -> Sweep | None:
        """An approach that stops before a part without a sensor could touch."""
        distance = farthest(move.seen, move.opening.profile, move.x, self.planner.doubt)
        return self.swept(move, None if distance == inf else distance) if distance > 0.0 else None

    def _through(
        self, belief: BaseGeometry, move: Move, depth: int, late: list[tuple[Move, Sweep | None]]
    ) -> Policy | None:
        """The policy of an approach to the end; noted in ``late`` if it only goes too far."""
        swept = self.swept(move)
        if swept is None:
            return None
        branches, failed = self._branches(swept, depth, move.facing)
        if failed is not None and failed.sensor is not None:
            late.append((move, swept))
        return None if failed is not None else _approach(belief, move, swept, branches)

    def _stopped(self, belief: BaseGeometry, move: Move, seen: Sweep | None, depth: int) -> Policy | None:
        """The policy of an approach that stops before its end: bisected, for the longest way with a way on."""
        tried = self.stopped(move) if seen is None else seen
        if tried is None:
            return None
        left = [each.belief for each in tried.felt if each.sensor is None]
        if any(self.solve(each, depth - 1, move.facing) is None for each in left):
            return None
        low, high = 0.0, tried.distance
        for _ in range(HALVINGS):
            branches, failed = self._branches(tried, depth, move.facing)
            if failed is None:
                return _approach(belief, move, tried, branches)
            low, high = (tried.distance, high) if failed.sensor is None else (low, tried.distance)
            again = self.swept(move, 0.5 * (low + high))
            if again is None:
                return None
            tried = again
        return None

    def _branches(self, swept: Sweep, depth: int, facing: float) -> tuple[tuple[Branch, ...], Felt | None]:
        """What comes after each outcome, the widest asked first; and the first outcome without a way on."""
        branches = []
        for each in sorted(swept.felt, key=lambda felt: -width(felt.belief)):
            then = self.solve(each.belief, depth - 1, facing)
            if then is None:
                return (), each
            branches.append(Branch(each.sensor, each.belief, then))
        return tuple(branches), None

    def best_effort(self, belief: BaseGeometry, depth: int, facing: float) -> Policy:
        """A policy that leaves some belief: of all first moves the one that leaves the narrowest, then the same again."""
        closing = self.closing(belief, facing)
        if closing is not None or depth == 0:
            return closing or Lost(belief)
        best: tuple[float, Move, Sweep] | None = None
        tried = [each for each in moves(self.planner, belief, facing) if not each.dead]
        for move in tried[:: 1 + len(tried) // EFFORT]:
            swept = sweep(move.seen, move.opening.profile, move.x, self.planner.doubt)
            if swept is None:
                continue
            left = max(
                (width(each.belief) for each in swept.felt if self.closing(each.belief, move.facing) is None),
                default=0.0,
            )
            if left < (width(belief) if best is None else best[0]):
                best = left, move, swept
        if best is None:
            return Lost(belief)
        _, move, swept = best
        branches = (
            Branch(each.sensor, each.belief, self.best_effort(each.belief, depth - 1, move.facing))
            for each in swept.felt
        )
        return _approach(belief, move, swept, tuple(branches))


def _approach(belief: BaseGeometry, move: Move, swept: Sweep, branches: tuple[Branch, ...]) -> Approach:
    return Approach(belief, swept.x, swept.y, swept.distance, move.opening.angle, branches, move.turn)


def _across(belief: BaseGeometry, margin: float) -> Floats:
    """The intervals of x (K, 2) over which the parts of a belief lie, with a margin (m)."""
    bounds = shapely.bounds(shapely.get_parts(belief))
    return np.stack([bounds[:, 0] - margin, bounds[:, 2] + margin], axis=1)


def width(belief: BaseGeometry) -> float:
    """Of a belief across the way (m)."""
    left, _, right, _ = belief.bounds
    return float(right - left)
