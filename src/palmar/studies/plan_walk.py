"""One object's way through a plan: where the hand stands, what it feels, and what is known of the object meanwhile."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, sin

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import Point, affinity
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.approach import swept
from palmar.behaviours.policy import Approach, Close, Lost, Policy, seen_turned
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.models.behaviour import Behaviour
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.regions.profile import profile
from palmar.studies.plan import Plan
from palmar.studies.plan_trial import drawn_starts
from palmar.studies.simulate import film
from palmar.worlds.planar.feeling import NOTHING, go_until_touched

Floats = NDArray[np.float64]
Pair = tuple[float, float]
Pose = tuple[float, float, float]
NEAR = 1e-9
TRIED, GOING, CLOSING = 400, 24, 30
"""Objects tried for a long way; moments shown of an approach, and of closing."""


@dataclass(frozen=True)
class Moment:
    """Hand (x, y, theta; m, rad), base angles right and left (rad), object and belief (m), in the frame of the start."""

    hand: Pose
    fingers: Pair
    thing: Pair
    belief: BaseGeometry
    doing: str


def longest_way(case: Case, plan: Plan, seed: int = 0) -> Pair:
    """Of some objects drawn from what is known at the start, one that takes the most approaches."""
    starts = drawn_starts(plan.found.policy.belief, TRIED, seed)
    lengths = [_approaches(case, plan, (float(x), float(y))) for x, y in starts]
    best = int(np.argmax(lengths))
    return float(starts[best, 0]), float(starts[best, 1])


def walk(case: Case, plan: Plan, thing: Pair) -> Iterator[Moment]:
    """The moments of an object's way; nothing goes wrong in it: no displacement, no pose error, no missed bit."""
    policy: Policy = plan.found.policy
    hand: Pose = (0.0, 0.0, 0.0)
    while not isinstance(policy, Lost):
        facing = hand[0], hand[1], hand[2] + policy.turn
        if isinstance(policy, Close):
            hand = _moved(facing, policy.place.x, policy.place.y)
            missed = policy.otherwise is not None and not _holds(policy, facing, thing)
            yield from _closing(case, policy, facing, hand, thing, missed)
            if policy.otherwise is None or not missed:
                return
            policy = policy.otherwise
            continue
        way, sensor = _touch(case, plan, policy, facing, thing)
        yield from _going(case, plan, policy, facing, way, thing)
        hand = _moved(facing, policy.x, policy.y + way)
        fingers = policy.opening, policy.opening
        policy = next(each.then for each in policy.branches if each.sensor == sensor)
        felt = "nothing felt" if sensor is None else f"felt: {plan.stretches[sensor].name}"
        yield from [Moment(hand, fingers, thing, _placed(policy.belief, hand), felt)] * (GOING // 4)
    yield Moment(hand, (case.hand.open,) * 2, thing, _placed(policy.belief, hand), "no way on")


def _moved(hand: Pose, x: float, y: float) -> Pose:
    """A hand moved by (x, y) (m) in its own frame."""
    c, s = cos(hand[2]), sin(hand[2])
    return hand[0] + c * x - s * y, hand[1] + s * x + c * y, hand[2]


def _placed(known: BaseGeometry, hand: Pose) -> BaseGeometry:
    """A set in a hand's frame, in that of the start."""
    turned = affinity.rotate(known, hand[2], origin=(0.0, 0.0), use_radians=True) if hand[2] else known
    return affinity.translate(turned, hand[0], hand[1])


def _seen(thing: Pair, hand: Pose) -> Pair:
    """A place in the frame of the start, in a hand's frame."""
    c, s, x, y = cos(hand[2]), sin(hand[2]), thing[0] - hand[0], thing[1] - hand[1]
    return c * x + s * y, c * y - s * x


def _holds(policy: Close, facing: Pose, thing: Pair) -> bool:
    """Whether an object is among those that a closing with something after it is for."""
    return bool(seen_turned(policy.belief, policy.turn).distance(Point(_seen(thing, facing))) < NEAR)


def _touch(case: Case, plan: Plan, approach: Approach, facing: Pose, thing: Pair) -> tuple[float, int | None]:
    """Way (m) of the hand in an approach until it stops, and the sensor, None if nothing fires."""
    assert isinstance(case.object, Disk)
    x, y = _seen(thing, facing)
    there = np.array([(x - approach.x, y - approach.y)])
    touch = go_until_touched(case.hand, plan.stretches, approach.opening, case.object.radius, there, approach.distance)
    fired = int(touch.sensors[0])
    return float(touch.ways[0]), None if fired == NOTHING else fired


def _approaches(case: Case, plan: Plan, thing: Pair) -> int:
    """How many approaches an object takes."""
    policy: Policy = plan.found.policy
    hand: Pose = (0.0, 0.0, 0.0)
    count = 0
    while isinstance(policy, Approach):
        facing = hand[0], hand[1], hand[2] + policy.turn
        way, sensor = _touch(case, plan, policy, facing, thing)
        hand, count = _moved(facing, policy.x, policy.y + way), count + 1
        policy = next(each.then for each in policy.branches if each.sensor == sensor)
    return count


def _going(case: Case, plan: Plan, approach: Approach, facing: Pose, way: float, thing: Pair) -> Iterator[Moment]:
    assert isinstance(case.object, Disk)
    seen = profile(case.hand, case.object.radius, plan.stretches, approach.opening)
    lined = affinity.translate(seen_turned(approach.belief, approach.turn), -approach.x)
    bottom = lined.bounds[1]
    for gone in np.linspace(0.0, way, GOING):
        left = shapely.difference(lined, swept(seen, bottom, approach.y + float(gone), plan.doubt))
        at = _moved(facing, approach.x, approach.y + float(gone))
        known = _placed(affinity.translate(left, approach.x), facing)
        yield Moment(at, (approach.opening, approach.opening), thing, known, "approach")


def _closing(case: Case, policy: Close, facing: Pose, at: Pose, thing: Pair, missed: bool) -> Iterator[Moment]:
    fingers = policy.opening, policy.opening
    # A plan closes with the fingers straight, whatever the case's behaviour does.
    hand = case.hand.model_copy(update={"open": policy.opening})
    opened = case.model_copy(update={"hand": hand, "behaviour": Behaviour()})
    known = _placed(seen_turned(policy.belief, policy.turn), facing)
    yield from [Moment(at, fingers, thing, known, "placed: closing catches it")] * (GOING // 4)
    if missed:
        last = straight_motion(opened.hand).last
        for psi in np.linspace(policy.opening, last, CLOSING):
            yield Moment(at, (float(psi), float(psi)), thing, known, "closes on nothing")
        return
    trace = film(opened, (*_seen(thing, at), 0.0), CLOSING)
    for (x, y, _), (right, left) in zip(trace.poses, trace.fingers, strict=True):
        moved = _moved(at, float(x), float(y))[:2]
        yield Moment(at, (float(right), float(left)), moved, Point(moved), "close")
