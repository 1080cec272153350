"""What planning needs of a hand: at each opening its profile and where closing is certain; turns; and what is assumed."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, remainder

import numpy as np
from numpy.typing import NDArray
from shapely import MultiPolygon
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.approach import Doubt, grow
from palmar.behaviours.placing import Place, Target, place
from palmar.behaviours.policy import Close, seen_turned
from palmar.regions.profile import DEAD, Profile

Floats = NDArray[np.float64]
OFFSETS = 32
"""Offsets tried to either side of the middle."""
MOST_SWEEPS = 600
"""Approaches that a search looks at before it gives up."""
STRAIGHT = 1e-12
"""A smaller turn (rad) is none."""


@dataclass(frozen=True)
class Opening:
    """Fingers at one base angle (rad): the profile then, and the region of closing from there.

    ``outer`` (m) holds all centres that closing may catch for certain after the hand has come straight from below.
    ``swept`` holds all centres that the hand may touch on its way there, while it closes, and on its way back.
    """

    angle: float
    profile: Profile
    target: Target
    outer: MultiPolygon
    swept: BaseGeometry

    @property
    def dead(self) -> Floats:
        """Intervals of x (K, 2) in which a part without a sensor would touch."""
        spans = [each.points[[0, -1], 0] for each in self.profile.pieces if each.owner == DEAD]
        return np.array(spans).reshape(-1, 2)


@dataclass(frozen=True)
class Planner:
    """``openings`` in the order in which they are preferred; ``directions`` (rad) the hand may face, 0 as at the start."""

    openings: tuple[Opening, ...]
    doubt: Doubt
    directions: tuple[float, ...] = (0.0,)
    offsets: int = OFFSETS
    most_sweeps: int = MOST_SWEEPS

    def turned(self, belief: BaseGeometry, facing: float) -> list[tuple[float, BaseGeometry]]:
        """Turns (rad) of a hand that faces one way, the smallest first, and the belief seen after each."""
        turns = sorted((remainder(each - facing, 2.0 * pi) for each in self.directions), key=abs)
        turns = [0.0 if abs(each) < STRAIGHT else each for each in turns]
        return [(each, seen_turned(belief, each)) for each in turns]

    def closing(self, belief: BaseGeometry, facing: float = 0.0) -> Close | None:
        """The proof that one placed closing motion catches all of a belief; None without one.

        Of all openings with the largest margin, after the smallest turn with which there is any.
        """
        for turn, seen in self.turned(belief, facing):
            doubtful = grow(seen, self.doubt.pose_error)
            best: tuple[Place, Opening] | None = None
            for each in self.openings:
                found = place(each.target, doubtful)
                if found is not None and (best is None or found.margin > best[0].margin):
                    best = found, each
            if best is not None:
                return Close(belief, best[0], best[1].angle, turn)
        return None
