"""A region put to the test: random starts inside and outside of it, and what becomes of them in a world.

Starts are uniform over the area of the centre region and over a band of one object size (its largest diameter) about it,
those that overlap the open hand left out; none is nearer to the boundary than the margin. Where a region has an outer side,
the band begins there: between the two sides nothing is claimed.

In another world each start is run in the planar one too: do the two agree? Where they do not, one cause is looked for: how
near to the start the planar world answers otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
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
from palmar.studies.trials_in_world import change_aside, in_one_go, outcomes, valid
from palmar.worlds.world import WorldMaker

Floats = NDArray[np.float64]
CHUNK = 4
"""Starts that a process runs before it reports."""
MOST_DRAWS = 1000
"""Draws of a thousand candidates before a set counts as too thin to hit."""
ASIDE = tuple(1e-3 * each for each in (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0))
"""Distances (m) at which the planar world is asked about a start on which the worlds differ."""


@dataclass(frozen=True)
class Tried:
    """One start (x, y in m, theta in rad), on which side and how far (m) from the boundary, and what became of it.

    ``planar``: what becomes of it in the planar world, None where that is the world; ``aside``: where the two
    differ, the first of ASIDE at which the planar world answers otherwise, None where there is none.
    """

    start: tuple[float, float, float]
    inside: bool
    distance: float
    outcome: Outcome
    planar: Outcome | None = None
    aside: float | None = None

    @property
    def as_told(self) -> bool:
        """Whether it was caught from inside or lost from outside."""
        return self.outcome.caught == self.inside

    @property
    def disputed(self) -> bool:
        """Whether it is caught in one world and lost in the other."""
        return self.planar is not None and self.planar.caught != self.outcome.caught


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

    @property
    def disputed(self) -> tuple[Tried, ...]:
        """Starts that one world catches and the other loses."""
        return tuple(each for each in self.tried if each.disputed)

    def agreeing(self, *, exactly: bool) -> int | None:
        """How many starts end in both worlds with the same outcome, or at least caught in both or lost in both."""
        if any(each.planar is None for each in self.tried):
            return None
        return sum(each.planar is each.outcome if exactly else not each.disputed for each in self.tried)


def validate(
    case: Case,
    region: Region,
    samples: int,
    seed: int,
    margin: float = 0.0,
    make: WorldMaker | None = None,
    executor: Executor | None = None,
    past: Mapping[int, Outcome] | None = None,
    keep: Callable[[int, Outcome], None] | None = None,
) -> Validation:
    """Try ``samples`` starts, one half (the larger) inside; ``make``: the world, None the planar one.

    ``past``: outcomes by number from an earlier run with the same arguments; ``keep`` hears of each new one. An empty
    region has no inside to draw from: nothing is tried. Raises InputError where the margin (m) leaves nothing of a side,
    NotCoveredError for ranges.
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
    ended = _outcomes(case, starts, make, executor, past or {}, keep)
    points = shapely.points(starts[:, :2])
    far = np.where(np.arange(samples) < inside, region.centre.boundary.distance(points), known.distance(points))
    tried = [
        Tried((float(x), float(y), theta), k < inside, float(far[k]), ended[k]) for k, (x, y, _) in enumerate(starts)
    ]
    return Validation(tuple(_with_planar(case, tried, executor) if make is not None else tried))


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
            rows = rows[valid(case, rows)]
        found = np.vstack([found, rows])
        if len(found) >= number:
            return found[:number]
    raise InputError("--margin-mm", None, "leaves no room for starts on one side of the boundary")


def _outcomes(
    case: Case,
    starts: Floats,
    make: WorldMaker | None,
    executor: Executor | None,
    past: Mapping[int, Outcome],
    keep: Callable[[int, Outcome], None] | None,
) -> list[Outcome]:
    """Of starts (N, 3), those of the past taken as they were."""
    if in_one_go(case, make):
        return outcomes(case, starts, make)
    found = dict(past)
    parts = list(_parts(case, starts, [k for k in range(len(starts)) if k not in found], make))
    for part, ends in zip(
        parts, map(_run_some, parts) if executor is None else executor.map(_run_some, parts), strict=True
    ):
        for k, outcome in zip(part[0], ends, strict=True):
            found[k] = outcome
            if keep is not None:
                keep(k, outcome)
    return [found[k] for k in range(len(starts))]


_Part = tuple[list[int], Case, Floats, WorldMaker | None]


def _parts(case: Case, starts: Floats, numbers: Sequence[int], make: WorldMaker | None) -> Iterator[_Part]:
    for k in range(0, len(numbers), CHUNK):
        some = list(numbers[k : k + CHUNK])
        yield some, case, starts[some], make


def _run_some(part: _Part) -> list[Outcome]:
    _, case, starts, make = part
    return outcomes(case, starts, make)


def _with_planar(case: Case, tried: list[Tried], executor: Executor | None) -> list[Tried]:
    """What becomes of the starts in the planar world, and where it answers otherwise."""
    planar = _outcomes(case, np.array([each.start for each in tried]), None, executor, {}, None)
    both = [replace(each, planar=told) for each, told in zip(tried, planar, strict=True)]
    return [replace(each, aside=change_aside(case, each.start, ASIDE)) if each.disputed else each for each in both]
