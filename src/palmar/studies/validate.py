"""A region put to the test: random starts inside and outside of it, and what becomes of them in a world.

Starts are uniform over the area of the centre region and over a band of one object size (its largest diameter) about it,
those that overlap the open hand left out; none is nearer to the boundary than the margin. Where a region has an outer side,
the band begins there: between the two sides nothing is claimed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon
from shapely.geometry.base import BaseGeometry

from palmar.errors import InputError, NotCoveredError
from palmar.models.case import Case
from palmar.models.outcome import Outcome
from palmar.regions.region import Region
from palmar.regions.simulated import object_reach
from palmar.studies.simulate import simulate_starts
from palmar.studies.simulate_in_world import simulate_starts_in
from palmar.worlds.world import WorldMaker

Floats = NDArray[np.float64]
CHUNK = 4
"""Starts that a process runs before it reports."""
MOST_DRAWS = 1000
"""Draws of a thousand candidates before a set counts as too thin to hit."""


@dataclass(frozen=True)
class Tried:
    """One start (x, y in m, theta in rad), on which side and how far (m) from the boundary, and what became of it.

    ``planar``: what the planar kernels say of it; only for starts that did not end as the region has it.
    """

    start: tuple[float, float, float]
    inside: bool
    distance: float
    outcome: Outcome
    planar: Outcome | None = None

    @property
    def as_told(self) -> bool:
        """Whether it was caught from inside or lost from outside."""
        return self.outcome.caught == self.inside


@dataclass(frozen=True)
class Validation:
    """Every start tried, in the order of the draw: those inside, then those outside."""

    tried: tuple[Tried, ...]

    def count(self, *, inside: bool, caught: bool) -> int:
        """How many starts of one side ended so."""
        return sum(each.inside == inside and each.outcome.caught == caught for each in self.tried)

    @property
    def surprises(self) -> tuple[Tried, ...]:
        """Starts lost from inside or caught from outside, the farthest from the boundary first."""
        return tuple(sorted((each for each in self.tried if not each.as_told), key=lambda each: -each.distance))


def validate(
    case: Case,
    region: Region,
    samples: int,
    seed: int,
    margin: float = 0.0,
    make: WorldMaker | None = None,
    executor: Executor | None = None,
    report: Callable[[int], None] | None = None,
) -> Validation:
    """Try ``samples`` starts, one half (the larger) inside; ``make``: the world, None the planar kernels.

    ``report`` hears how many are done. An empty region has no inside to draw from: nothing is tried. Raises InputError
    where the margin (m) leaves nothing of a side, NotCoveredError for ranges.
    """
    if case.ranges:
        raise NotCoveredError("validation takes plain numbers, not ranges")
    if region.centre.is_empty:
        return Validation(())
    rng = np.random.default_rng(seed)
    theta = case.start.theta
    known = region.centre if region.outer is None else region.outer
    within = _inside(region.centre, margin)
    beside = known.buffer(2.0 * object_reach(case.object)) - known.buffer(margin)
    inside, outside = (samples + 1) // 2, samples // 2
    starts = np.vstack([_drawn(case, within, inside, theta, rng), _drawn(case, beside, outside, theta, rng)])
    outcomes = _outcomes(case, starts, make, executor, report)
    points = shapely.points(starts[:, :2])
    far = np.where(np.arange(samples) < inside, region.centre.boundary.distance(points), known.distance(points))
    tried = [
        Tried((float(x), float(y), theta), k < inside, float(far[k]), outcomes[k]) for k, (x, y, _) in enumerate(starts)
    ]
    return Validation(tuple(_with_planar(case, tried) if make is not None else tried))


def _inside(region: MultiPolygon, margin: float) -> BaseGeometry:
    return region.buffer(-margin) if margin > 0.0 else region


def _drawn(case: Case, where: BaseGeometry, number: int, theta: float, rng: np.random.Generator) -> Floats:
    """Valid starts (N, 3), uniform over a set."""
    found = np.empty((0, 3))
    if number == 0:
        return found
    low, high = np.reshape(where.bounds, (2, 2)) if not where.is_empty else np.zeros((2, 2))
    shapely.prepare(where)
    for _ in range(MOST_DRAWS if where.area > 0.0 else 0):
        places = rng.uniform(low, high, (1000, 2))
        places = places[shapely.contains_xy(where, places[:, 0], places[:, 1])]
        rows = np.column_stack([places, np.full(len(places), theta)])
        if len(rows):
            rows = rows[simulate_starts(case, rows).codes != Outcome.INVALID.code]
        found = np.vstack([found, rows])
        if len(found) >= number:
            return found[:number]
    raise InputError("--margin-mm", None, "leaves no room for starts on one side of the boundary")


def _outcomes(
    case: Case,
    starts: Floats,
    make: WorldMaker | None,
    executor: Executor | None,
    report: Callable[[int], None] | None,
) -> list[Outcome]:
    if make is None:
        return _run_some((case, starts, None))
    found: list[Outcome] = []
    parts = list(_parts(case, starts, make))
    for part in map(_run_some, parts) if executor is None or len(parts) == 1 else executor.map(_run_some, parts):
        found += part
        if report is not None:
            report(len(found))
    return found


def _parts(case: Case, starts: Floats, make: WorldMaker) -> Iterator[tuple[Case, Floats, WorldMaker]]:
    for k in range(0, len(starts), CHUNK):
        yield case, starts[k : k + CHUNK], make


def _run_some(part: tuple[Case, Floats, WorldMaker | None]) -> list[Outcome]:
    case, starts, make = part
    ends = simulate_starts(case, starts) if make is None else simulate_starts_in(case, starts, make)
    return [Outcome.from_code(int(code)) for code in ends.codes]


def _with_planar(case: Case, tried: list[Tried]) -> list[Tried]:
    """What the planar kernels say of the starts that did not end as the region has it."""
    odd = [k for k, each in enumerate(tried) if not each.as_told]
    if not odd:
        return tried
    codes = simulate_starts(case, np.array([tried[k].start for k in odd])).codes
    told = dict(zip(odd, (Outcome.from_code(int(code)) for code in codes), strict=True))
    return [replace(each, planar=told.get(k)) for k, each in enumerate(tried)]
