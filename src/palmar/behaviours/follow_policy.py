"""Follow a plan: the tree of approaches and closings that the set-based planner found, carried out leg by leg.

Each node of the tree becomes legs: straight back until nothing can be touched, sideways, fingers to the opening, forward,
then feel or close. Where the hand is after an approach is read from the arm, so the next node counts from there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import hypot

from palmar.behaviours.policy import Approach, Close, Lost, Policy, is_straight
from palmar.behaviours.reflex import INSTANT, Drive
from palmar.behaviours.verdict import AT_END
from palmar.errors import NotCoveredError
from palmar.models.motion import Command, Observation

Place = tuple[float, float]
ARRIVED, HELD_UP = 1e-9, 1e-7
"""The arm is where it should be (m); of a move over ``HELD_UP`` (m) nothing was made: something is in the way."""


@dataclass(frozen=True)
class Move:
    """The arm goes straight to a place (m, frame of the start), until a sensor fires if it ``feels``."""

    to: Place
    why: str
    feels: bool = False


@dataclass(frozen=True)
class Shape:
    """Base joints go to an angle (rad)."""

    opening: float


@dataclass(frozen=True)
class Grab:
    """Close and end."""


Leg = Move | Shape | Grab


@dataclass(frozen=True)
class Following:
    """The node of the tree, the legs still to go, and the arm's place before a move that should have changed it."""

    node: Policy
    legs: tuple[Leg, ...]
    before: Place | None = None


@dataclass(frozen=True)
class FollowPolicy:
    """``speed`` (m/s) of the arm; ``clearance`` (m): below an object by that much, no part of the hand can touch it.

    ``last`` (rad) is the base angle at which an empty hand ends. Raises NotCoveredError where the hand should turn.
    """

    drive: Drive
    policy: Policy
    speed: float
    clearance: float
    last: float

    def __post_init__(self) -> None:
        if not is_straight(self.policy):
            raise NotCoveredError('behaviour "follow_policy" is for plans in which the hand does not turn')

    def begin(self, seen: Observation) -> Following:
        """At the root."""
        return self._enter(self.policy, seen)

    def step(self, state: Following, seen: Observation) -> tuple[Following, Command]:
        """Take the first leg that is not done; at the end of an approach, the branch of what was felt."""
        while state.legs:
            leg, *rest = state.legs
            if isinstance(leg, Grab):
                return self._grab(state, seen)
            if isinstance(leg, Move) and leg.feels and isinstance(state.node, Approach):
                number, branch = _branch(state.node, seen)
                if branch is not None:
                    state = self._enter(branch, seen)
                    continue
                if any(seen.bits):
                    return state, self.drive.end(f"sensor {number} fires, which the plan does not know of")
            if _done(leg, seen):
                if isinstance(leg, Move) and leg.feels:
                    return self._unfelt(state, seen)
                state = replace(state, legs=tuple(rest), before=None)
                continue
            return self._go(state, leg, seen)
        return state, self.drive.end("the plan ends here without a grasp")

    def _grab(self, state: Following, seen: Observation) -> tuple[Following, Command]:
        """Close to the end; go on if something is to be done after fingers that have closed on nothing."""
        assert isinstance(state.node, Close)
        if state.node.otherwise is None or not all(seen.stalled):
            return state, self.drive.close_to_the_end(seen, "close: certain from here")
        if any(joints[0] < self.last - AT_END for joints in (seen.right, seen.left)):
            return state, self.drive.end("a finger is held up before its end: caught")
        return self.step(self._enter(state.node.otherwise, seen), seen)

    def _unfelt(self, state: Following, seen: Observation) -> tuple[Following, Command]:
        """The approach is over and nothing was felt."""
        assert isinstance(state.node, Approach)
        for each in state.node.branches:
            if each.sensor is None:
                return self.step(self._enter(each.then, seen), seen)
        return state, self.drive.end("nothing was felt, which the plan does not know of")

    def _go(self, state: Following, leg: Move | Shape, seen: Observation) -> tuple[Following, Command]:
        """The motion of a leg that is not done, unless the hand is held up in it."""
        if isinstance(leg, Shape):
            if any(seen.stalled):
                return state, self.drive.end("a finger is held up on the way to its opening")
            return state, self._shape(leg.opening, seen)
        here = seen.arm[0], seen.arm[1]
        if state.before is not None and hypot(here[0] - state.before[0], here[1] - state.before[1]) < HELD_UP:
            return state, self.drive.end("the arm is held up, and no sensor says why")
        dx, dy = leg.to[0] - here[0], leg.to[1] - here[1]
        way = hypot(dx, dy)
        velocity = self.speed * dx / way, self.speed * dy / way
        return replace(state, before=here), self.drive.rest(leg.why, velocity, way / self.speed)

    def _shape(self, opening: float, seen: Observation) -> Command:
        """Both base joints to an angle; the one that is nearer rests once it is there."""
        left = [opening - joints[0] for joints in (seen.right, seen.left)]
        times = [abs(each) / self.drive.rate for each in left]
        longest = min(each for each in times if each > INSTANT)
        right, other = (
            ((self.drive.rate if angle > 0.0 else -self.drive.rate) if time > INSTANT else 0.0, *joints[1:])
            for angle, time, joints in zip(left, times, (self.drive.still, self.drive.still), strict=True)
        )
        return Command(right, other, longest=longest, why="fingers to the opening")

    def _enter(self, node: Policy, seen: Observation) -> Following:
        """A node's legs from where the arm is."""
        if isinstance(node, Lost):
            return Following(node, ())
        here = seen.arm[0], seen.arm[1]
        dx, dy = (node.x, node.y) if isinstance(node, Approach) else (node.place.x, node.place.y)
        below = here[1] + min(0.0, dy, _bottom(node) - self.clearance)
        x, y = here[0] + dx, here[1] + dy
        around: tuple[Leg, ...] = (
            Move((here[0], below), "straight back"),
            Move((x, below), "sideways"),
            Shape(node.opening),
        )
        if isinstance(node, Close):
            return Following(node, (*around, Move((x, y), "to where closing is certain"), Grab()))
        there = x, y + node.distance
        approach = Move((x, y), "forward to the approach"), Move(there, "approach until a sensor fires", True)
        return Following(node, (*around, *approach))


def _bottom(node: Approach | Close) -> float:
    """The least y (m) at which an object may be that this move, or one after it without a touch, is for."""
    bottom = float(node.belief.bounds[1])
    if isinstance(node, Close) and isinstance(node.otherwise, Close):
        bottom = min(bottom, node.place.y + _bottom(node.otherwise))
    return bottom


def _branch(node: Approach, seen: Observation) -> tuple[int | None, Policy | None]:
    """The first sensor that fires, and what the plan says to it: any sensor that fires and that it knows of will do."""
    firing = [number for number, bit in enumerate(seen.bits) if bit]
    for each in node.branches:
        if each.sensor in firing:
            return each.sensor, each.then
    return (firing[0] if firing else None), None


def _done(leg: Move | Shape, seen: Observation) -> bool:
    if isinstance(leg, Shape):
        return all(abs(leg.opening - joints[0]) <= ARRIVED for joints in (seen.right, seen.left))
    return hypot(leg.to[0] - seen.arm[0], leg.to[1] - seen.arm[1]) <= ARRIVED
