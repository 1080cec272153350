"""A plan put to the test: objects drawn from the uncertainty, every branch followed, every close carried to its end.

It shares no geometry with the planner: touches come from sphere tracing (``worlds.planar.feeling``), grasps from the
stepping kernel. The object stays while it is touched, but for the displacement.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.policy import Approach, Close, Lost, Policy
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.models.sensors import Stretch
from palmar.worlds.planar.feeling import NOTHING, go_until_touched
from palmar.worlds.planar.stepping import stepping_world

Floats = NDArray[np.float64]
CAUGHT = tuple(each.code for each in Outcome if each.caught)


@dataclass(frozen=True)
class Errors:
    """What happens, whatever the plan assumes: largest displacement and pose error (m), share of bits missed."""

    displacement: float = 0.0
    pose_error: float = 0.0
    missed: float = 0.0


@dataclass(frozen=True)
class Trial:
    """How many starts were caught, and lost: after closing, by a touch that the plan does not know, or left by the plan.

    ``of_leaves``: how many came to each closing, in the order of the tree.
    """

    caught: int
    lost: int
    surprised: int
    given_up: int
    most_approaches: int
    examples: tuple[tuple[float, float], ...]
    of_leaves: tuple[int, ...]

    @property
    def starts(self) -> int:
        """All of them."""
        return self.caught + self.lost + self.surprised + self.given_up


@dataclass
class _Tally:
    caught: int = 0
    lost: int = 0
    surprised: int = 0
    given_up: int = 0
    most: int = 0
    leaves: list[int] = field(default_factory=list)


def drawn_starts(uncertainty: BaseGeometry, number: int, seed: int) -> Floats:
    """Places (N, 2) of a set: its corners, places along its edge, and places drawn within."""
    rng = np.random.default_rng(seed)
    corners = shapely.get_coordinates(uncertainty)
    rings = [shapely.get_coordinates(each) for each in shapely.get_parts(shapely.boundary(uncertainty))]
    edges = np.concatenate([np.stack([each[:-1], each[1:]], axis=1) for each in rings])
    lengths = np.hypot(*(edges[:, 1] - edges[:, 0]).T)
    chosen = edges[rng.choice(len(edges), max(number // 4 - len(corners), 0), p=lengths / lengths.sum())]
    rim = chosen[:, 0] + rng.uniform(size=(len(chosen), 1)) * (chosen[:, 1] - chosen[:, 0])
    left, bottom, right, top = uncertainty.bounds
    inner: list[Floats] = []
    missing = number - len(corners) - len(rim)
    while missing > 0:
        tried = rng.uniform((left, bottom), (right, top), (2 * missing + 16, 2))
        inside = tried[shapely.contains_xy(uncertainty, tried)][:missing]
        inner.append(inside)
        missing -= len(inside)
    return np.concatenate([corners, rim, *inner])[:number]


def try_plan(
    case: Case, policy: Policy, stretches: tuple[Stretch, ...], starts: Floats, errors: Errors, seed: int = 0
) -> Trial:
    """Follow a policy from object places ``starts`` (N, 2), in the hand frame at the start."""
    run = _Run(case, stretches, errors, np.random.default_rng(seed), _Tally(), [])
    run.follow(policy, starts, np.arange(len(starts)), 0)
    tally = run.tally
    examples = tuple((float(starts[k, 0]), float(starts[k, 1])) for k in run.bad[:5])
    return Trial(tally.caught, tally.lost, tally.surprised, tally.given_up, tally.most, examples, tuple(tally.leaves))


@dataclass(frozen=True)
class _Run:
    case: Case
    stretches: tuple[Stretch, ...]
    errors: Errors
    rng: np.random.Generator
    tally: _Tally
    bad: list[int]

    def follow(self, policy: Policy, places: Floats, who: NDArray[np.int64], approaches: int) -> None:
        """Carry objects at ``places`` (N, 2), seen from the commanded hand, through the rest of a policy."""
        self.tally.most = max(self.tally.most, approaches if len(places) else 0)
        if isinstance(policy, Lost):
            self.tally.given_up += len(places)
            self.bad.extend(who.tolist())
        elif isinstance(policy, Close):
            self._close(policy, places, who)
        else:
            self._approach(policy, places, who, approaches)

    def _close(self, policy: Close, places: Floats, who: NDArray[np.int64]) -> None:
        self.tally.leaves.append(len(places))
        if len(places) == 0:
            return
        hand = self.case.hand.model_copy(update={"open": policy.opening})
        world = stepping_world(self.case.model_copy(update={"hand": hand}))
        seen = places - (policy.place.x, policy.place.y) + self._shifts(self.errors.pose_error, len(places))
        ends = world.ends(np.column_stack([seen, np.zeros(len(seen))]))
        held = np.isin(ends.codes, CAUGHT)
        self.tally.caught += int(held.sum())
        self.tally.lost += int((~held).sum())
        self.bad.extend(who[~held].tolist())

    def _approach(self, policy: Approach, places: Floats, who: NDArray[np.int64], approaches: int) -> None:
        assert isinstance(self.case.object, Disk)
        off = self._shifts(self.errors.pose_error, len(places))
        seen = places - (policy.x, policy.y) + off
        touches = go_until_touched(
            self.case.hand, self.stretches, policy.opening, self.case.object.radius, seen, policy.distance
        )
        sensors, ways = touches.sensors.copy(), touches.ways.copy()
        unseen = (sensors != NOTHING) & (self.rng.uniform(size=len(sensors)) < self.errors.missed)
        sensors[unseen], ways[unseen] = NOTHING, policy.distance
        pushed = np.where((sensors == NOTHING)[:, None], 0.0, self._shifts(self.errors.displacement, len(places)))
        after = places - np.column_stack([np.full(len(ways), policy.x), policy.y + ways]) + pushed
        known = np.zeros(len(places), dtype=np.bool_)
        for branch in policy.branches:
            here = sensors == (NOTHING if branch.sensor is None else branch.sensor)
            known |= here
            self.follow(branch.then, after[here], who[here], approaches + 1)
        self.tally.surprised += int((~known).sum())
        self.bad.extend(who[~known].tolist())

    def _shifts(self, most: float, number: int) -> Floats:
        """Shifts (N, 2) up to ``most`` (m), half of them as long as that."""
        angle = self.rng.uniform(0.0, 2.0 * np.pi, number)
        length = most * np.maximum(np.sqrt(self.rng.uniform(size=number)), self.rng.integers(0, 2, number))
        shifts: Floats = length[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return shifts


def without_assumptions(errors: Errors) -> dict[str, Errors]:
    """The trial as assumed, and with one assumption removed at a time."""
    return {
        "as assumed": errors,
        "object moves 10 mm when touched": replace(errors, displacement=0.01),
        "one bit in ten missed": replace(errors, missed=0.1),
        "pose error 2 mm": replace(errors, pose_error=0.002),
        "pose error 10 mm": replace(errors, pose_error=0.01),
    }
