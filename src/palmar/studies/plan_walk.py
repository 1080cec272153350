"""One object's way through a plan: where the hand stands, what it feels, and what is known of the object meanwhile."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import affinity
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.approach import swept
from palmar.behaviours.policy import Approach, Close, Lost, Policy
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.regions.profile import profile
from palmar.studies.plan import Plan
from palmar.studies.plan_trial import drawn_starts
from palmar.studies.simulate import film
from palmar.worlds.planar.feeling import NOTHING, go_until_touched

Floats = NDArray[np.float64]
Pair = tuple[float, float]
TRIED, GOING, CLOSING = 400, 24, 30
"""Objects tried for a long way; moments shown of an approach, and of closing."""


@dataclass(frozen=True)
class Moment:
    """Hand (m), base angles right and left (rad), object (m), belief (m), all in the frame of the start; what is done."""

    hand: Pair
    fingers: Pair
    thing: Pair
    belief: BaseGeometry
    doing: str


def longest_way(case: Case, plan: Plan, seed: int = 0) -> Pair:
    """Of some objects drawn from what is known at the start, one that takes the most approaches."""
    starts = drawn_starts(plan.found.policy.belief, TRIED, seed)
    lengths = [len(_stops(case, plan, (float(x), float(y)))) for x, y in starts]
    best = int(np.argmax(lengths))
    return float(starts[best, 0]), float(starts[best, 1])


def walk(case: Case, plan: Plan, thing: Pair) -> Iterator[Moment]:
    """The moments of an object's way; nothing goes wrong in it: no displacement, no pose error, no missed bit."""
    policy, hand = plan.found.policy, (0.0, 0.0)
    for approach, way, sensor in _stops(case, plan, thing):
        yield from _going(case, plan, approach, hand, way, thing)
        hand = hand[0] + approach.x, hand[1] + approach.y + way
        policy = next(each.then for each in approach.branches if each.sensor == sensor)
        felt = "nothing felt" if sensor is None else f"felt: {plan.stretches[sensor].name}"
        known = affinity.translate(policy.belief, *hand)
        yield from [Moment(hand, (approach.opening, approach.opening), thing, known, felt)] * (GOING // 4)
    if isinstance(policy, Close):
        yield from _closing(case, policy, hand, thing)
    elif isinstance(policy, Lost):
        yield Moment(hand, (case.hand.open,) * 2, thing, affinity.translate(policy.belief, *hand), "no way on")


def _stops(case: Case, plan: Plan, thing: Pair) -> list[tuple[Approach, float, int | None]]:
    """The approaches that an object takes: way (m) of the hand until it stops, and the sensor, None if nothing fires."""
    assert isinstance(case.object, Disk)
    policy: Policy = plan.found.policy
    seen, found = np.array([thing]), []
    while isinstance(policy, Approach):
        there = seen - (policy.x, policy.y)
        touch = go_until_touched(case.hand, plan.stretches, policy.opening, case.object.radius, there, policy.distance)
        way, sensor = float(touch.ways[0]), int(touch.sensors[0])
        fired = None if sensor == NOTHING else sensor
        found.append((policy, way, fired))
        policy = next(each.then for each in policy.branches if each.sensor == fired)
        seen = there - (0.0, way)
    return found


def _going(case: Case, plan: Plan, approach: Approach, hand: Pair, way: float, thing: Pair) -> Iterator[Moment]:
    assert isinstance(case.object, Disk)
    seen = profile(case.hand, case.object.radius, plan.stretches, approach.opening)
    lined = affinity.translate(approach.belief, -approach.x)
    bottom = lined.bounds[1]
    for gone in np.linspace(0.0, way, GOING):
        left = shapely.difference(lined, swept(seen, bottom, approach.y + float(gone), plan.doubt))
        at = hand[0] + approach.x, hand[1] + approach.y + float(gone)
        known = affinity.translate(left, hand[0] + approach.x, hand[1])
        yield Moment(at, (approach.opening, approach.opening), thing, known, "approach")


def _closing(case: Case, policy: Close, hand: Pair, thing: Pair) -> Iterator[Moment]:
    at = hand[0] + policy.place.x, hand[1] + policy.place.y
    opened = case.model_copy(update={"hand": case.hand.model_copy(update={"open": policy.opening})})
    known = affinity.translate(policy.belief, *hand)
    yield from [Moment(at, (policy.opening, policy.opening), thing, known, "placed: closing catches it")] * (GOING // 4)
    trace = film(opened, (thing[0] - at[0], thing[1] - at[1], 0.0), CLOSING)
    for (x, y, _), (right, left) in zip(trace.poses, trace.fingers, strict=True):
        moved = (float(x) + at[0], float(y) + at[1])
        yield Moment(at, (float(right), float(left)), moved, shapely.Point(moved), "close")
