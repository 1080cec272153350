"""A free disk and a hand that moves: the capture kernel taken from one moment to the next, between changes of the motion.

The kernel sees everything from the hand. An arm that changes its velocity by dv at once shifts the disk's by -dv there.
A finger whose distal joints are straight and rest counts as one link, as it does where closing is simulated at one go.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.impact.capture_hand import CLOSE, programmed_hand
from palmar.mechanics.impact.capture_run import NEAR
from palmar.mechanics.impact.capture_state import (
    FLIGHT,
    IMPACT,
    LANDS,
    LOGGED,
    MODE,
    SPIN,
    VX,
    VY,
    Bench,
    T,
    X,
    Y,
    bench,
)
from palmar.mechanics.impact.capture_ticks import PRESSED, TOO_MANY, carry_until, ends_at_rest, is_enclosed, put
from palmar.mechanics.impact.collision import ImpactLaw
from palmar.mechanics.impact.contact_view import BASE, END, PALM, gap_at
from palmar.mechanics.impact.enclosed import meets_at
from palmar.mechanics.impact.finger_motion import FINGER_WIDTH, CaptureHand, begin_phase
from palmar.mechanics.impact.settling import look
from palmar.models.hand import Fingers, Hand
from palmar.models.motion import Track
from palmar.worlds.planar.carriage import Touch, Vector
from palmar.worlds.planar.finger_pair import SIDES, Both

Floats = NDArray[np.float64]
MOST_EVENTS = 2_000
"""Between two changes of the motion; a disk that the fingers shut in and squeeze without loss comes to more."""
EVENTS_TO_THE_END = 20_000
PARTING = 1e-6
"""Time (s) after which fingers that touch are seen to part."""


@dataclass
class FreeCarriage:
    """A disk of the ``radius`` and ``theta`` that it has turned by; ``arm`` (m) in the frame where the hand started.

    ``velocity`` (m/s) is the arm's; ``pressed``: the fingers press on the disk from all sides and it goes with the hand.
    """

    hand: Hand
    radius: float
    law: ImpactLaw
    restitution: float
    theta: float
    at: Bench
    motion: CaptureHand
    arm: Vector = (0.0, 0.0)
    velocity: Vector = (0.0, 0.0)
    pressed: bool = False
    lost: bool = False
    anew: bool = True
    invalid: bool = False

    @property
    def place(self) -> tuple[float, float, float]:
        """Of the disk: x, y (m), theta (rad) in the frame where the hand started."""
        s = self.at.state
        return self.arm[0] + float(s[X]), self.arm[1] + float(s[Y]), self.theta

    @property
    def time(self) -> float:
        """(s) to which the disk has been carried."""
        return float(self.at.state[T])

    @property
    def track(self) -> Track:
        """Place (m) and velocity (m/s) of the disk in the frame where the hand started."""
        (x, y, _), s = self.place, self.at.state
        return x, y, self.velocity[0] + float(s[VX]), self.velocity[1] + float(s[VY])

    def begin(self, x: float, y: float, velocity: Vector) -> None:
        """Put the disk there (m, m/s), the arm at rest."""
        self.invalid = not put(self.motion, self.at, x, y, *velocity)

    def release(self) -> None:
        """A finger that pressed is told something else: the disk is free again, at rest in the hand."""
        self.pressed, self.anew = False, True

    def meeting(self, angles: Both, rates: Both, span: float) -> float:
        """Time (s) within ``span`` after which fingers of one plane meet; inf if they do not."""
        if self.hand.fingers is not Fingers.COLLIDING or not any((*rates[0], *rates[1])):
            return inf

        def met(some: Both, left: float) -> float:
            motion = self._moving(some, rates, 0.0, left, rests=False)
            chain = np.zeros((2 * len(motion.lengths) + 2, 2))
            return meets_at(motion, 0, left, CLOSE * motion.reach, np.zeros((2, FINGER_WIDTH)), chain)

        first = met(angles, span)
        if first == 0.0 and met(_after(angles, rates, PARTING), PARTING) > 0.0:
            return inf
        return first if first < span else inf

    def carry(self, angles: Both, rates: Both, velocity: Vector, span: float, ended: bool) -> bool:
        """Go on for ``span`` (s) at joint ``rates`` (rad/s) and ``velocity`` (m/s); whether the fingers come to press.

        ``ended``: both fingers are at the end of their travel, and walls. Where the fingers come to press the state is
        that of the moment, ``time``.
        """
        s = self.at.state
        self.anew = self.anew or velocity != self.velocity
        s[VX], s[VY] = s[VX] + self.velocity[0] - velocity[0], s[VY] + self.velocity[1] - velocity[1]
        self.velocity = velocity
        begun, spin = float(s[T]), float(s[SPIN])
        self._take(self._moving(angles, rates, begun, span, rests=ended))
        result = carry_until(self.motion, self.law, self.at, self.restitution, begun + span, MOST_EVENTS, self.anew)
        self.anew = False
        spent = float(s[T]) - begun
        self._slide(spent)
        self._turn(begun, spin)
        squeezed = result == TOO_MANY and is_enclosed(self.motion, self.at)
        self.lost = result == TOO_MANY and not squeezed
        self.pressed = result == PRESSED or squeezed
        if self.pressed:
            s[VX], s[VY], s[SPIN], s[MODE] = 0.0, 0.0, 0.0, FLIGHT
        return self.pressed

    def take_along(self, velocity: Vector, span: float) -> None:
        """The disk, pressed, goes with the arm for ``span`` (s)."""
        self.velocity = velocity
        self.at.state[T] += span
        self.at.state[LOGGED] = 0.0
        self._slide(span)

    def touches(self) -> list[Touch]:
        """Where the disk has been struck or touched since the last change of the motion, and where it touches now."""
        found = []
        for row in self.at.log[: int(self.at.state[LOGGED])]:
            if int(row[1]) in (IMPACT, LANDS):
                found += self._touch(int(row[2]), int(row[3]), float(row[0]), float(row[4]), float(row[5]))
        s = self.at.state
        for k in range(look(self.motion, self.at, NEAR * self.motion.reach)):
            body, feature = (int(each) for each in self.at.touching[k, :2])
            found += self._touch(body, feature, float(s[T]), float(s[X]), float(s[Y]))
        return found

    def judged(self, angles: Both) -> int:
        """The outcome's code, were this the end: fingers and arm stop."""
        hand = self.hand
        rest = programmed_hand(hand.half_palm, hand.finger_links, self.radius, hand.half_thickness, angles, [])
        at = bench(rest)
        at.state[:] = self.at.state
        at.state[MODE] = FLIGHT
        if not self.pressed:
            at.state[VX], at.state[VY] = self.track[2:]
        return ends_at_rest(
            rest, self.law, at, self.restitution, EVENTS_TO_THE_END, self.hand.finger_rate, self.pressed
        )

    def stay_at(self, angles: Both) -> None:
        """Before anything moves: the hand as it stands."""
        still = tuple(0.0 for _ in angles[0])
        self._take(self._moving(angles, (still, still), float(self.at.state[T]), 1.0, rests=False))
        begin_phase(self.motion, 0, self.at.fingers)

    def _moving(self, angles: Both, rates: Both, begun: float, span: float, *, rests: bool) -> CaptureHand:
        """The kernel's hand from ``begun`` (s) on for ``span`` (s); ``rests``: in its last phase, as a wall."""
        hand = self.hand
        bent = any((*angles[0][1:], *angles[1][1:], *rates[0][1:], *rates[1][1:]))
        links = hand.finger_links if bent else (hand.finger_length,)
        now, turn = (np.cumsum([each[k][: len(links)] for k in SIDES], axis=1) for each in (angles, rates))
        times, phases = (np.array([begun]), 1) if rests else (np.array([begun, begun + span]), 2)
        return CaptureHand(
            hand.half_palm, np.array(links), hand.half_thickness, self.radius, times,
            np.stack([now, now + span * turn][:phases]), np.stack([turn, np.zeros_like(turn)][:phases]),
            np.zeros((0, 3)),
        )  # fmt: skip

    def _take(self, motion: CaptureHand) -> None:
        """The hand's next motion, on a bench with as many links."""
        self.anew = self.anew or not np.array_equal(motion.rates[0], self.motion.rates[0])
        if len(motion.lengths) != len(self.motion.lengths):
            state = self.at.state
            self.at, self.anew = bench(motion, MOST_EVENTS), True
            self.at.state[:] = state
        self.motion = motion

    def _slide(self, seconds: float) -> None:
        self.arm = self.arm[0] + self.velocity[0] * seconds, self.arm[1] + self.velocity[1] * seconds

    def _turn(self, begun: float, spin: float) -> None:
        """Add the turn since ``begun`` (s), spinning at ``spin`` then: constant in flight, about linear in contact."""
        s = self.at.state
        log = self.at.log[: int(s[LOGGED])]
        times = np.array([begun, *log[:, 0], s[T]])
        before, after = np.array([*log[:, 10], s[SPIN]]), np.array([spin, *log[:, 11]])
        self.theta += float((0.5 * (before + after) * np.diff(times)).sum())

    def _touch(self, body: int, feature: int, t: float, x: float, y: float) -> list[Touch]:
        """The contact as places on the rows of the hand's links: an end of the palm is a finger's base, too."""
        if body == PALM:
            return [Touch(0, x + self.hand.half_palm)]
        f, j = divmod(body - 1, len(self.motion.lengths))
        first = 1 + f * len(self.hand.finger_links)
        if feature == BASE:
            return [Touch(0, self.hand.palm_width if f == 0 else 0.0), Touch(first, 0.0)]
        along = float(self.motion.lengths[j])
        if feature != END:
            along = gap_at(self.motion, self.at.fingers, body, feature, 1.0, t, x, y)[1]
        if len(self.motion.lengths) > 1:
            return [Touch(first + j, along)]
        for k, length in enumerate(self.hand.finger_links[:-1]):
            if along <= length:
                return [Touch(first + k, along)]
            along -= length
        return [Touch(first + len(self.hand.finger_links) - 1, along)]


def free_carriage(
    hand: Hand, radius: float, law: ImpactLaw, restitution: float, theta: float, angles: Both
) -> FreeCarriage:
    """A hand at rest, its joints at ``angles``; the disk is still to be put before it."""
    lengths = np.array(hand.finger_links)
    first = np.cumsum(np.array(angles), axis=1)
    motion = CaptureHand(
        hand.half_palm, lengths, hand.half_thickness, radius, np.zeros(1), first[None],
        np.zeros((1, *first.shape)), np.zeros((0, 3)),
    )  # fmt: skip
    found = FreeCarriage(hand, radius, law, restitution, theta, bench(motion, MOST_EVENTS), motion)
    found.stay_at(angles)
    return found


def _after(angles: Both, rates: Both, time: float) -> Both:
    right, left = (tuple(angle + rate * time for angle, rate in zip(angles[k], rates[k], strict=True)) for k in SIDES)
    return right, left
