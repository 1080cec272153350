"""A plan put to the test: objects drawn from the uncertainty, every branch followed, every close carried to its end.

It shares no geometry with the planner: touches come from sphere tracing (``worlds.planar.feeling``), grasps from the
stepping kernel, in free space from the capture kernel. The object stays while it is touched, but for the displacement. On
the way up to where it closes the hand must touch nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from math import cos, sin

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.policy import Approach, Close, Lost, Policy, leaves
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.models.sensors import Stretch
from palmar.models.support import SupportKind
from palmar.worlds.planar.feeling import NOTHING, go_until_touched
from palmar.worlds.planar.free import FreeWorld, free_world
from palmar.worlds.planar.stepping import SteppingWorld, stepping_world

Floats = NDArray[np.float64]
CAUGHT = tuple(each.code for each in Outcome if each.caught)


@dataclass(frozen=True)
class Errors:
    """What happens, whatever the plan assumes: largest displacement and pose error (m), shares of bits missed and false.

    ``missed``: of touches that no bit tells. ``false``: of approaches in which some bit fires without a touch, anywhere on
    the way.
    """

    displacement: float = 0.0
    pose_error: float = 0.0
    missed: float = 0.0
    false: float = 0.0


@dataclass(frozen=True)
class Trial:
    """How many starts were caught, and lost: in closing, by a touch that the plan does not know, or left by the plan.

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
    run = Run(case, policy, stretches, errors, np.random.default_rng(seed))
    run.close(run.arrivals(starts))
    return run.trial(starts)


@dataclass(frozen=True)
class Arrival:
    """Objects (N, 2) that came to a closing, seen from where the hand should be; which starts they are; at which leaf.

    ``done``: it has been closed on them already, to see what comes after.
    """

    leaf: int
    node: Close
    places: Floats
    who: NDArray[np.int64]
    done: bool = False


@dataclass
class Run:
    """A policy followed: what has become of the starts so far."""

    case: Case
    policy: Policy
    stretches: tuple[Stretch, ...]
    errors: Errors
    rng: np.random.Generator
    caught: int = 0
    lost: int = 0
    surprised: int = 0
    given_up: int = 0
    most: int = 0
    bad: list[int] = field(default_factory=list)
    worlds: dict[float, SteppingWorld | FreeWorld] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.of_leaves = np.zeros(sum(isinstance(each, Close) for each in leaves(self.policy)), np.int64)

    def arrivals(self, starts: Floats) -> list[Arrival]:
        """All touches of these starts, until they are at their last closings."""
        self._leaf = 0
        return list(self._follow(self.policy, starts, np.arange(len(starts)), 0))

    def close(self, arrived: list[Arrival]) -> None:
        """Close on all that arrived, those with one opening at once."""
        waiting = [each for each in arrived if not each.done]
        for opening in sorted({each.node.opening for each in waiting}):
            here = [each for each in waiting if each.node.opening == opening]
            seen, who = (
                np.concatenate([self._at_place(each) for each in here]),
                np.concatenate([each.who for each in here]),
            )
            codes = self._closed(opening, seen)
            self._count(np.isin(codes, CAUGHT), who)
        for each in arrived:
            self.of_leaves[each.leaf] += len(each.places)

    def trial(self, starts: Floats) -> Trial:
        """The sums; ``starts`` for examples of what went wrong."""
        examples = tuple((float(starts[k, 0]), float(starts[k, 1])) for k in self.bad[:5])
        return Trial(
            self.caught, self.lost, self.surprised, self.given_up, self.most, examples, tuple(self.of_leaves.tolist())
        )

    def _follow(self, policy: Policy, places: Floats, who: NDArray[np.int64], approaches: int) -> Iterator[Arrival]:
        """Carry objects at ``places`` (N, 2), seen from the commanded hand, through the rest of a policy."""
        self.most = max(self.most, approaches if len(places) else 0)
        if isinstance(policy, Lost):
            self.given_up += len(places)
            self.bad.extend(who.tolist())
            return
        places = _seen_turned(places, policy.turn)
        if isinstance(policy, Close):
            arrival = Arrival(self._leaf, policy, places, who)
            self._leaf += 1
            if policy.otherwise is None:
                yield arrival
            else:
                yield from self._look_after(arrival, policy.otherwise, approaches)
        else:
            yield from self._approach(policy, places, who, approaches)

    def _look_after(self, arrival: Arrival, otherwise: Policy, approaches: int) -> Iterator[Arrival]:
        """Close, and go on with what was not touched."""
        codes = self._closed(arrival.node.opening, self._at_place(arrival))
        missed = codes == Outcome.MISSED.code
        self._count(np.isin(codes[~missed], CAUGHT), arrival.who[~missed])
        yield replace(arrival, places=arrival.places[~missed], who=arrival.who[~missed], done=True)
        place = arrival.node.place
        yield from self._follow(otherwise, arrival.places[missed] - (place.x, place.y), arrival.who[missed], approaches)

    def _at_place(self, arrival: Arrival) -> Floats:
        place = arrival.node.place
        found: Floats = arrival.places - (place.x, place.y) + self._shifts(self.errors.pose_error, len(arrival.places))
        return found

    def _closed(self, opening: float, seen: Floats) -> NDArray[np.int8]:
        """How closing ends for objects seen so (N, 2), INVALID if the hand touches them as it comes up."""
        assert isinstance(self.case.object, Disk)
        hand = self.case.hand.model_copy(update={"open": opening})
        if opening not in self.worlds:
            free = self.case.support.kind is SupportKind.FREE
            self.worlds[opening] = (free_world if free else stepping_world)(self.case.model_copy(update={"hand": hand}))
        if len(seen) == 0:
            return np.zeros(0, np.int8)
        at_rest = 3 if self.case.support.kind is SupportKind.FREE else 1
        codes = self.worlds[opening].ends(np.column_stack([seen, np.zeros((len(seen), at_rest))])).codes.copy()
        below = float(np.ptp(seen[:, 1])) + 4.0 * self.case.hand.finger_length
        came = go_until_touched(hand, (), opening, self.case.object.radius, seen + np.array([0.0, below]), below)
        codes[came.sensors != NOTHING] = Outcome.INVALID.code
        return codes

    def _count(self, held: NDArray[np.bool_], who: NDArray[np.int64]) -> None:
        self.caught += int(held.sum())
        self.lost += int((~held).sum())
        self.bad.extend(who[~held].tolist())

    def _approach(self, policy: Approach, places: Floats, who: NDArray[np.int64], approaches: int) -> Iterator[Arrival]:
        sensors, ways = self._touches(policy, places)
        pushed = np.where((sensors == NOTHING)[:, None], 0.0, self._shifts(self.errors.displacement, len(places)))
        after = places - np.column_stack([np.full(len(ways), policy.x), policy.y + ways]) + pushed
        known = np.zeros(len(places), dtype=np.bool_)
        for branch in policy.branches:
            here = sensors == (NOTHING if branch.sensor is None else branch.sensor)
            known |= here
            yield from self._follow(branch.then, after[here], who[here], approaches + 1)
        self.surprised += int((~known).sum())
        self.bad.extend(who[~known].tolist())

    def _touches(self, policy: Approach, places: Floats) -> tuple[NDArray[np.int64], Floats]:
        """Which sensor fires for each object, and the way (m) of the hand until then."""
        assert isinstance(self.case.object, Disk)
        seen = places - (policy.x, policy.y) + self._shifts(self.errors.pose_error, len(places))
        touches = go_until_touched(
            self.case.hand, self.stretches, policy.opening, self.case.object.radius, seen, policy.distance
        )
        sensors, ways = touches.sensors.copy(), touches.ways.copy()
        unseen = (sensors != NOTHING) & (self.rng.uniform(size=len(sensors)) < self.errors.missed)
        sensors[unseen], ways[unseen] = NOTHING, policy.distance
        if self.errors.false > 0.0 and self.stretches:
            fires = self.rng.uniform(size=len(sensors)) < self.errors.false
            ways[fires] *= self.rng.uniform(size=int(fires.sum()))
            sensors[fires] = self.rng.integers(0, len(self.stretches), int(fires.sum()))
        return sensors, ways

    def _shifts(self, most: float, number: int) -> Floats:
        """Shifts (N, 2) up to ``most`` (m), half of them as long as that."""
        angle = self.rng.uniform(0.0, 2.0 * np.pi, number)
        length = most * np.maximum(np.sqrt(self.rng.uniform(size=number)), self.rng.integers(0, 2, number))
        shifts: Floats = length[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return shifts


def _seen_turned(places: Floats, turn: float) -> Floats:
    if turn == 0.0:
        return places
    found: Floats = places @ np.array([[cos(turn), -sin(turn)], [sin(turn), cos(turn)]])
    return found


def without_assumptions(errors: Errors) -> dict[str, Errors]:
    """The trial as assumed, and with one assumption removed at a time."""
    return {
        "as assumed": errors,
        "object moves 10 mm when touched": replace(errors, displacement=0.01),
        "one bit in ten missed": replace(errors, missed=0.1),
        "a false bit in one approach of ten": replace(errors, false=0.1),
        "pose error 2 mm": replace(errors, pose_error=0.002),
        "pose error 10 mm": replace(errors, pose_error=0.01),
    }
