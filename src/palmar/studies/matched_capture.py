"""How often matching velocities catches the disk: runs of the behaviour, each with its own errors of the tracker.

Beside them the same chance without running anything (``drawn_capture``): with errors p of the place and q of the velocity,
made up for over the age d of the data, the hand closes on a disk at place - p - q d that moves at -q, wherever it flies.
If the data are older by l than is made up for, the disk is ahead by v l. The linear account of ``velocity_matching`` asks
instead whether the whole error stays within the region's largest circle.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from palmar.behaviours.match_velocity import MatchVelocity
from palmar.behaviours.reflex import Reflex
from palmar.errors import InputError
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of, impact_law_of
from palmar.models.case import Case
from palmar.models.outcome import Outcome
from palmar.studies.capture_sampled import clopper_pearson
from palmar.studies.run_behaviour import TRACKING, Circumstances, behaviour_of, run_behaviour
from palmar.worlds.planar.tracker import Tracker

CHUNK = 8
TICK = 0.02
"""Time (s) between two observations."""


@dataclass(frozen=True)
class MatchedCapture:
    """So many runs, caught ones among them, the 95 % interval (Clopper and Pearson) of the chance, and how runs ended."""

    runs: int
    caught: int
    low: float
    high: float
    ends: tuple[tuple[str, int], ...]
    """The last words of runs, the most frequent first, and how many ended so."""


def matched_capture(case: Case, tracker: Tracker, runs: int, executor: Executor, tick: float = TICK) -> MatchedCapture:
    """Run the case's behaviour from its start ``runs`` times, the k-th with the tracker's seed + k.

    Raises InputError for a behaviour that tracks nothing, NotCoveredError where it cannot be run.
    """
    if case.behaviour.name not in TRACKING:
        names = " or ".join(sorted(each.value for each in TRACKING))
        raise InputError("behaviour.name", repr(case.behaviour.name.value), f"must be {names}")
    if runs < 1:
        raise InputError("runs", str(runs), "must be at least 1")
    found = [each for part in executor.map(_run_some, _parts(case, tracker, runs, tick)) for each in part]
    caught = sum(held for held, _ in found)
    low, high = clopper_pearson(caught, runs)
    return MatchedCapture(runs, caught, low, high, tuple(Counter(why for _, why in found).most_common()))


def drawn_capture(case: Case, reflex: MatchVelocity, tracker: Tracker, draws: int) -> float:
    """The share of ``draws`` of the tracker's errors with which closing catches, the arm's limits left out."""
    rng = np.random.default_rng(tracker.seed)
    place, velocity = (
        rng.normal(size=(2, draws, 2)) * np.array([tracker.position_sigma, tracker.velocity_sigma])[:, None, None]
    )
    ahead = np.array(case.start.velocity) * (tracker.delay - reflex.age)
    starts = np.array(reflex.place) + ahead - place - velocity * reflex.age
    hand, law = capture_hand_of(case), impact_law_of(case)
    ends = capture_all(hand, starts, -velocity, case.contact.restitution, law=law)
    return float(np.mean(ends.codes <= Outcome.CAGED.code))


@dataclass(frozen=True)
class _Part:
    case: Case
    reflex: Reflex[Any]
    tick: float
    trackers: tuple[Tracker, ...]


def _parts(case: Case, tracker: Tracker, runs: int, tick: float) -> Iterator[_Part]:
    reflex = behaviour_of(case)
    for k in range(0, runs, CHUNK):
        seeds = range(tracker.seed + k, tracker.seed + min(k + CHUNK, runs))
        yield _Part(case, reflex, tick, tuple(replace(tracker, seed=seed) for seed in seeds))


def _run_some(part: _Part) -> list[tuple[bool, str]]:
    """Whether each run of a part catches, and its last words."""
    found = []
    for tracker in part.trackers:
        begin = (*part.case.start.at, part.case.start.theta)
        trace = run_behaviour(part.case, begin, Circumstances(part.tick, tracker=tracker), part.reflex).trace
        found.append((trace.outcome.caught, trace.rows[-1].why))
    return found
