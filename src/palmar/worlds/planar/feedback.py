"""The planar world under feedback: the stepping kernel advanced tick by tick, as commands say.

Within a tick joints turn at constant rates and the hand slides at a constant velocity; the tick is cut where a joint or
a link reaches its end, fingers meet, or the object stops a finger. A finger that is held up stays so until it is told
something else. An object that the fingers press on and hold goes with the arm: their motors can squeeze harder than
the table's friction pulls.

Where Coulomb's law admits several motions the one nearest to the last is followed, and the way is marked ambiguous; the
batch kernel follows them all and reports the worst.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.closing_motion import FLAGS, bench
from palmar.mechanics.pushing.closing_steps import AMBIGUOUS, TOLERANCE
from palmar.mechanics.pushing.hand_pose import MOST_LINKS
from palmar.mechanics.pushing.polygon_contacts import scale_of
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import moved_poses, slider_body
from palmar.models.case import Case
from palmar.models.motion import Command, Observation
from palmar.models.outcome import Outcome
from palmar.worlds.planar.bits import Bits, Sensing, bits_of
from palmar.worlds.planar.carriage import Carriage
from palmar.worlds.planar.finger_pair import SIDES, Both, FingerPair
from palmar.worlds.planar.finger_travel import travel_of
from palmar.worlds.planar.table import refuse_uncovered

TICK = 0.005
LONGEST_TURN = 0.1
"""A joint turns by no more (rad) without a look at whether its finger has come to the palm."""
NO_TIME = 1e-12
HOLDS = (Outcome.STRUCTURAL, Outcome.FRICTIONAL)


@dataclass
class FeedbackWorld:
    """One hand and one object; made by ``feedback_world``."""

    carriage: Carriage
    centre: tuple[float, float]
    fingers: FingerPair
    bits: Bits
    massive: bool
    tick: float
    invalid: bool
    time: float = 0.0
    still: bool = False
    firing: tuple[bool, ...] = ()

    @property
    def angles(self) -> Both:
        """Of all joints (rad), right and left."""
        return self.fingers.angles

    @property
    def settled(self) -> bool:
        """Whether nothing moves under the last command, or the object cannot be carried any further."""
        return self.still or self.broken

    @property
    def broken(self) -> bool:
        """Whether the start was invalid or a motion could not be found."""
        return self.invalid or self.carriage.lost

    @property
    def ambiguous(self) -> bool:
        """Whether several motions were admissible somewhere on the way."""
        return bool(int(self.carriage.at.state[FLAGS]) & AMBIGUOUS)

    @property
    def pose(self) -> tuple[float, float, float]:
        """Of the object's frame: x, y (m), theta (rad) in the frame where the hand started."""
        if self.centre == (0.0, 0.0):
            return self.carriage.place
        x, y, theta = moved_poses(self.centre, np.array([self.carriage.place]), -1.0)[0]
        return float(x), float(y), float(theta)

    def observe(self) -> Observation:
        """What the hand feels and knows of itself now."""
        right, left = self.angles
        held = self.fingers.held[0], self.fingers.held[1]
        return Observation(self.time, right, left, self.firing, held, (*self.carriage.arm, 0.0))

    def act(self, command: Command, seconds: float) -> float:
        """Let a command hold for so long, or as long as it allows; returns the seconds it held."""
        span = seconds if command.longest is None else min(seconds, command.longest)
        self.fingers.listen(command)
        before, left = (self.carriage.place, self.carriage.arm, self.angles), span
        fastest = max(abs(each) for each in (*command.right, *command.left))
        most = min(self.tick, LONGEST_TURN / fastest) if fastest > 0.0 else span
        while left > NO_TIME and not self.broken:
            left -= self._go(command, min(left, most))
        self.time += span
        self.still = before == (self.carriage.place, self.carriage.arm, self.angles)
        self.feel(span, not self._slides_by(command) and not any(self.fingers.gripped))
        return span

    def outcome(self) -> Outcome:
        """What has become of the object, were this the end."""
        if self.broken:
            return Outcome.INVALID if self.invalid else Outcome.UNDECIDED
        return Outcome.from_code(self.carriage.judged(self.angles, (self.fingers.gripped[0], self.fingers.gripped[1])))

    def _slides_by(self, command: Command) -> bool:
        """Whether the arm moves by an object that stays."""
        return self.massive and not command.moves_fingers

    def feel(self, seconds: float, displaces: bool) -> None:
        """Read the sensors, ``seconds`` after the last reading; ``displaces``: touch moves the object."""
        self.firing = self.bits.read(self.carriage.touches(self.angles), self.carriage.place[:2], seconds, displaces)

    def _go(self, command: Command, left: float) -> float:
        """Go on for at most ``left`` (s), until something reaches its end; returns the time this took."""
        rates = self.fingers.rates(0), self.fingers.rates(1)
        rests = not any(rates[0]) and not any(rates[1])
        if rests and command.velocity == (0.0, 0.0):
            return left
        if rests and any(self.fingers.gripped) and self.outcome() in HOLDS:
            self.carriage.take_along(self.angles, command.velocity, left)
            return left
        if self._slides_by(command):
            self.carriage.slide(self.angles, command.velocity, left)
            return left
        before = list(self.fingers.held)
        palm = [self.fingers.travel.to_palm(self.angles[k], rates[k], left) for k in SIDES]
        span = min([left, *palm, *(self.fingers.travel.to_joint_end(self.angles[k], rates[k]) for k in SIDES)])
        spent, stops = span, (inf, inf)
        if span > NO_TIME:
            carried = self.carriage.carry(self.angles, rates, command.velocity, span)
            spent, stops = carried.spent, carried.stops
        met = spent < span - NO_TIME and stops == (inf, inf)
        for side in SIDES:
            if any(rates[side]) and (met or stops[side] < inf or palm[side] <= spent + NO_TIME):
                self.fingers.held[side] = True
                self.fingers.gripped[side] = self.fingers.gripped[side] or stops[side] < inf
        self.fingers.turn(rates, (min(spent, stops[0]), min(spent, stops[1])))
        return left if spent <= NO_TIME and self.fingers.held == before else spent


def feedback_world(
    case: Case,
    start: tuple[float, float, float],
    *,
    tick: float = TICK,
    sensing: Sensing | None = None,
    massive: bool = False,
) -> FeedbackWorld:
    """The world of a case, its object's frame at ``start`` (m, rad) in the hand frame, the fingers open.

    ``sensing`` is as the case says unless given. Raises NotCoveredError for objects not on a table and fingers of too many
    links.
    """
    refuse_uncovered(case)
    hand = case.hand
    count = len(hand.finger_links)
    if count > MOST_LINKS:
        raise NotCoveredError(f"a simulated finger has at most {MOST_LINKS} links, not {count}")
    slider = slider_of(case.object, case.support)
    body = slider_body(slider, case.contact.friction)
    x, y, theta = (float(each) for each in moved_poses(slider.centre, np.array([start]), 1.0)[0])
    wall = inf if case.support.wall is None else case.support.wall
    if massive and wall < inf:
        raise NotCoveredError("support.wall_mm: an object that stays where it is touched needs no wall to be held back")
    carriage = Carriage(hand, body, bench(0), scale_of(hand.finger_length, body, TOLERANCE), (x, y, theta), wall)
    angles = case.open_joints, case.open_joints
    faults = Sensing(case.sensors.displacement) if sensing is None else sensing
    bits = bits_of(hand, case.sensors.stretches(hand), faults)
    fingers = FingerPair(travel_of(hand), angles)
    world = FeedbackWorld(carriage, slider.centre, fingers, bits, massive, tick, carriage.overlaps(angles))
    world.firing = (False,) * len(bits.rows)
    if not world.invalid:
        world.feel(0.0, not massive)
    return world
