"""Closing with both joints of each finger on a table: the stepping kernel through one stretch of the motion after another.

A stretch is a motion at constant joint rates (``regions.jointed_closing.stretches_of``). A start at which a finger is held
up before the last stretch is not followed: what the hand then does is for its reflex to say, in a world under feedback.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.pushing.closing import Ends
from palmar.mechanics.pushing.closing_events import ENDS
from palmar.mechanics.pushing.closing_frames import carry_frames
from palmar.mechanics.pushing.closing_steps import BATCH_TOLERANCE, End, carry, carry_all
from palmar.mechanics.pushing.hand_pose import HandMotion
from palmar.mechanics.pushing.polygon_contacts import Body
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import moved_poses, slider_body
from palmar.models.case import Case
from palmar.models.outcome import Outcome
from palmar.regions.jointed_closing import ENDED, stretches_of
from palmar.worlds.planar.events import Event
from palmar.worlds.planar.stepping import MOST_EVENTS, SteppingWorld
from palmar.worlds.planar.table import Trace

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Stretch:
    """A motion that begins at a time (s) and goes through so many of its own units a second."""

    motion: HandMotion
    begins: float
    pace: float

    @property
    def ends(self) -> float:
        """When nothing holds it up (s)."""
        return float(self.begins + (self.motion.last - self.motion.first) / self.pace)

    def time(self, at: float) -> float:
        """Time (s) at which the motion is at one of its own times."""
        return self.begins + (at - self.motion.first) / self.pace

    def own(self, times: Floats) -> Floats:
        """The motion's own times at times (s)."""
        return self.motion.first + self.pace * (times - self.begins)

    def joints(self, right: Floats, left: Floats) -> Floats:
        """Joint angles (K, 2 links), rad, right finger's and left finger's, that are at these own times (K,)."""
        sides = []
        for finger, at in ((0, right), (1, left)):
            angles = self.motion.offsets[finger] + self.motion.ratios[finger] * (at[:, None] - self.motion.first)
            angles[:, 0] += at
            sides.append(angles)
        return np.concatenate(sides, axis=1)


@dataclass(frozen=True)
class Carried:
    """One start: its outcome, None where a finger was held up too soon; final pose, joints (2 links,); events; stretches.

    ``stretches`` pair each stretch that was gone through with the pose it began at.
    """

    outcome: Outcome | None
    pose: tuple[float, float, float]
    joints: tuple[float, ...]
    events: tuple[Event, ...]
    stretches: tuple[tuple[Stretch, Floats], ...]
    time: float


@dataclass(frozen=True)
class JointedWorld:
    """The stretches of a hand's motion, a body with its frame's ``centre`` as in ``stepping``, the clock's zero and rate.

    Events are told as everywhere: by the base angle of a finger that had closed at ``rate`` (rad/s) from ``open`` on.
    """

    stretches: tuple[Stretch, ...]
    body: Body
    centre: tuple[float, float]
    open: float
    rate: float

    def ends(self, starts: ArrayLike) -> tuple[Ends, NDArray[np.bool_]]:
        """How each start (N, 3) of the object's frame ends, and where a finger was held up too soon to say."""
        places = moved_poses(self.centre, np.asarray(starts, dtype=float), 1.0)
        codes = np.full(len(places), Outcome.UNDECIDED.code, np.int8)
        fingers = np.full((len(places), 2), self.open)
        going = np.arange(len(places))
        for stretch in self.stretches:
            found, ends, _ = carry_all(stretch.motion, self.body, places[going], tolerance=BATCH_TOLERANCE)
            codes[going] = found
            valid = found != Outcome.INVALID.code
            places[going[valid]] = ends[valid, :3]
            last = stretch is self.stretches[-1]
            if last:
                fingers[going[valid]] = ends[valid, 3:]
            else:
                through = (ends[:, 3:5] >= stretch.motion.last - ENDED).all(axis=1) & valid
                codes[going[valid & ~through]] = Outcome.UNDECIDED.code
                going = going[through]
        held_up = codes == Outcome.UNDECIDED.code
        return Ends(codes, moved_poses(self.centre, places, -1.0), fingers), held_up

    def carried(self, start: tuple[float, float, float]) -> Carried:
        """One start (m, rad) of the object's frame in detail."""
        place = moved_poses(self.centre, np.array([start]), 1.0)[0]
        known: list[Event] = []
        gone: list[tuple[Stretch, Floats]] = []
        for stretch in self.stretches:
            x, y, theta = place.tolist()
            end, log = carry(stretch.motion, self.body, x, y, theta, events=MOST_EVENTS)
            gone.append((stretch, place))
            known += self._events(stretch, log, known)
            place = np.array([end.x, end.y, end.theta])
            whole = min(end.right, end.left) >= stretch.motion.last - ENDED or stretch is self.stretches[-1]
            if Outcome.from_code(end.code) is Outcome.INVALID:
                return self._told(Outcome.INVALID, stretch, end, [], gone)
            if Outcome.from_code(end.code) is Outcome.UNDECIDED or not whole:
                return self._told(None, stretch, end, known, gone)
        return self._told(Outcome.from_code(end.code), stretch, end, known, gone)

    def trace(self, found: Carried, frames: int) -> Trace:
        """Poses of the object's frame at ``frames`` equal steps of time, of a start that was followed to its end."""
        times = np.linspace(0.0, max(found.time, self.stretches[-1].ends), frames)
        poses, joints = np.empty((frames, 3)), np.empty((frames, 2 * len(self.stretches[0].motion.links)))
        for stretch, place in found.stretches:
            now = times >= stretch.begins
            own = stretch.own(times[now])
            poses[now], at = carry_frames(stretch.motion, self.body, place, own)
            joints[now] = stretch.joints(at[:, 0], at[:, 1])
        return Trace(self.open + self.rate * times, moved_poses(self.centre, poses, -1.0), joints)

    def _told(
        self,
        outcome: Outcome | None,
        stretch: Stretch,
        end: End,
        known: list[Event],
        gone: list[tuple[Stretch, Floats]],
    ) -> Carried:
        x, y, theta = moved_poses(self.centre, np.array([[end.x, end.y, end.theta]]), -1.0)[0]
        joints = stretch.joints(np.array([end.right]), np.array([end.left]))[0]
        time = stretch.time(max(end.right, end.left))
        if outcome is not None and outcome is not Outcome.INVALID:
            known = [*known, Event(self._clock(time), "end", outcome.value)]
        pose = float(x), float(y), float(theta)
        return Carried(outcome, pose, tuple(joints.tolist()), tuple(known), tuple(gone), time)

    def _events(self, stretch: Stretch, log: Floats, before: list[Event]) -> Iterator[Event]:
        """Of one stretch; contacts that go on from the last one are not told again."""
        touching = dict.fromkeys(each.body for each in before if each.kind == "touch")
        held = {body for body in touching if [each.kind for each in before if each.body == body][-1] != "leave"}
        teller = SteppingWorld(stretch.motion, self.body, self.centre)
        found = [
            (self._clock(stretch.time(float(at))), teller.event(float(at), int(kind), int(who)))
            for at, kind, who in log
            if int(kind) != ENDS
        ]
        begin = self._clock(stretch.begins)
        first = {each.body for clock, each in found if each.kind == "touch" and clock <= begin + 1e-9}
        yield from (Event(begin, "leave", body) for body in sorted(held - first))
        for clock, each in found:
            if not (each.kind == "touch" and clock <= begin + 1e-9 and each.body in held):
                yield Event(clock, each.kind, each.body)

    def _clock(self, time: float) -> float:
        return self.open + self.rate * time


def jointed_world(case: Case) -> JointedWorld:
    """The world of a case whose behaviour closes both joints; raises NotCoveredError where its region does, too."""
    slider = slider_of(case.object, case.support)
    rate, begins, found = case.hand.finger_rate, 0.0, list[Stretch]()
    motions = stretches_of(case)
    for motion in motions:
        pace = rate if motion is motions[-1] else rate / case.behaviour.preshape
        found.append(Stretch(motion, begins, pace))
        begins = found[-1].ends
    body = slider_body(slider, case.contact.friction)
    return JointedWorld(tuple(found), body, slider.centre, case.hand.open, rate)
