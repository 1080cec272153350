"""A tracker of the object: what a vision system tells of its place and velocity, late and in error."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field
from math import inf

import numpy as np

from palmar.errors import InputError
from palmar.models.motion import Track

Moment = tuple[float, Track]


@dataclass(frozen=True)
class Tracker:
    """Age of what is told (s), standard deviations of position (m) and velocity (m/s) per axis, seed of their draw.

    The errors are drawn once for a run: those of a camera's calibration and of a filter change slowly against a grasp.
    """

    delay: float = 0.0
    position_sigma: float = 0.0
    velocity_sigma: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        for name in ("delay", "position_sigma", "velocity_sigma"):
            if not 0.0 <= getattr(self, name) < inf:
                raise InputError(name, repr(getattr(self, name)), "must be finite and not negative")

    def errors(self) -> Track:
        """Of position and velocity, Gaussian and independent."""
        x, y, vx, vy = np.random.default_rng(self.seed).normal(size=4) * (
            self.position_sigma, self.position_sigma, self.velocity_sigma, self.velocity_sigma
        )  # fmt: skip
        return float(x), float(y), float(vx), float(vy)


@dataclass
class Tracked:
    """What the tracker has seen so far: moments of the object's motion, straight between and before them."""

    tracker: Tracker
    errors: Track
    moments: list[Moment] = field(default_factory=list)

    def see(self, time: float, truth: Track) -> None:
        """At ``time`` (s) the object is and moves like that, until it is seen again."""
        self.moments.append((time, truth))

    def tell(self, time: float) -> Track:
        """What is told at ``time`` (s): where the object was and how it moved ``delay`` before."""
        then = time - self.tracker.delay
        k = bisect_right(self.moments, then, key=lambda each: each[0])
        since, (x, y, vx, vy) = self.moments[max(k - 1, 0)]
        dx, dy, dvx, dvy = self.errors
        past = then - since
        return x + vx * past + dx, y + vy * past + dy, vx + dvx, vy + dvy


def tracked(tracker: Tracker) -> Tracked:
    """A tracker that has seen nothing yet."""
    return Tracked(tracker, tracker.errors())
