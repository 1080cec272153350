"""Where the links of a hand are, how fast their ends move, and where the two fingers meet."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit


class Motion(NamedTuple):
    """The hand and its prescribed motion; the left finger mirrors the right one."""

    half_palm: float
    lengths: np.ndarray  # (n,) links from the base to the tip
    clock: np.ndarray  # (k,)
    directions: np.ndarray  # (k, n) of the right finger's links, linear in the clock between rows
    last: float  # clock at the end of travel
    half_thickness: float
    crossing: bool
    wall: float
    speed: float  # of the whole hand along y


@njit(error_model="numpy")
def place_links(motion, clocks, running, step, ends, rates):
    """Fill the segments and the velocities of their ends, with the clocks that run one step ahead; the arm has the third."""
    count = len(motion.lengths)
    ends[0, 0], ends[0, 1], ends[0, 2], ends[0, 3] = -motion.half_palm, 0.0, motion.half_palm, 0.0
    rates[0, 1], rates[0, 3] = 0.0, 0.0
    for finger in range(2):
        mirror, row, at = 1.0 - 2.0 * finger, 0, clocks[finger] + step * running[finger]
        while row < len(motion.clock) - 2 and motion.clock[row + 1] <= at:
            row += 1
        span = motion.clock[row + 1] - motion.clock[row]
        share = (at - motion.clock[row]) / span
        x, y, rate_x, rate_y = motion.half_palm, 0.0, 0.0, 0.0
        for link in range(count):
            body = 1 + finger * count + link
            before, after = motion.directions[row, link], motion.directions[row + 1, link]
            angle, turn = (1.0 - share) * before + share * after, running[finger] * (after - before) / span
            ends[body, 0], ends[body, 1] = mirror * x, y
            rates[body, 0], rates[body, 1] = mirror * rate_x, rate_y
            cos, sin = motion.lengths[link] * math.cos(angle), motion.lengths[link] * math.sin(angle)
            x, y, rate_x, rate_y = x + cos, y + sin, rate_x - sin * turn, rate_y + cos * turn
            ends[body, 2], ends[body, 3] = mirror * x, y
            rates[body, 2], rates[body, 3] = mirror * rate_x, rate_y
    shift(ends, rates, 2 * count + 1, motion.speed * (clocks[2] + step * running[2]), motion.speed * running[2])
    if motion.wall < math.inf:
        give_way(motion, ends, rates)


@njit(error_model="numpy")
def shift(ends, rates, bodies, way, speed):
    """Move the hand along y."""
    for body in range(bodies):
        ends[body, 1] += way
        ends[body, 3] += way
        rates[body, 1] += speed
        rates[body, 3] += speed


@njit(error_model="numpy")
def give_way(motion, ends, rates):
    """Move the whole hand back from the wall by as much as the end that is farthest ahead is beyond it, and add the wall."""
    bodies = 1 + 2 * len(motion.lengths)
    most, rate = 0.0, 0.0
    for body in range(1, bodies):
        beyond = ends[body, 3] + motion.half_thickness - motion.wall
        if beyond > most:
            most, rate = beyond, rates[body, 3]
    shift(ends, rates, bodies, -most, -rate)
    ends[bodies, 0], ends[bodies, 1], ends[bodies, 2], ends[bodies, 3] = 50.0, motion.wall, -50.0, motion.wall


@njit(error_model="numpy")
def distance(segment, x, y):
    """From a point to a segment."""
    along_x, along_y = segment[2] - segment[0], segment[3] - segment[1]
    share = ((x - segment[0]) * along_x + (y - segment[1]) * along_y) / (along_x**2 + along_y**2)
    share = min(1.0, max(0.0, share))
    return math.sqrt((x - segment[0] - share * along_x) ** 2 + (y - segment[1] - share * along_y) ** 2)


@njit(error_model="numpy")
def turns(segment, x, y):
    """Positive on the right of a segment, negative on its left."""
    return (x - segment[0]) * (segment[3] - segment[1]) - (y - segment[1]) * (segment[2] - segment[0])


@njit(error_model="numpy")
def fingers_meet(ends, count, half):
    """Whether a link of the right finger crosses one of the left or comes nearer than both half thicknesses."""
    for i in range(1, count + 1):
        for j in range(count + 1, 2 * count + 1):
            a, b = ends[i], ends[j]
            apart = turns(a, b[0], b[1]) * turns(a, b[2], b[3]) > 0.0
            if not apart and turns(b, a[0], a[1]) * turns(b, a[2], a[3]) <= 0.0:
                return True
            near = min(distance(a, b[0], b[1]), distance(a, b[2], b[3]))
            if min(near, distance(b, a[0], a[1]), distance(b, a[2], a[3])) < 2.0 * half:
                return True
    return False
