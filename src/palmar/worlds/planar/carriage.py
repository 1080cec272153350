"""An object and a hand that slides: the stepping kernel taken from one moment to the next, between changes of the motion.

Time enters the kernel in units of the fastest joint's radian, or of the time in which the arm goes a finger's length, so
that its tolerances mean what they mean to a closing motion.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, inf, isfinite

import numpy as np

from palmar.mechanics.pushing.closing_contacts import look
from palmar.mechanics.pushing.closing_motion import ARM, LEFT, OMEGA, RIGHT, THETA, TIME, VX, VY, Bench, X, Y
from palmar.mechanics.pushing.closing_steps import MOST_STEPS, follow, judge
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion, free_motion, place_links
from palmar.mechanics.pushing.meeting import travel_end
from palmar.mechanics.pushing.polygon_contacts import BEGIN, VERTEX, Body, Scale, kind_of, link_of
from palmar.models.hand import Fingers, Hand
from palmar.models.motion import Joints
from palmar.worlds.planar.arm_way import free_way

NEAR = 50.0
"""A gap of so many touching ones counts as a touch that is felt, as it does for the outcome."""
PARTING = 1e-6
Both = tuple[Joints, Joints]
Vector = tuple[float, float]


@dataclass(frozen=True)
class Touch:
    """A contact on a row of the hand's links (0 palm, right links, left links), ``along`` (m) from the row's begin."""

    link: int
    along: float


@dataclass(frozen=True)
class Carried:
    """How long (s) a motion went on, and when the object stopped the right and the left finger: inf if it did not."""

    spent: float
    stops: tuple[float, float]


@dataclass
class Carriage:
    """``place`` of the body (x, y, theta) and ``arm`` (x, y), in the frame where the hand started; m, rad.

    ``arm`` is where the arm is told to be; before a wall, at the height ``wall`` in that frame, the wrist may give way.
    """

    hand: Hand
    body: Body
    at: Bench
    scale: Scale
    place: tuple[float, float, float]
    wall: float = inf
    arm: Vector = (0.0, 0.0)
    pace: float = 1.0
    lost: bool = False

    def carry(self, angles: Both, rates: Both, velocity: Vector, span: float) -> Carried:
        """Go on for ``span`` (s) at joint ``rates`` (rad/s) and ``velocity`` (m/s), or until fingers meet or both stop."""
        s = self.at.state
        pace = max(*(abs(each) for each in (*rates[0], *rates[1])), hypot(*velocity) / self.hand.finger_length)
        s[VX], s[VY], s[OMEGA] = (each * self.pace / pace for each in (s[VX], s[VY], s[OMEGA]))
        self.pace = pace
        motion = self._motion(angles, rates, velocity, pace, span * pace)
        self._set_state()
        ended, _ = follow(motion, self.body, self.at, self.scale, MOST_STEPS, 0)
        self.lost = self.lost or not ended
        spent = span if s[TIME] >= span * pace else float(s[TIME]) / pace
        stops = tuple(inf if s[each] == MOVING else float(s[each]) / pace for each in (RIGHT, LEFT))
        self.place = self.arm[0] + float(s[X]), self.arm[1] + float(s[Y]), float(s[THETA])
        self._slide(velocity, spent if s[ARM] == MOVING else float(s[ARM]) / pace)
        return Carried(spent, (stops[0], stops[1]))

    def slide(self, angles: Both, velocity: Vector, span: float) -> None:
        """Only the arm moves, by an object that stays: for ``span`` (s), or until it is stopped by that."""
        speed = hypot(*velocity)
        still = tuple(0.0 for _ in angles[0])
        motion = self._motion(angles, (still, still), velocity, speed, speed * span)
        self._set_state()
        self._slide(velocity, free_way(motion, self.body, self.at, self.scale, speed * span) / speed)
        self.at.state[VX : OMEGA + 1] = 0.0

    def take_along(self, angles: Both, velocity: Vector, span: float) -> None:
        """The arm moves for ``span`` (s), and the object, which the fingers hold, with it; not into a wall."""
        (x, y, theta), room = self.place, self.wall - self._top()
        before = self.palm_ahead(angles)
        self._slide(velocity, span)
        self.place = x + velocity[0] * span, y + min(self.palm_ahead(angles) - before, room), theta
        self.at.state[VX : OMEGA + 1] = 0.0

    def palm_ahead(self, angles: Both) -> float:
        """Where along y (m) the palm is."""
        if self.wall == inf:
            return self.arm[1]
        place_links(self._at_rest(angles), 0.0, MOVING, MOVING, self.at.links)
        return self.arm[1] + float(self.at.links[0, 1])

    def touches(self, angles: Both) -> list[Touch]:
        """Where the object touches the hand now."""
        _, count = self._look(angles, NEAR)
        return [self._touch(k) for k in range(count)]

    def overlaps(self, angles: Both) -> bool:
        """Whether the object overlaps the hand by more than a start may."""
        gap, _ = self._look(angles, 1.0)
        return not all(map(isfinite, self.place)) or gap < -2.0 * self.scale.skin - 1e-9 * self.body.reach

    def judged(self, angles: Both, gripped: tuple[bool, bool]) -> int:
        """Outcome code, were this the end; ``gripped``: fingers that the object stops."""
        motion = self._at_rest(angles)
        s = self.at.state
        s[RIGHT], s[LEFT] = (0.0 if each else MOVING for each in gripped)
        return int(judge(motion, self.body, self.at, self.scale))

    def _look(self, angles: Both, near: float) -> tuple[float, int]:
        return look(self._at_rest(angles), self.body, self.at, self.scale, near * self.scale.touch)

    def _at_rest(self, angles: Both) -> HandMotion:
        still = tuple(0.0 for _ in angles[0])
        self._set_state()
        return self._motion(angles, (still, still), (0.0, 0.0), 1.0, 0.0)

    def _motion(self, angles: Both, rates: Both, velocity: Vector, pace: float, span: float) -> HandMotion:
        """The kernel's motion over ``span`` units of time, ``pace`` of them a second."""
        hand = self.hand
        motion = free_motion(
            hand.half_palm, np.array(hand.finger_links), hand.half_thickness, np.array(angles), np.array(rates) / pace,
            (velocity[0] / pace, velocity[1] / pace), span, hand.fingers is Fingers.COLLIDING,
        )._replace(wall=self.wall - self.arm[1])  # fmt: skip
        if motion.alone > PARTING:
            # Fingers that touch where they are would never part again: the kernel ends a motion at a touch.
            starts, later = (travel_end(motion, each, MOVING, MOVING, self.at.links) for each in (0.0, PARTING))
            if starts == 0.0 and later > PARTING:
                return motion._replace(alone=0.0)
        return motion

    def _set_state(self) -> None:
        s, (x, y, theta) = self.at.state, self.place
        s[X], s[Y], s[THETA] = x - self.arm[0], y - self.arm[1], theta
        s[TIME], s[RIGHT], s[LEFT], s[ARM] = 0.0, MOVING, MOVING, MOVING

    def _top(self) -> float:
        """Largest y (m) of the object."""
        c, s = float(np.cos(self.place[2])), float(np.sin(self.place[2]))
        corners = self.body.vertices
        return self.place[1] + self.body.radius + float((s * corners[:, 0] + c * corners[:, 1]).max())

    def _slide(self, velocity: Vector, seconds: float) -> None:
        self.arm = self.arm[0] + velocity[0] * seconds, self.arm[1] + velocity[1] * seconds

    def _touch(self, k: int) -> Touch:
        """The active contact k, its foot on the link."""
        code = int(self.at.active[k])
        link, kind, index = int(link_of(code)), int(kind_of(code)), code % 16384
        ax, ay, bx, by = (float(each) for each in self.at.links[link, :4])
        length = hypot(bx - ax, by - ay)
        if kind != VERTEX:
            return Touch(link, 0.0 if kind == BEGIN else length)
        s = self.at.state
        c, sine = float(np.cos(s[THETA])), float(np.sin(s[THETA]))
        vx, vy = (float(each) for each in self.body.vertices[index])
        px, py = float(s[X]) + c * vx - sine * vy, float(s[Y]) + sine * vx + c * vy
        along = ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length
        return Touch(link, min(max(along, 0.0), length))
