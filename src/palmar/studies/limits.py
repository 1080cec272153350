"""The source's search for a pre-image by trial and error (section 6.2), in any world.

Along each of some directions the object is placed, the motion is triggered, and the next place is further out where that
ended in a grasp and further in where it did not, until the limit is known to a tolerance: the last place that was caught.
Between a place that was caught and one beyond it that was not, the next one is in the middle. A place where the object
overlaps the open hand is too far in.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from math import ceil, cos, hypot, log2, pi, sin, sqrt

import numpy as np
from shapely import LineString, MultiPolygon, get_coordinates

from palmar.models.case import Case
from palmar.models.outcome import Outcome
from palmar.studies.trials_in_world import in_one_go, outcomes
from palmar.worlds.world import WorldMaker

FIRST, STRIDE = (0.4, 0.9), 0.125
"""The first distance is drawn between these, and the first steps are this long, in finger lengths."""
MOST_TRIALS = 100
"""In one direction."""


@dataclass(frozen=True)
class Rules:
    """Rays from ``about`` (m) at ``angles`` (rad, from the palm's outward line); limits are known to ``tolerance`` (m).

    Places err by up to ``placing`` (m), uniformly; these errors and the first distances come from ``seed``. They lie so
    far ``aside`` (m, to the left) of the rays: from a joint, with a disk's radius, distances are of the finger's first
    contact. ``wanted``: outcomes that count as a success, None those of caught objects.
    """

    about: tuple[float, float]
    angles: tuple[float, ...]
    tolerance: float
    placing: float = 0.0
    seed: int = 0
    aside: float = 0.0
    wanted: tuple[Outcome, ...] | None = None

    def success(self, outcome: Outcome) -> bool:
        """Whether an outcome counts as one."""
        return outcome.caught if self.wanted is None else outcome in self.wanted

    def outward(self, trial: Trial) -> bool:
        """Whether the next place is further out."""
        return self.success(trial.outcome) or trial.outcome is Outcome.INVALID


@dataclass(frozen=True)
class Trial:
    """One trial in direction number ``ray``: the distance (m) aimed at, the place (m) hit, and what became of it."""

    ray: int
    distance: float
    placed: tuple[float, float]
    outcome: Outcome


@dataclass(frozen=True)
class Limit:
    """Of one direction (rad): largest distance (m) caught, None without any; what a region predicts; all trials."""

    angle: float
    distance: float | None
    predicted: float | None
    trials: tuple[Trial, ...]

    @property
    def difference(self) -> float | None:
        """Found less predicted (m)."""
        return None if self.distance is None or self.predicted is None else self.distance - self.predicted


def limits(
    case: Case,
    rules: Rules,
    region: MultiPolygon | None = None,
    make: WorldMaker | None = None,
    executor: Executor | None = None,
    past: Sequence[Trial] = (),
    keep: Callable[[Trial], None] | None = None,
) -> tuple[Limit, ...]:
    """Search in every direction, one trial of each at a time; ``make``: the world, None the planar one.

    ``past``: trials of an earlier run under the same rules, not made again; ``keep`` is given each new one.
    ``region``: the centre region (m) that the limits are compared with, if with any.
    """
    trials: list[list[Trial]] = [[each for each in past if each.ray == k] for k in range(len(rules.angles))]
    while True:
        asked = [
            (k, distance)
            for k in range(len(rules.angles))
            if (distance := next_distance(case.hand.finger_length, rules, k, trials[k])) is not None
        ]
        if not asked:
            break
        places = [_place(rules, k, distance, len(trials[k])) for k, distance in asked]
        parts = [(case, place, make) for place in places]
        alone = executor is None or in_one_go(case, make)
        ends = map(_run, parts) if alone or executor is None else executor.map(_run, parts)
        for (k, distance), place, outcome in zip(asked, places, ends, strict=True):
            trial = Trial(k, distance, place, outcome)
            trials[k].append(trial)
            if keep is not None:
                keep(trial)
    return tuple(
        Limit(angle, _farthest(rules, made), reach(region, rules.about, angle), tuple(made))
        for angle, made in zip(rules.angles, trials, strict=True)
    )


def next_distance(length: float, rules: Rules, ray: int, made: Sequence[Trial]) -> float | None:
    """Where (m) to place next after these trials, None once the limit is known; ``length`` (m) of a finger."""
    if not made:
        return length * float(np.random.default_rng([rules.seed, ray]).uniform(*FIRST))
    near = max((each.distance for each in made if rules.outward(each)), default=None)
    if near is None:
        inward = min(each.distance for each in made) - STRIDE * length
        return inward if inward > 0.0 else None
    far = min((each.distance for each in made if not rules.outward(each) and each.distance > near), default=None)
    if far is None:
        return near + STRIDE * length if len(made) < MOST_TRIALS else None
    return 0.5 * (near + far) if far - near > rules.tolerance and len(made) < MOST_TRIALS else None


def reach(region: MultiPolygon | None, about: tuple[float, float], angle: float) -> float | None:
    """Distance (m) at which a ray leaves a set for the last time, None where it does not meet it."""
    if region is None or region.is_empty:
        return None
    left, low, right, high = region.bounds
    far = 2.0 * (hypot(*about) + hypot(max(-left, right), max(-low, high)))
    ray = LineString([about, (about[0] + far * cos(angle), about[1] + far * sin(angle))])
    points = get_coordinates(region.intersection(ray))
    return float(np.hypot(*(points - about).T).max()) if len(points) else None


def _farthest(rules: Rules, made: Sequence[Trial]) -> float | None:
    """Largest distance (m) of a success."""
    return max((each.distance for each in made if rules.success(each.outcome)), default=None)


def _place(rules: Rules, ray: int, distance: float, number: int) -> tuple[float, float]:
    """The point aimed at, missed by the placing error of this trial."""
    share, way = np.random.default_rng([rules.seed, ray, number + 1]).uniform(size=2)
    off, angle = rules.placing * sqrt(float(share)), rules.angles[ray]
    x = rules.about[0] + distance * cos(angle) - rules.aside * sin(angle) + off * cos(2.0 * pi * way)
    y = rules.about[1] + distance * sin(angle) + rules.aside * cos(angle) + off * sin(2.0 * pi * way)
    return float(x), float(y)


def _run(part: tuple[Case, tuple[float, float], WorldMaker | None]) -> Outcome:
    case, (x, y), make = part
    return outcomes(case, np.array([[x, y, case.start.theta]]), make)[0]


def left_to_do(length: float, rules: Rules, made: Sequence[Trial]) -> int:
    """About how many trials are still to be made in all directions after these, were no limit further than two steps."""
    whole = 0
    for ray in range(len(rules.angles)):
        mine = [each for each in made if each.ray == ray]
        if next_distance(length, rules, ray, mine) is None:
            continue
        near = max((each.distance for each in mine if rules.outward(each)), default=None)
        far = min(
            (each.distance for each in mine if not rules.outward(each) and (near is None or each.distance > near)),
            default=None,
        )
        known = near is not None and far is not None
        gap = far - near if near is not None and far is not None else STRIDE * length
        whole += (0 if known else 2) + max(1, ceil(log2(max(gap / rules.tolerance, 1.0))))
    return whole
