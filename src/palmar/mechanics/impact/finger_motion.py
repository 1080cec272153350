"""Where the links of a finger are at a time, and how they move.

A finger is seen in its own frame: the base joint is the origin, x points outward along the palm line, y away from the
palm; a closing finger turns to the left. The left finger's frame is the mirror image of the right one's. From its time
``since`` on, link j points along (cos, sin) of angle_j + rate_j tau + acceleration tau^2 / 2, tau = t - since.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled, inlined

Floats = NDArray[np.float64]
MOST_LINKS = 3
SINCE, FASTER, ANGLE, RATE = 0, 1, 2, 2 + MOST_LINKS
FINGER_WIDTH = 2 + 2 * MOST_LINKS
"""A finger in motion is a row (since, acceleration, angles, rates)."""


class CaptureHand(NamedTuple):
    """A hand whose fingers turn as prescribed, and the radius of the disk it is to catch; m, s, rad.

    Phase k begins at ``times[k]`` with the links (2 fingers, n) at ``angles[k]`` from the outward palm line, turning at
    ``rates[k]``; the last phase has no end, its rates are 0. ``closures`` (M, 3): from the time in column 0 on, the
    elements of the chain (``place_chain``) in columns 1 and 2 are too near to each other for the disk to pass between.
    """

    half_palm: float
    lengths: Floats
    half_thickness: float
    radius: float
    times: Floats
    angles: Floats
    rates: Floats
    closures: Floats

    @property
    def reach(self) -> float:
        """Farthest that a touching disk's centre can be from the middle of the palm (m)."""
        return self.half_palm + float(self.lengths.sum()) + self.half_thickness + self.radius


@inlined
def side_of(finger: int) -> float:
    """1 for the right finger, -1 for the left one: the sign that takes x into its frame."""
    return 1.0 if finger == 0 else -1.0


@compiled
def begin_finger(hand: CaptureHand, phase: int, f: int, fingers: Floats) -> None:
    """Write finger f as it moves in a phase."""
    fingers[f, SINCE], fingers[f, FASTER] = hand.times[phase], 0.0
    for j in range(len(hand.lengths)):
        fingers[f, ANGLE + j], fingers[f, RATE + j] = hand.angles[phase, f, j], hand.rates[phase, f, j]


@compiled
def begin_phase(hand: CaptureHand, phase: int, fingers: Floats) -> None:
    """Write the fingers (2, FINGER_WIDTH) as they move in a phase."""
    begin_finger(hand, phase, 0, fingers)
    begin_finger(hand, phase, 1, fingers)


@inlined
def turned(finger: Floats, j: int, t: float) -> tuple[float, float]:
    """(angle, rate) of link j."""
    tau = t - finger[SINCE]
    half = 0.5 * finger[FASTER] * tau
    return finger[ANGLE + j] + (finger[RATE + j] + half) * tau, finger[RATE + j] + 2.0 * half


@inlined
def joint(hand: CaptureHand, finger: Floats, j: int, t: float) -> tuple[float, float, float, float]:
    """Place and velocity of link j's proximal joint."""
    ax, ay, ax1, ay1 = 0.0, 0.0, 0.0, 0.0
    for i in range(j):
        angle, rate = turned(finger, i, t)
        c, s = cosine_sine(angle)
        dx, dy = hand.lengths[i] * c, hand.lengths[i] * s
        ax, ay, ax1, ay1 = ax + dx, ay + dy, ax1 - rate * dy, ay1 + rate * dx
    return ax, ay, ax1, ay1


@inlined
def joint_acceleration(hand: CaptureHand, finger: Floats, j: int, t: float) -> tuple[float, float]:
    """Acceleration of link j's proximal joint; j = number of links: of the tip."""
    ax2, ay2 = 0.0, 0.0
    for i in range(j):
        angle, rate = turned(finger, i, t)
        c, s = cosine_sine(angle)
        dx, dy = hand.lengths[i] * c, hand.lengths[i] * s
        ax2 -= rate * rate * dx + finger[FASTER] * dy
        ay2 -= rate * rate * dy - finger[FASTER] * dx
    return ax2, ay2


@inlined
def joint_bounds(hand: CaptureHand, finger: Floats, j: int, tau: float) -> tuple[float, float]:
    """Bounds on speed and acceleration of link j's proximal joint from ``since`` until ``since + tau``."""
    speed, acceleration = 0.0, 0.0
    for i in range(j):
        rate = max(abs(finger[RATE + i]), abs(finger[RATE + i] + finger[FASTER] * tau))
        speed += hand.lengths[i] * rate
        acceleration += hand.lengths[i] * (rate * rate + abs(finger[FASTER]))
    return speed, acceleration


@inlined
def moves(hand: CaptureHand, finger: Floats) -> bool:
    """Whether any link of the finger turns."""
    found = finger[FASTER] != 0.0
    for j in range(len(hand.lengths)):
        found = found or finger[RATE + j] != 0.0
    return found


@compiled
def place_chain(hand: CaptureHand, fingers: Floats, t: float, chain: Floats) -> None:
    """Write the corners (2n + 2, 2) of the line from left tip to right tip over the palm; element k joins k and k + 1."""
    n = len(hand.lengths)
    for f in range(2):
        side, step = side_of(f), 1 if f == 0 else -1
        x, y, k = hand.half_palm, 0.0, n + 1 - f
        chain[k, 0], chain[k, 1] = side * x, y
        for j in range(n):
            angle, _ = turned(fingers[f], j, t)
            c, s = cosine_sine(angle)
            x, y, k = x + hand.lengths[j] * c, y + hand.lengths[j] * s, k + step
            chain[k, 0], chain[k, 1] = side * x, y
