"""Matching velocities (section 4.3.1): the arm flies along with a tracked disk, brings it to its place, and closes on it.

What the tracker tells is carried forward over its age. With r from the place to the disk, v the disk's velocity and a the
arm's acceleration limit, the arm wants v + w r / |r|, w = min(sqrt(a |r|), |r| / (2 dt)): half of a brakes, the other half
is left for the turns of r, and no step goes past the place. What it may want is cut off at its speed limit, and how far it
changes from one step dt to the next at a dt. With the disk at its place, and its velocity no more than two steps away, it
closes, taking and keeping that velocity until the fingers are shut about the disk: what impacts do to the disk is not
followed. Then it brakes.

Before it moves it runs through this once, as if the tracker were right and nothing were touched, and does not begin what
the limits of its speed, its reach or its patience would not let it end.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from math import hypot, inf, sqrt

from palmar.behaviours.reflex import INSTANT, Drive
from palmar.models.motion import Command, Observation

NEAR = 2e-3
"""Distance (m) from the place that is at it; a tracker that is wrong about the velocity by q keeps it at 2 q dt."""
STEPS = 2.0
"""So many steps' change of velocity may be left when the fingers begin to close."""
Vector = tuple[float, float]


@dataclass(frozen=True)
class ArmLimits:
    """Speed (m/s), acceleration (m/s^2), and how far (m) the hand may be from where it started."""

    speed: float
    acceleration: float
    reach: float

    def brakes_at(self, place: Vector, velocity: Vector) -> float:
        """How far (m) from the start an arm stops that brakes from now on."""
        speed = hypot(*velocity)
        way = 0.5 * speed / self.acceleration
        return hypot(place[0] + velocity[0] * way, place[1] + velocity[1] * way)


class Phase(Enum):
    """What it is about."""

    LOOKS = "looks"
    FOLLOWS = "follows"
    CLOSES = "closes"


@dataclass(frozen=True)
class Matching:
    """When it began and last saw (s), the velocity that the arm then took (m/s), the phase; since when (s) it closes, and
    at which velocity.
    """

    began: float
    last: float
    velocity: Vector = (0.0, 0.0)
    phase: Phase = Phase.LOOKS
    closing_since: float = inf
    kept: Vector = (0.0, 0.0)


@dataclass(frozen=True)
class MatchVelocity:
    """``place`` (m): where in the hand the disk is to be; ``hold`` (s): how long closing takes until the hand is shut.

    ``age`` (s) is that of the tracker's data; ``patience`` (s) the longest time until the disk is at its place.
    """

    drive: Drive
    arm: ArmLimits
    place: Vector
    hold: float
    age: float = 0.0
    patience: float = 10.0

    def begin(self, seen: Observation) -> Matching:
        """Looking, at rest."""
        return Matching(seen.time, seen.time)

    def step(self, state: Matching, seen: Observation) -> tuple[Matching, Command]:
        """Look, follow, close."""
        dt = seen.time - state.last
        state = replace(state, last=seen.time)
        if state.phase is Phase.CLOSES:
            return self._close(state, seen, dt)
        if seen.track is None:
            return state, self.drive.end("no tracker tells where the object is")
        if dt <= 0.0:
            return state, self.drive.rest("look at the object")
        place, velocity = (seen.arm[0], seen.arm[1]), (seen.track[2], seen.track[3])
        off = self._off(seen.track, place)
        if state.phase is Phase.LOOKS:
            refused = self._foreseen(off, velocity, place, dt)
            if refused is not None:
                return state, self.drive.end(refused)
            state = replace(state, phase=Phase.FOLLOWS)
        if seen.time - state.began > self.patience:
            return state, self.drive.end("the object was not brought to its place in time")
        taken, there = self._next(off, velocity, state.velocity, dt)
        if self._leaves(place, taken, velocity, there):
            return state, self.drive.end("the reach is used up")
        if there:
            state = replace(state, phase=Phase.CLOSES, closing_since=seen.time, kept=velocity)
            return self._close(state, seen, dt)
        return replace(state, velocity=taken), self.drive.rest("follow the object", taken)

    def _close(self, state: Matching, seen: Observation, dt: float) -> tuple[Matching, Command]:
        """Keep the velocity until the hand is shut, or held up, then brake; end at rest with both fingers held up."""
        left = state.closing_since + self.hold - seen.time
        most = self.arm.acceleration * dt
        if left > INSTANT and not all(seen.stalled):
            state = replace(state, velocity=towards(state.kept, state.velocity, most))
            return state, self.drive.close("at its place: close on the move", state.velocity, left)
        if state.velocity != (0.0, 0.0):
            state = replace(state, velocity=towards((0.0, 0.0), state.velocity, most))
            return state, self.drive.close("shut: brake", state.velocity)
        return state, self.drive.close_to_the_end(seen, "shut: close on")

    def _off(self, track: tuple[float, float, float, float], arm: Vector) -> Vector:
        """From the place in the hand to where the disk is now (m)."""
        x, y, vx, vy = track
        return x + vx * self.age - arm[0] - self.place[0], y + vy * self.age - arm[1] - self.place[1]

    def _next(self, off: Vector, wanted: Vector, velocity: Vector, dt: float) -> tuple[Vector, bool]:
        """The velocity that the arm takes now, and whether the disk is at its place, nearly at rest in the hand."""
        limits, far = self.arm, hypot(*off)
        quick = min(sqrt(limits.acceleration * far), 0.5 * far / dt)
        aim = _within(wanted, (quick * off[0] / far, quick * off[1] / far), limits.speed) if far > 0.0 else wanted
        most = limits.acceleration * dt
        near = far <= NEAR and hypot(wanted[0] - velocity[0], wanted[1] - velocity[1]) <= STEPS * most
        return towards(aim, velocity, most), near

    def _leaves(self, arm: Vector, taken: Vector, disk: Vector, closes: bool) -> bool:
        """Whether the arm could no longer stop within its reach, after closing if it closes now."""
        wait = self.hold if closes else 0.0
        at = arm[0] + disk[0] * wait, arm[1] + disk[1] * wait
        return max(hypot(*at), self.arm.brakes_at(at, taken)) > self.arm.reach

    def _foreseen(self, off: Vector, disk: Vector, arm: Vector, dt: float) -> str | None:
        """Why the limits do not allow it, if they do not."""
        speed = hypot(*disk)
        if speed > self.arm.speed:
            return f"the object's {1e3 * speed:.4g} mm/s are more than the arm's {1e3 * self.arm.speed:.4g} mm/s"
        velocity, time, there = (0.0, 0.0), 0.0, False
        while not there:
            velocity, there = self._next(off, disk, velocity, dt)
            if self._leaves(arm, velocity, disk, there):
                return f"the arm's reach of {1e3 * self.arm.reach:.4g} mm would be used up"
            if time > self.patience:
                return f"the object would not be at its place within {self.patience:.4g} s"
            arm = arm[0] + velocity[0] * dt, arm[1] + velocity[1] * dt
            off = off[0] + (disk[0] - velocity[0]) * dt, off[1] + (disk[1] - velocity[1]) * dt
            time += dt
        return None


def towards(aim: Vector, velocity: Vector, most: float) -> Vector:
    """``aim``, or the velocity changed by ``most`` (m/s) in its direction."""
    dx, dy = aim[0] - velocity[0], aim[1] - velocity[1]
    change = hypot(dx, dy)
    return aim if change <= most else (velocity[0] + dx * most / change, velocity[1] + dy * most / change)


def _within(disk: Vector, more: Vector, most: float) -> Vector:
    """The disk's velocity and as much of ``more`` as the speed ``most`` allows; a faster disk's direction at that speed."""
    speed = hypot(*disk)
    if speed >= most:
        return disk[0] * most / speed, disk[1] * most / speed
    a, b, c = more[0] ** 2 + more[1] ** 2, disk[0] * more[0] + disk[1] * more[1], speed**2 - most**2
    # |disk + share more| = most
    share = min((sqrt(b * b - a * c) - b) / a, 1.0)
    return disk[0] + share * more[0], disk[1] + share * more[1]
