"""Where the object ends up: the set of final poses of many starts, and how much the closing motion centres it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot, sqrt

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from palmar.mechanics.pushing.closing import Ends
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.studies.simulate import simulate_starts

Floats = NDArray[np.float64]
Interval = tuple[float, float]
STARTS = 20_000
"""About so many starts, on a square grid over the set."""
FEWER = 2_000
"""For polygons, which are carried in steps."""
LEVELS = (0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0)
NEAR = 1e-4
"""Within this share of the finger's length the object counts as on the axis or on the palm."""


@dataclass(frozen=True)
class KindOfEnd:
    """One way to end: its share of the starts, and the extremes of place (m), turn and base angles (rad).

    ``smaller`` and ``larger`` are the lesser and the greater of the two base angles.
    """

    name: str
    meaning: str
    caught: bool
    share: float
    x: Interval
    y: Interval
    turn: Interval
    smaller: Interval
    larger: Interval


@dataclass(frozen=True)
class FinalPoses:
    """Ends of ``starts`` starts, ``spacing`` (m) apart over a set; places, turns and spreads are those of caught ones.

    ``height_levels`` are quantiles (m) of the distance from the palm at LEVELS; ``before`` and ``after`` root mean square
    distances (m) from the mean place.
    """

    starts: int
    spacing: float
    caught: float
    kinds: tuple[KindOfEnd, ...]
    x: Interval
    y: Interval
    turn: Interval
    height_levels: tuple[float, ...]
    before: float
    after: float

    @property
    def centring(self) -> float | None:
        """Spread after over spread before; below one the motion gathers the objects."""
        return self.after / self.before if self.before > 0.0 else None


def final_poses(case: Case, starts: BaseGeometry) -> FinalPoses | None:
    """Simulate a grid of starts over a set (m, hand frame), at the case's start angle; None if nothing is caught.

    Raises NotCoveredError where no kernel carries the case.
    """
    places, spacing = grid(starts, STARTS if isinstance(case.object, Disk) else FEWER)
    poses = np.column_stack([places, np.full(len(places), case.start.theta)])
    ends = simulate_starts(case, poses)
    caught = ends.codes <= Outcome.CAGED.code
    if not caught.any():
        return None
    turns = ends.poses[:, 2] - case.start.theta
    last = ends.poses[caught]
    return FinalPoses(
        len(places),
        spacing,
        float(caught.mean()),
        tuple(sorted(_kinds(case, ends, turns), key=lambda each: -each.share)),
        _interval(last[:, 0]),
        _interval(last[:, 1]),
        _interval(turns[caught]),
        tuple(float(each) for each in np.quantile(last[:, 1], LEVELS)),
        _spread(places[caught]),
        _spread(last[:, :2]),
    )


def grid(shape: BaseGeometry, count: int) -> tuple[Floats, float]:
    """About ``count`` points (N, 2) of a set on a square grid, and its spacing, both m; a small set gives its middle."""
    left, low, right, high = shape.bounds
    spacing = sqrt(shape.area / count)
    columns, rows = (max(1, round(length / spacing)) for length in (right - left, high - low))
    x = left + (np.arange(columns) + 0.5) * (right - left) / columns
    y = low + (np.arange(rows) + 0.5) * (high - low) / rows
    points = np.column_stack([each.ravel() for each in np.meshgrid(x, y)])
    inside = points[shapely.contains_xy(shape, points)]
    if len(inside) == 0:
        inside = np.array([shapely.point_on_surface(shape).coords[0]])
    return inside, spacing


def _kinds(case: Case, ends: Ends, turns: Floats) -> Iterator[KindOfEnd]:
    for name, (meaning, of_kind) in _classes(case, ends).items():
        if not of_kind.any():
            continue
        angles = np.sort(ends.fingers[of_kind], axis=1)
        caught = bool(ends.codes[of_kind][0] <= Outcome.CAGED.code)
        columns = (ends.poses[of_kind, 0], ends.poses[of_kind, 1], turns[of_kind], angles[:, 0], angles[:, 1])
        yield KindOfEnd(name, meaning, caught, float(of_kind.mean()), *map(_interval, columns))


def _classes(case: Case, ends: Ends) -> dict[str, tuple[str, NDArray[np.bool_]]]:
    """Names of the ways to end, what they mean, and which ends are of each."""
    codes = ends.codes
    lost = {each.value: (_LOST[each], codes == each.code) for each in Outcome if not each.caught and each in _LOST}
    caged = {"caged": ("enclosed with play", codes == Outcome.CAGED.code)}
    held = codes <= Outcome.FRICTIONAL.code
    if not isinstance(case.object, Disk):
        kinds = {"structural": "held without friction", "frictional": "held by friction"}
        by_code = {name: (meaning, codes == Outcome(name).code) for name, meaning in kinds.items()}
        return {**by_code, **caged, **lost}
    near = NEAR * case.hand.finger_length
    on_axis, on_palm = np.abs(ends.poses[:, 0]) < near, ends.poses[:, 1] < case.object.radius + near
    return {
        "centred": ("on the palm and on the axis, held by palm and both fingers", held & on_axis & on_palm),
        "pinched": ("between both fingers, off the palm", held & ~on_palm),
        "wedged": ("on the palm off the axis, wedged by one finger", held & on_palm & ~on_axis),
        **caged,
        **lost,
    }


_LOST = {
    Outcome.ESCAPED: "touched, then lost",
    Outcome.MISSED: "never touched",
    Outcome.JAMMED: "stalled the fingers without a hold",
    Outcome.INVALID: "overlaps the hand at the start",
    Outcome.UNDECIDED: "not decided",
}


def _interval(values: Floats) -> Interval:
    return float(values.min()), float(values.max())


def _spread(places: Floats) -> float:
    """Root mean square distance (m) from the mean."""
    return hypot(*np.std(places, axis=0))
