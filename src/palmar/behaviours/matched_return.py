"""Matched return (section 4.3.2): the palm yields to a coming disk as its mirror, so that the impact leaves it at rest.

A paddle that goes at g v against a disk that comes at v returns it at (e + g (1 + e)) v (``matched_return_4_3_2``); with
g = -e / (1 + e) the disk stops dead, wherever they meet, so no time need be predicted. The arm takes that share of the
velocity that the tracker tells, along the normal of the palm, and all of it along the palm. When the tracker tells that
the disk has been struck, or a sensor on the palm does, the arm stops going back and the hand closes on a disk at rest; it
keeps going along the palm as the disk last came, for what the fingers do to the disk then is not followed.

A tracker that is wrong about the velocity by (p, q) leaves the disk with (-p, e q) as the hand sees it, and one that tells
of the impact after a time d leaves e / (1 + e) v d between them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from math import hypot, inf

from palmar.behaviours.match_velocity import ArmLimits, Vector, towards
from palmar.behaviours.reflex import Drive
from palmar.behaviours.sensor_places import SensorPlaces
from palmar.models.motion import Command, Observation

CHANGED = 0.25
"""Part of its first velocity towards the palm by which a disk's has to change to count as struck."""


class Phase(Enum):
    """What it is about."""

    LOOKS = "looks"
    YIELDS = "yields"
    CLOSES = "closes"


@dataclass(frozen=True)
class Returning:
    """When it began and last saw (s), the arm's velocity, how fast the disk first came and last went along the palm (m/s),
    the phase, and since when (s) it closes.
    """

    began: float
    last: float
    velocity: Vector = (0.0, 0.0)
    coming: float = 0.0
    along: float = 0.0
    phase: Phase = Phase.LOOKS
    closing_since: float = inf


@dataclass(frozen=True)
class MatchedReturn:
    """``share`` = e / (1 + e) of the disk's velocity is taken; ``near`` (m): its height over the palm at the impact;
    ``hold`` (s): how long closing takes until the hand is shut; ``patience`` (s): the longest time until the impact.
    """

    drive: Drive
    places: SensorPlaces
    arm: ArmLimits
    share: float
    near: float
    hold: float
    age: float = 0.0
    patience: float = 10.0

    def begin(self, seen: Observation) -> Returning:
        """Looking, at rest."""
        return Returning(seen.time, seen.time)

    def step(self, state: Returning, seen: Observation) -> tuple[Returning, Command]:
        """Look, yield, close."""
        dt = seen.time - state.last
        state = replace(state, last=seen.time)
        if seen.track is None:
            return state, self.drive.end("no tracker tells where the object is")
        _, _, vx, vy = seen.track
        most = self.arm.acceleration * dt
        if state.phase is Phase.LOOKS:
            if dt <= 0.0:
                return state, self.drive.rest("look at the object")
            refused = self._refused(seen)
            if refused is not None:
                return state, self.drive.end(refused)
            state = replace(state, phase=Phase.YIELDS, coming=-vy)
        if state.phase is Phase.YIELDS:
            if not self.places.palm_feels(seen) and abs(vy + state.coming) <= CHANGED * state.coming:
                if seen.time - state.began > self.patience:
                    return state, self.drive.end("the object has not come to the palm in time")
                state = replace(state, velocity=towards((vx, self.share * vy), state.velocity, most), along=vx)
                return state, self.drive.rest("yield to the object", state.velocity)
            state = replace(state, phase=Phase.CLOSES, closing_since=seen.time)
        shut = seen.time > state.closing_since + self.hold or all(seen.stalled)
        state = replace(state, velocity=towards((0.0 if shut else state.along, 0.0), state.velocity, most))
        if shut and state.velocity == (0.0, 0.0):
            return state, self.drive.close_to_the_end(seen, "shut: close on")
        return state, self.drive.close("struck: close on it", state.velocity)

    def _refused(self, seen: Observation) -> str | None:
        """Why the disk's motion or the arm's limits do not allow it, if they do not."""
        _, y, vx, vy = seen.track or (0.0, 0.0, 0.0, 0.0)
        if vy >= 0.0:
            return "the object does not come towards the palm"
        wanted = hypot(vx, self.share * vy)
        if wanted > self.arm.speed:
            return f"{1e3 * wanted:.4g} mm/s would be needed, more than the arm's {1e3 * self.arm.speed:.4g} mm/s"
        wait = max(y + vy * self.age - seen.arm[1] - self.near, 0.0) / ((1.0 - self.share) * -vy)
        if wait > self.patience:
            return f"the object would not come to the palm within {self.patience:.4g} s"
        at = seen.arm[0] + vx * (wait + self.hold), seen.arm[1] + self.share * vy * wait
        if max(hypot(*at), self.arm.brakes_at(at, (vx, self.share * vy))) > self.arm.reach:
            return f"the arm's reach of {1e3 * self.arm.reach:.4g} mm would be used up"
        return None
