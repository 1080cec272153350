"""So many objects for every closing of a plan, however seldom one comes there from where it may be.

The first draws are from all of the uncertainty, corners and edge among them; all are followed to their end. Closings
with too few arrivals are then sought where objects that came there started: within the bounds of those starts, a little
grown, which grow with them; what comes to closings that have enough is then left out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.policy import Policy
from palmar.models.case import Case
from palmar.models.sensors import Stretch
from palmar.studies.plan_trial import Arrival, Errors, Run, Trial, drawn_starts

Floats = NDArray[np.float64]
ROUNDS = 100
"""Times that a closing is sought before it is left with what it has."""
GROWN, LEAST = 0.05, 1e-4
"""By which the bounds of known starts are grown, and at least, as a share of the uncertainty's."""
DRAWN, MOST = 1.5, 400_000
"""Objects drawn for each that is missing, and at most."""


@dataclass
class _Zone:
    """Bounds (m) of the starts that came to a closing."""

    low: Floats
    high: Floats

    def take(self, starts: Floats) -> None:
        self.low = np.minimum(self.low, starts.min(axis=0))
        self.high = np.maximum(self.high, starts.max(axis=0))


def try_leaves(
    case: Case,
    policy: Policy,
    stretches: tuple[Stretch, ...],
    uncertainty: BaseGeometry,
    errors: Errors,
    per_leaf: int,
    seed: int = 0,
) -> Trial:
    """At least ``per_leaf`` objects drawn in all, and as many for every closing that any object was seen to come to."""
    run = Run(case, policy, stretches, errors, np.random.default_rng(seed))
    starts = drawn_starts(uncertainty, per_leaf, seed)
    zones = [_Zone(np.full(2, np.inf), np.full(2, -np.inf)) for _ in run.of_leaves]
    arrived = run.arrivals(starts)
    for each in arrived:
        if len(each.who):
            zones[each.leaf].take(starts[each.who])
    run.close(arrived)
    trial = run.trial(starts)
    rng = np.random.default_rng(seed + 1)
    for _ in range(ROUNDS):
        poor = [k for k in range(len(zones)) if run.of_leaves[k] < per_leaf and np.isfinite(zones[k].low).all()]
        for leaf in poor:
            if run.of_leaves[leaf] < per_leaf:
                _seek(run, uncertainty, zones, leaf, per_leaf, rng)
    after = run.trial(starts)
    return replace(after, examples=trial.examples)


def _seek(
    run: Run, uncertainty: BaseGeometry, zones: list[_Zone], leaf: int, per_leaf: int, rng: np.random.Generator
) -> None:
    """Draw where objects for a closing came from, and close on those that come there, or where others are missing."""
    left, bottom, right, top = uncertainty.bounds
    zone, missing = zones[leaf], np.maximum(per_leaf - run.of_leaves, 0)
    grown = GROWN * (zone.high - zone.low) + LEAST * np.array([right - left, top - bottom])
    number = min(int(DRAWN * missing[leaf]), MOST) + 64
    starts = rng.uniform(zone.low - grown, zone.high + grown, (number, 2))
    starts = starts[shapely.contains_xy(uncertainty, starts)]
    found: list[Arrival] = []
    for each in run.arrivals(starts):
        if len(each.who):
            zones[each.leaf].take(starts[each.who])
        most = len(each.who) if each.done else int(missing[each.leaf])
        found.append(replace(each, places=each.places[:most], who=each.who[:most]))
    run.close(found)
