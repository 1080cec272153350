"""The planar world of a free disk under feedback: the capture kernel advanced tick by tick, as commands say.

Within a tick joints turn at constant rates and the arm goes at a constant velocity, which it takes at once; the tick is cut
where a joint or a link reaches its end or fingers meet. Fingers move as told, whatever strikes them (with a finger mass
they give way and are back at their rate at once), until they press on the disk from all sides: there they are held up,
and the disk goes with the hand. A disk that is shut in and squeezed without loss, so that it strikes the hand thousands of
times between two ticks, counts as pressed.

An impact takes no time; a sensor fires at the tick after one, for one tick, and as long as contact lasts.
"""

from __future__ import annotations

from dataclasses import dataclass

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture_case import impact_law_of
from palmar.mechanics.impact.finger_motion import MOST_LINKS
from palmar.models.case import Case
from palmar.models.motion import Command, Observation
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.models.support import SupportKind
from palmar.worlds.planar.bits import Bits, Sensing, bits_of
from palmar.worlds.planar.carriage import Touch
from palmar.worlds.planar.feedback import LONGEST_TURN, NO_TIME, TICK
from palmar.worlds.planar.finger_pair import SIDES, Both, FingerPair
from palmar.worlds.planar.finger_travel import travel_of
from palmar.worlds.planar.free_carriage import FreeCarriage, free_carriage
from palmar.worlds.planar.tracker import Tracked, Tracker, tracked


@dataclass
class FreeFeedbackWorld:
    """One hand and one free disk; made by ``free_feedback_world``."""

    carriage: FreeCarriage
    fingers: FingerPair
    bits: Bits
    tick: float
    tracked: Tracked | None
    time: float = 0.0
    still: bool = False
    firing: tuple[bool, ...] = ()

    @property
    def angles(self) -> Both:
        """Of all joints (rad), right and left."""
        return self.fingers.angles

    @property
    def settled(self) -> bool:
        """Whether nothing moves under the last command, or the disk cannot be carried any further."""
        return self.still or self.broken

    @property
    def broken(self) -> bool:
        """Whether the start was invalid or a motion could not be found."""
        return self.carriage.invalid or self.carriage.lost

    @property
    def ambiguous(self) -> bool:
        """Impacts and flights have one way to go."""
        return False

    @property
    def pose(self) -> tuple[float, float, float]:
        """Of the disk: x, y (m), theta (rad) in the frame where the hand started."""
        return self.carriage.place

    def observe(self) -> Observation:
        """What the hand feels and knows of itself now, and what the tracker tells."""
        (right, left), held = self.angles, self.fingers.held
        track = None if self.tracked is None else self.tracked.tell(self.time)
        arm = (*self.carriage.arm, 0.0)
        return Observation(self.time, right, left, self.firing, (held[0], held[1]), arm, track)

    def act(self, command: Command, seconds: float) -> float:
        """Let a command hold for so long, or as long as it allows; returns the seconds it held."""
        span = seconds if command.longest is None else min(seconds, command.longest)
        gripped = list(self.fingers.gripped)
        self.fingers.listen(command)
        if gripped != self.fingers.gripped:
            self.carriage.release()
            self.fingers.gripped = [False, False]
        before, left, touches = (self.pose, self.carriage.arm, self.angles), span, list[Touch]()
        fastest = max(abs(each) for each in (*command.right, *command.left))
        most = min(self.tick, LONGEST_TURN / fastest) if fastest > 0.0 else span
        while left > NO_TIME and not self.broken:
            left -= self._go(command, min(left, most))
            touches += self.carriage.touches()
        self.time += span
        self.still = before == (self.pose, self.carriage.arm, self.angles)
        self.feel(touches, span)
        return span

    def outcome(self) -> Outcome:
        """What has become of the disk, were this the end: the fingers stay, the arm stops."""
        if self.broken:
            return Outcome.INVALID if self.carriage.invalid else Outcome.UNDECIDED
        return Outcome.from_code(self.carriage.judged(self.angles))

    def feel(self, touches: list[Touch], seconds: float) -> None:
        """Read the sensors, ``seconds`` after the last reading, and let the tracker look."""
        self.firing = self.bits.read(touches, self.pose[:2], seconds, False)
        if self.tracked is not None:
            self.tracked.see(self.time, self.carriage.track)

    def _go(self, command: Command, left: float) -> float:
        """Go on for at most ``left`` (s), until something reaches its end; returns the time this took."""
        fingers, before = self.fingers, list(self.fingers.held)
        rates = fingers.rates(0), fingers.rates(1)
        if self.carriage.pressed and not any((*rates[0], *rates[1])):
            self.carriage.take_along(command.velocity, left)
            return left
        palm = [fingers.travel.to_palm(self.angles[k], rates[k], left) for k in SIDES]
        span = min([left, *palm, *(fingers.travel.to_joint_end(self.angles[k], rates[k]) for k in SIDES)])
        met = self.carriage.meeting(self.angles, rates, span)
        span = min(span, met)
        begun = self.carriage.time
        if span > NO_TIME:
            self.carriage.carry(self.angles, rates, command.velocity, span, all(fingers.held))
        spent = min(self.carriage.time - begun, span)
        fingers.turn(rates, (spent, spent))
        for side in SIDES:
            if any(rates[side]) and (self.carriage.pressed or met <= span or palm[side] <= spent + NO_TIME):
                fingers.held[side] = True
                fingers.gripped[side] = self.carriage.pressed
        return left if spent <= NO_TIME and fingers.held == before else spent


def free_feedback_world(
    case: Case,
    start: tuple[float, float, float],
    *,
    tick: float = TICK,
    sensing: Sensing | None = None,
    tracker: Tracker | None = None,
) -> FreeFeedbackWorld:
    """The world of a case, its disk at ``start`` (m, rad) in the hand frame at the case's start velocity, fingers open.

    ``sensing`` is as the case says unless given. Raises NotCoveredError for objects that are not free disks, for ranges,
    walls, sensors that need a displacement, and fingers of too many links.
    """
    faults = Sensing(case.sensors.displacement) if sensing is None else sensing
    radius = _covered(case, faults)
    hand = case.hand
    angles = case.open_joints, case.open_joints
    carriage = free_carriage(hand, radius, impact_law_of(case), case.contact.restitution, start[2], angles)
    carriage.begin(start[0], start[1], case.start.velocity)
    bits = bits_of(hand, case.sensors.stretches(hand), faults)
    watched = None if tracker is None else tracked(tracker)
    world = FreeFeedbackWorld(carriage, FingerPair(travel_of(hand), angles), bits, tick, watched)
    world.firing = (False,) * len(bits.rows)
    if watched is not None:
        watched.see(0.0, (*start[:2], *case.start.velocity))  # of an invalid start there is nothing else to tell
    if not world.broken:
        world.feel(carriage.touches(), 0.0)
    return world


def _covered(case: Case, sensing: Sensing) -> float:
    """The disk's radius (m); raises NotCoveredError for what this world does not do."""
    if case.support.kind is not SupportKind.FREE:
        raise NotCoveredError('support.kind = "table": this world is free space')
    if case.ranges:
        raise NotCoveredError("a simulation takes plain numbers, not ranges")
    if not isinstance(case.object, Disk):
        raise NotCoveredError('object.shape = "polygon": in free space only disks are simulated')
    if case.support.wall is not None:
        raise NotCoveredError("support.wall_mm: in free space no wall is simulated")
    if case.hand.finger_torque is not None:
        raise NotCoveredError(
            "hand.finger_torque_N_m: under feedback fingers are back at their rate at once, leave it out"
        )
    if sensing.displacement > 0.0:
        raise NotCoveredError("sensors.displacement_mm: in free space a sensor feels an impact at once, or not at all")
    if len(case.hand.finger_links) > MOST_LINKS:
        raise NotCoveredError(f"a simulated finger has at most {MOST_LINKS} links, not {len(case.hand.finger_links)}")
    return case.object.radius
