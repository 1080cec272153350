"""The region for numbers known only within limits: what is caught for all of their values.

Every combination of a few values of each number gives a closed-form region; what is caught for all is their
intersection. Between the values the boundary moves smoothly, so refining the values moves the intersection less and less,
by about a quarter each time; it is shrunk by the whole of the last move. That is no proof: the guarantee is ``sampled``.
A range of friction needs none of this, its lowest value decides (``exact``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np
import shapely
from shapely import MultiPolygon
from shapely.geometry.base import BaseGeometry

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import EMPTY, areal
from palmar.models.case import Case

VALUES = {1: 9, 2: 5, 3: 3, 4: 3}
"""Values of each number in the first pass, by how many have a range; the second pass halves the steps."""

Sides = tuple[MultiPolygon, MultiPolygon]
"""Inner and outer side of a region."""


SIMPLER = 1e-5
"""Of outlines that are compared, in finger lengths."""


@dataclass(frozen=True)
class RobustSets:
    """Inner and outer side (m) of what is caught for all values; the number of cases, and by how much (m) it is shrunk."""

    centre: MultiPolygon
    outer: MultiPolygon
    cases: int
    shrunk: float


def robust_sets(case: Case, region_of: Callable[[Case], Sides]) -> RobustSets:
    """Intersect ``region_of`` over the case's ranges; raises NotCoveredError for more than four of them."""
    if len(case.ranges) not in VALUES:
        raise NotCoveredError(f"{len(case.ranges)} ranges: a region takes at most {max(VALUES)} besides friction")
    count = VALUES[len(case.ranges)]
    grids = [np.linspace(each.low, each.high, 2 * count - 1) for each in case.ranges]
    coarse: BaseGeometry | None = None
    inner: BaseGeometry | None = None
    outer: BaseGeometry | None = None
    numbers = list(product(range(2 * count - 1), repeat=len(grids)))
    for index in sorted(numbers, key=lambda each: any(k % 2 for k in each)):
        if inner is not None and inner.is_empty:
            return RobustSets(EMPTY, EMPTY if outer is None else areal(outer), len(numbers), 0.0)
        if any(k % 2 for k in index) and coarse is None:
            coarse = inner
        inside, outside = region_of(case.settled([float(grid[k]) for grid, k in zip(grids, index, strict=True)]))
        inner = inside if inner is None else inner & inside
        outer = outside if outer is None else outer & outside
    assert coarse is not None and inner is not None and outer is not None
    moved = 0.0 if inner.is_empty else _apart(coarse, inner, SIMPLER * case.hand.finger_length)
    return RobustSets(areal(inner.buffer(-moved)), areal(outer), len(numbers), moved)


def _apart(one: BaseGeometry, other: BaseGeometry, tolerance: float) -> float:
    """How far (m) two outlines are apart at most; both are simplified by ``tolerance``, for its time is their product."""
    first, second = (shapely.simplify(each.boundary, tolerance) for each in (one, other))
    return float(shapely.hausdorff_distance(first, second)) + 2.0 * tolerance
