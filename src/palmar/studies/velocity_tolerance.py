"""Which velocities a free disk may have at a given place to be caught: the largest disc of them about the nominal one.

Rays of velocities from the nominal one are followed outward until the first that is lost, at any restitution of the case,
and that end is bisected: the shortest ray is the radius, up to what lies between the rays and between the steps along
them: ``sampled``. Scaled with the finger rate: only v / w matters.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of, impact_law_of
from palmar.models.case import Case
from palmar.models.outcome import Outcome
from palmar.regions.captured import restitutions_of

Floats = NDArray[np.float64]
RAYS, STEPS, HALVINGS = 96, 128, 12
FASTEST = 2.0
"""Largest change of velocity looked at, in hand reaches times the finger rate."""


@dataclass(frozen=True)
class VelocityTolerance:
    """At ``at`` (m) velocities within ``radius`` (m/s) of ``about`` (m/s) are caught; ``worst`` is one at that edge.

    ``radius`` 0: the nominal velocity itself is lost. ``spacing`` (m/s) is that of the velocities tried along a ray.
    """

    at: tuple[float, float]
    about: tuple[float, float]
    radius: float
    worst: tuple[float, float] | None
    spacing: float


def velocity_tolerance(case: Case, at: tuple[float, float]) -> VelocityTolerance:
    """The largest disc about the case's start velocity; raises NotCoveredError for tables, polygons and other ranges."""
    hand, law, about = capture_hand_of(case), impact_law_of(case), np.array(case.start.velocity)
    most = FASTEST * hand.reach * case.hand.finger_rate

    def held(velocities: Floats) -> NDArray[np.bool_]:
        found = np.ones(len(velocities), bool)
        for e in restitutions_of(case)[::-1]:
            some = np.flatnonzero(found)
            ends = capture_all(hand, np.tile(at, (len(some), 1)), velocities[some], float(e), law=law)
            found[some] = ends.codes <= Outcome.CAGED.code
        return found

    spacing = most / STEPS
    if not held(about[None])[0]:
        return VelocityTolerance(at, case.start.velocity, 0.0, case.start.velocity, spacing)
    angles = 2.0 * np.pi * np.arange(RAYS) / RAYS
    ways = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    sizes = spacing * np.arange(1, STEPS + 1)
    lost = ~held((about + sizes[:, None, None] * ways).reshape(-1, 2)).reshape(STEPS, RAYS)
    first = np.where(lost.any(axis=0), lost.argmax(axis=0), STEPS - 1)
    high = sizes[first]
    low = np.where(lost.any(axis=0), high - spacing, high)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        yes = held(about + middle[:, None] * ways)
        low, high = np.where(yes, middle, low), np.where(yes, high, middle)
    k = int(low.argmin())
    worst = about + high[k] * ways[k]
    return VelocityTolerance(at, case.start.velocity, float(low[k]), (float(worst[0]), float(worst[1])), spacing)
