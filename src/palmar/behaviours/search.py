"""The plan with the fewest approaches: an AND-OR search over beliefs, deeper one approach at a time.

A belief is done if it fits into the region at some place and opening. Else an approach cuts it, and every part must be
done with one approach fewer. Offsets are tried on a grid across the belief, from the middle outwards, and where it just
passes a part without a sensor; approaches in which such a part could touch are left out. So "none with fewer" is said of
that grid, and only if the search came to its end within the number of approaches looked at that it is given.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.approach import Doubt, Sweep, grow, sweep
from palmar.behaviours.placing import Place, Target, place
from palmar.behaviours.policy import Approach, Branch, Close, Lost, Policy
from palmar.regions.profile import DEAD, Profile

Floats = NDArray[np.float64]
OFFSETS = 32
"""Offsets tried to either side of the middle."""
BESIDE = 1e-6
"""Gap between a belief and a part without a sensor that it just passes, as a share of its width."""
MOST_SWEEPS = 600
"""Approaches that a search looks at before it gives up."""


@dataclass(frozen=True)
class Opening:
    """Fingers at one base angle (rad): the profile then, and the region of closing from there."""

    angle: float
    profile: Profile
    target: Target

    @property
    def dead(self) -> Floats:
        """Intervals of x (K, 2) in which a part without a sensor would touch."""
        spans = [each.points[[0, -1], 0] for each in self.profile.pieces if each.owner == DEAD]
        return np.array(spans).reshape(-1, 2)


@dataclass(frozen=True)
class Found:
    """A policy; whether no plan with fewer approaches is on the grid; how many approaches were looked at."""

    policy: Policy
    minimal: bool
    sweeps: int


@dataclass(frozen=True)
class Planner:
    """What the search needs of a hand; ``openings`` in the order in which they are preferred."""

    openings: tuple[Opening, ...]
    doubt: Doubt
    offsets: int = OFFSETS
    most_sweeps: int = MOST_SWEEPS

    def plan(self, belief: BaseGeometry, most: int) -> Found:
        """The policy with the fewest approaches in the worst case, up to ``most``; else one that leaves little."""
        search = _Search(self)
        for depth in range(most + 1):
            found = search.solve(belief, depth)
            if found is not None:
                return Found(found, not search.spent, search.sweeps)
        return Found(search.best_effort(belief, most), not search.spent, search.sweeps)

    def closing(self, belief: BaseGeometry) -> Close | None:
        """The proof that one placed closing motion catches all of a belief, with the largest margin; None without one."""
        doubtful = grow(belief, self.doubt.pose_error)
        best: tuple[Place, Opening] | None = None
        for each in self.openings:
            found = place(each.target, doubtful)
            if found is not None and (best is None or found.margin > best[0].margin):
                best = found, each
        return None if best is None else Close(belief, best[0], best[1].angle)

    def moves(self, belief: BaseGeometry) -> list[tuple[Opening, float]]:
        """Approaches to try: for each opening offsets across the belief, from the middle outwards, and beside dead parts."""
        across = _across(belief, self.doubt.pose_error)
        left, right = float(across.min()), float(across.max())
        steps = np.concatenate(
            [[0.0], *((each, -each) for each in np.arange(1, self.offsets + 1) / (self.offsets + 1.0))]
        )
        moves, near = [], BESIDE * (right - left)
        for each in self.openings:
            reach = 0.5 * (right - left + each.profile.right - each.profile.left)
            beside = np.concatenate([right - each.dead[:, 0] + near, left - each.dead[:, 1] - near])
            offsets = np.concatenate([0.5 * (left + right) + reach * steps, beside])
            low = across[:, 0] - offsets[:, None, None]
            high = across[:, 1] - offsets[:, None, None]
            touched = (high > each.dead[:, :1]) & (low < each.dead[:, 1:])
            moves += [(each, float(x)) for x in offsets[~touched.any(axis=(1, 2))]]
        return moves


@dataclass
class _Search:
    """One search and the approaches it has looked at."""

    planner: Planner
    sweeps: int = 0
    spent: bool = False
    closings: dict[bytes, Close | None] = field(default_factory=dict)

    def solve(self, belief: BaseGeometry, depth: int) -> Policy | None:
        """A policy within so many approaches; None if none was found."""
        closing = self._closing(belief)
        if closing is not None or depth == 0 or self._too_wide(belief, depth):
            return closing
        for opening, x in self.planner.moves(belief):
            found = self._through(belief, opening, x, depth)
            if found is not None or self.spent:
                return found
        return None

    def _closing(self, belief: BaseGeometry) -> Close | None:
        key = shapely.to_wkb(belief)
        if key not in self.closings:
            self.closings[key] = self.planner.closing(belief)
        return self.closings[key]

    def _too_wide(self, belief: BaseGeometry, depth: int) -> bool:
        """Whether so many approaches cannot even touch all of a belief, but for parts that fit into the region."""
        across = max(each.profile.right - each.profile.left for each in self.planner.openings)
        region = max(each.target.extent[0] for each in self.planner.openings)
        return _width(belief) > depth * across + (depth + 1) * region

    def _swept(self, belief: BaseGeometry, opening: Opening, x: float) -> Sweep | None:
        """An approach that touches something; None for any other, or when enough have been looked at."""
        if self.sweeps >= self.planner.most_sweeps:
            self.spent = True
            return None
        self.sweeps += 1
        swept = sweep(belief, opening.profile, x, self.planner.doubt)
        return None if swept is None or all(each.sensor is None for each in swept.felt) else swept

    def _through(self, belief: BaseGeometry, opening: Opening, x: float, depth: int) -> Policy | None:
        """The policy of one approach if every part of the belief can be done afterwards; the widest part is asked first."""
        swept = self._swept(belief, opening, x)
        if swept is None:
            return None
        branches = []
        for each in sorted(swept.felt, key=lambda felt: -_width(felt.belief)):
            then = self.solve(each.belief, depth - 1)
            if then is None:
                return None
            branches.append(Branch(each.sensor, each.belief, then))
        return Approach(belief, x, swept.y, swept.distance, opening.angle, tuple(branches))

    def best_effort(self, belief: BaseGeometry, depth: int) -> Policy:
        """A policy that leaves some belief: of all first moves the one that leaves the narrowest, then the same again."""
        closing = self._closing(belief)
        if closing is not None or depth == 0:
            return closing or Lost(belief)
        best: tuple[float, Opening, Sweep] | None = None
        for opening, x in self.planner.moves(belief):
            swept = sweep(belief, opening.profile, x, self.planner.doubt)
            if swept is None:
                continue
            left = max((_width(each.belief) for each in swept.felt if self._closing(each.belief) is None), default=0.0)
            if left < (_width(belief) if best is None else best[0]):
                best = left, opening, swept
        if best is None:
            return Lost(belief)
        _, opening, swept = best
        branches = (Branch(each.sensor, each.belief, self.best_effort(each.belief, depth - 1)) for each in swept.felt)
        return Approach(belief, swept.x, swept.y, swept.distance, opening.angle, tuple(branches))


def _across(belief: BaseGeometry, margin: float) -> Floats:
    """The intervals of x (K, 2) over which the parts of a belief lie, with a margin (m)."""
    bounds = shapely.bounds(shapely.get_parts(belief))
    return np.stack([bounds[:, 0] - margin, bounds[:, 2] + margin], axis=1)


def _width(belief: BaseGeometry) -> float:
    left, _, right, _ = belief.bounds
    return float(right - left)
