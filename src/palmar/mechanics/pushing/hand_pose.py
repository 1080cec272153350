"""Where the links of a closing hand are, and how fast they move.

A finger's link j points in the direction psi + sum over the joints up to j of (offset + ratio (psi - first)), from the
palm line outward. Time is psi: the base angle of both fingers of a mirrored motion, in general the time in any unit, the
base joint's offset and ratio making an angle of it. A finger that has stalled at a time stays as it was then. The whole
hand may slide along by a velocity per unit of time, and gives way where a wall holds its fingers back (``wall``).
"""

from __future__ import annotations

from math import inf, pi
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled, inlined

Floats = NDArray[np.float64]
MOST_LINKS = 3
LINK_WIDTH = 8
"""A link is a row (ax, ay, bx, by, angular rate, velocity of a (2), half thickness); palm first, the wall, if any, last."""
MOST_ROWS = 2 * MOST_LINKS + 2
WALL_REACH = 100.0
"""The wall goes so far to either side, in units of finger and half palm."""
MOVING = -1.0
"""Stands for the angle of a finger that has not stalled."""
SAMPLES = 20_001


class HandMotion(NamedTuple):
    """A prescribed closing motion, lengths in m, angles in rad.

    ``links`` from the base to the tip; ``offsets`` and ``ratios`` (2, links), right and left: joint j counts from straight
    and is at ``offset + ratio (psi - first)``, the base joint at psi more than that. The base slides by (vx, vy) per
    radian; ``last`` ends the motion. ``alone`` is where a finger would end if the other were not there to be met; 0: they
    pass each other (``meeting``). ``mirrored``: both rows are equal, and fingers of one plane meet at ``last``. ``wall``: a
    line at this y (m) that stays where it is, as the table does. The base slides until the time ``halt``.
    """

    half_palm: float
    links: Floats
    half_thickness: float
    first: float
    last: float
    offsets: Floats
    ratios: Floats
    vx: float
    vy: float
    alone: float = 0.0
    mirrored: bool = True
    wall: float = inf
    halt: float = inf


def hand_motion(
    half_palm: float,
    links: ArrayLike,
    half_thickness: float = 0.0,
    *,
    first: float = 0.0,
    limit: float = pi,
    offsets: ArrayLike | None = None,
    ratios: ArrayLike | None = None,
    velocity: tuple[float, float] = (0.0, 0.0),
    colliding: bool = False,
) -> HandMotion:
    """A motion from ``first`` to where a link reaches the palm, or the fingers meet, or to the joint ``limit``.

    ``offsets`` and ``ratios`` are those of the distal joints (links - 1 entries each, straight unless given).
    """
    lengths = np.ascontiguousarray(links, dtype=float)
    rest = len(lengths) - 1
    if not 1 <= len(lengths) <= MOST_LINKS:
        raise ValueError(f"a finger has 1 to {MOST_LINKS} links, not {len(lengths)}")
    bends = np.zeros(rest) if offsets is None else np.asarray(offsets, dtype=float)
    turns = np.zeros(rest) if ratios is None else np.asarray(ratios, dtype=float)
    if bends.shape != (rest,) or turns.shape != (rest,):
        raise ValueError(f"offsets and ratios need one entry for each of the {rest} distal joints")
    offset, ratio = np.tile(np.append(0.0, bends), (2, 1)), np.tile(np.append(0.0, turns), (2, 1))
    motion = HandMotion(
        float(half_palm), lengths, float(half_thickness), float(first), float(limit),
        offset, ratio, float(velocity[0]), float(velocity[1]),
    )  # fmt: skip
    alone = _end_of_travel(motion, False)
    return motion._replace(last=_end_of_travel(motion, True), alone=alone) if colliding else motion._replace(last=alone)


def free_motion(
    half_palm: float, links: Floats, half_thickness: float, angles: Floats, rates: Floats,
    velocity: tuple[float, float], duration: float, colliding: bool,
) -> HandMotion:  # fmt: skip
    """A motion from joint ``angles`` (2, links), right and left, at constant ``rates`` per unit of time, from time 0 on.

    It ends after ``duration``, or where fingers that share a plane (``colliding``) meet before.
    """
    ratios = np.ascontiguousarray(rates, dtype=float).copy()
    ratios[:, 0] -= 1.0
    alike = bool(np.array_equal(angles[0], angles[1]) and np.array_equal(rates[0], rates[1]))
    return HandMotion(
        half_palm, links, half_thickness, 0.0, duration, np.ascontiguousarray(angles, dtype=float), ratios,
        velocity[0], velocity[1], duration if colliding else 0.0, alike and not colliding,
    )  # fmt: skip


def _end_of_travel(motion: HandMotion, colliding: bool) -> float:
    """The first sampled angle at which a link lies on the palm or, for colliding fingers, on the axis; refined."""
    h, low, high = motion.half_thickness, motion.first, motion.last

    def stopped(psi: Floats) -> NDArray[np.bool_]:
        joints = motion.offsets[0] + motion.ratios[0] * (psi[:, None] - motion.first)
        angles = psi[:, None] + np.cumsum(joints, axis=1)
        x = motion.half_palm + np.cumsum(motion.links * np.cos(angles), axis=1)
        y = np.cumsum(motion.links * np.sin(angles), axis=1)
        down: NDArray[np.bool_] = np.logical_or.reduce((y <= h) & (angles > 0.5 * pi), axis=1)
        met: NDArray[np.bool_] = np.logical_or.reduce(x <= h, axis=1)
        return np.logical_or(down, met) if colliding else down

    for _ in range(4):
        psi = np.linspace(low, high, SAMPLES)
        at = stopped(psi)
        if not at.any():
            return high
        k = int(np.argmax(at))
        low, high = float(psi[max(k - 1, 0)]), float(psi[k])
    return high


@compiled
def place_links(hand: HandMotion, time: float, right: float, left: float, rows: Floats) -> None:
    """Write palm, right links, left links, wall to ``rows`` (8 wide); ``right``, ``left``: stall angle or MOVING."""
    count, gone = len(hand.links), min(time, hand.halt) - hand.first
    slides = 1.0 if time < hand.halt else 0.0
    base_x, base_y, base_vx, base_vy = hand.vx * gone, hand.vy * gone, slides * hand.vx, slides * hand.vy
    if hand.wall < inf:
        held, rate = held_back(hand, time, right, left)
        base_y, base_vy = (held, rate) if held < base_y else (base_y, base_vy)
        side = WALL_REACH * (hand.half_palm + hand.links.sum())
        far = rows[2 * count + 1]
        far[0], far[1], far[2], far[3] = base_x + side, hand.wall, base_x - side, hand.wall
        far[4], far[5], far[6], far[7] = 0.0, 0.0, 0.0, 0.0
    palm = rows[0]
    palm[0], palm[1], palm[2], palm[3] = base_x - hand.half_palm, base_y, base_x + hand.half_palm, base_y
    palm[4], palm[5], palm[6], palm[7] = 0.0, base_vx, base_vy, 0.0
    for finger in range(2):
        side = 1.0 if finger == 0 else -1.0
        stopped = right if finger == 0 else left
        if finger == 1 and hand.mirrored and left == right:
            _mirror_links(rows, count, base_x, base_vx)
            return
        psi, rate = (time, 1.0) if stopped == MOVING else (stopped, 0.0)
        x, y, vx, vy, angle, turn = side * hand.half_palm, 0.0, base_vx, base_vy, psi, rate
        for j in range(count):
            angle += hand.offsets[finger, j] + hand.ratios[finger, j] * (psi - hand.first)
            turn += hand.ratios[finger, j] * rate
            c, s = cosine_sine(angle)
            dx, dy = side * hand.links[j] * c, hand.links[j] * s
            row = rows[1 + finger * count + j]
            row[0], row[1], row[2], row[3] = base_x + x, base_y + y, base_x + x + dx, base_y + y + dy
            row[4], row[5], row[6], row[7] = side * turn, vx, vy, hand.half_thickness
            x, y = x + dx, y + dy
            vx, vy = vx - side * turn * dy, vy + side * turn * dx


@compiled
def held_back(hand: HandMotion, time: float, right: float, left: float) -> tuple[float, float]:
    """How far ahead (m) the wall lets the base be, for the fingers as they are, and the rate of that.

    The wrist gives way: a finger at the wall slides along it and holds the hand back (assumption 7 of section 2.1).
    """
    reach, rate = 0.0, 0.0
    for finger in range(2):
        stopped = right if finger == 0 else left
        psi, pace = (time, 1.0) if stopped == MOVING else (stopped, 0.0)
        height, rise, angle, turn = hand.half_thickness, 0.0, psi, pace
        for j in range(len(hand.links)):
            angle += hand.offsets[finger, j] + hand.ratios[finger, j] * (psi - hand.first)
            turn += hand.ratios[finger, j] * pace
            c, s = cosine_sine(angle)
            height, rise = height + hand.links[j] * s, rise + hand.links[j] * c * turn
            if height > reach:
                reach, rate = height, rise
    return hand.wall - reach, -rate


@inlined
def as_halted(hand: HandMotion, halt: float) -> HandMotion:
    """The motion of an arm that was halted at a time (MOVING: was not)."""
    return HandMotion(
        hand.half_palm, hand.links, hand.half_thickness, hand.first, hand.last, hand.offsets, hand.ratios,
        hand.vx, hand.vy, hand.alone, hand.mirrored, hand.wall, inf if halt == MOVING else halt,
    )  # fmt: skip


@inlined
def stands(hand: HandMotion) -> bool:
    """Whether the base stays where it is."""
    return hand.vx == 0.0 and hand.vy == 0.0 and hand.wall == inf


@inlined
def fastest_turn(hand: HandMotion) -> float:
    """The largest rate of turn of a link."""
    fastest = 0.0
    for finger in range(2):
        turn = 1.0
        for j in range(len(hand.links)):
            turn += hand.ratios[finger, j]
            fastest = max(fastest, abs(turn))
    return fastest


@inlined
def row_count(hand: HandMotion) -> int:
    """Rows that ``place_links`` writes."""
    return 2 * len(hand.links) + (2 if hand.wall < inf else 1)


@compiled
def _mirror_links(rows: Floats, count: int, base_x: float, base_vx: float) -> None:
    """Write the left finger's links as the right one's mirror images."""
    for j in range(1, count + 1):
        one, other = rows[j], rows[count + j]
        other[0], other[1], other[2], other[3] = 2.0 * base_x - one[0], one[1], 2.0 * base_x - one[2], one[3]
        other[4], other[5], other[6], other[7] = -one[4], 2.0 * base_vx - one[5], one[6], one[7]


@compiled
def finger_of(hand: HandMotion, link: int) -> int:
    """0 for a link of the right finger, 1 of the left, -1 the palm or the wall."""
    return -1 if link == 0 or link > 2 * len(hand.links) else (link - 1) // len(hand.links)
