"""Time stepping of the slow reference: the force balance of one step, and when a finger stops."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit

from .slow_contacts import Links, Sum, add_disk_contacts, add_polygon_contacts
from .slow_links import fingers_meet, place_links

MOVING, STALLED, TRAVELLED, MET = range(4)  # of a finger
HALTED, TOUCHED = 8, 9  # of the arm, of a body, in the list of events


class Control(NamedTuple):
    """Steps of the clock (radians where the base joint turns at rate 1)."""

    step: float
    stall_step: float  # a finger stalls if its load is above `stall` even in so short a step
    smallest_step: float
    weight: float
    stall: float
    farthest: float  # longest displacement of the object in one step, in finger lengths
    most_steps: int


@njit(error_model="numpy")
def add_table(thing, angle, change, step, out):
    """Add the wrench of the table friction and its derivative by the twist."""
    twist = (change[0] / step, change[1] / step, change[2] / step)
    cos, sin, viscous = math.cos(angle), math.sin(angle), thing.viscous + thing.damping / step
    for i in range(len(thing.weights)):
        x = cos * thing.points[i, 0] - sin * thing.points[i, 1]
        y = sin * thing.points[i, 0] + cos * thing.points[i, 1]
        u, v = twist[0] - twist[2] * y, twist[1] + twist[2] * x
        speed = math.sqrt(u * u + v * v + thing.eps * thing.eps)
        weight, rate = thing.weights[i], thing.weights[i] / speed
        drag = rate + viscous * weight
        out.wrench[0] -= drag * u
        out.wrench[1] -= drag * v
        out.wrench[2] -= drag * (x * v - y * u)
        u, v = u / speed, v / speed
        rate *= out.fading[0]
        xx, xy, yy = rate * u * u - drag, rate * u * v, rate * v * v - drag
        xt, yt = x * xy - y * xx, x * yy - y * xy
        out.slope[0, 0] += xx
        out.slope[0, 1] += xy
        out.slope[1, 0] += xy
        out.slope[1, 1] += yy
        out.slope[0, 2] += xt
        out.slope[2, 0] += xt
        out.slope[1, 2] += yt
        out.slope[2, 1] += yt
        out.slope[2, 2] += x * yt - y * xt


@njit(error_model="numpy")
def add_contacts(thing, links, start, change, step, motion, weight, out):
    """Clear the sum, add all contacts after the displacement `change`, return the smallest gap.

    The twist is `motion` / `step`: the change itself, except where the slope by the position alone is wanted.
    """
    pose_end, pose, twist = np.empty(3), np.empty(3), np.empty(3)
    for i in range(3):
        pose_end[i], pose[i], twist[i] = start[i] + change[i], start[i] + weight * change[i], motion[i] / step
        out.wrench[i] = 0.0
        for j in range(3):
            out.slope[i, j] = 0.0
    for body in range(len(out.forces)):
        out.forces[body] = 0.0
    if len(thing.vertices) == 0:
        return add_disk_contacts(thing, links, pose_end, pose, twist, out)
    return add_polygon_contacts(thing, links, pose_end, pose, twist, out)


@njit(error_model="numpy")
def solve_three(a, b, x):
    """Solve the 3 x 3 system a x = b by Cramer's rule."""
    determinant = 0.0
    for j in range(3):
        k, m = (j + 1) % 3, (j + 2) % 3
        x[j] = 0.0
        for i in range(3):
            p, q = (i + 1) % 3, (i + 2) % 3
            cofactor = a[p, k] * a[q, m] - a[q, k] * a[p, m]
            x[j] += cofactor * b[i]
            if j == 0:
                determinant += cofactor * a[i, 0]
    for j in range(3):
        x[j] /= determinant


@njit(error_model="numpy")
def norm(x):
    """Length of a vector of three."""
    return math.sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])


@njit(error_model="numpy")
def largest(x):
    """Largest element."""
    found = x[0]
    for each in x:
        found = max(found, each)
    return found


@njit(error_model="numpy")
def solve_step(thing, links, start, best, step, weight, out, spare):
    """Newton with halving on the force balance, from the displacement `best`, which it improves; True if solved.

    After much halving the next iteration takes the frictions as proportional to speed: shorter steps that do not
    leap over the steep part of the friction law.
    """
    trial, newton, balance, base, matrix = best.copy(), np.zeros(3), np.zeros(3), np.zeros(3), np.zeros((3, 3))
    error, share, nudge = 1e300, 1.0, 3e-11
    out.fading[0] = 1.0
    scale = (1.0, 1.0, 1.0 / thing.size)
    longest = 0.2 * thing.size if thing.rounding == 0.0 else thing.rounding
    for _ in range(100):
        add_contacts(thing, links, start, trial, step, trial, weight, out)
        for i in range(3):
            base[i] = out.wrench[i]
        add_table(thing, start[2] + weight * trial[2], trial, step, out)
        for i in range(3):
            balance[i] = out.wrench[i] * scale[i]
        found = norm(balance)
        if found >= error * (1.0 - 1e-4 * share):
            share *= 0.5
            if share < 1e-6 and out.fading[0] == 0.0:
                return False
            if share < 1e-3 and out.fading[0] == 1.0:
                out.fading[0], error, share = 0.0, 1e300, 0.0
            for i in range(3):
                trial[i] = best[i] + share * newton[i]
            continue
        out.fading[0] = 1.0 if share > 0.1 else 0.0
        for i in range(3):
            best[i] = trial[i]
        error, share = found, 1.0
        if error < 1e-6 * (1.0 + largest(out.forces)) + 2e-14 * thing.stiffness:
            return True
        for j in range(3):
            trial[j] += nudge * scale[j]
            add_contacts(thing, links, start, trial, step, best, weight, spare)
            trial[j] = best[j]
            for i in range(3):
                slope = out.slope[i, j] / step + (spare.wrench[i] - base[i]) / (nudge * scale[j])
                matrix[i, j] = slope * scale[i] * scale[j]
        solve_three(matrix, balance, newton)
        shorten = min(1.0, longest / norm(newton))
        for i in range(3):
            newton[i] *= -scale[i] * shorten
            trial[i] = best[i] + newton[i]
    return False


@njit(error_model="numpy")
def note(events, time, what, who):
    """Write an event into the first free row; row 0 counts them."""
    row = int(events[0, 0]) + 1
    if row < len(events):
        events[row, 0], events[row, 1], events[row, 2] = time, what, who
        events[0, 0] = row


@njit(error_model="numpy")
def stop(states, running, finger, state, events, time):
    """Stop a finger for good."""
    states[finger], running[finger] = state, 0.0
    note(events, time, state, finger)


@njit(error_model="numpy")
def loads_too_high(motion, control, forces, step, states, running, events, time):
    """Whether a moving finger's load is above the limit; it stalls if that is so in the shortest step."""
    over, count = False, len(motion.lengths)
    if running[2] > 0.0 and motion.speed != 0.0 and motion.wall < math.inf:
        most = 0.0
        for body in range(2 * count + 1):
            most = max(most, forces[body])
        if most > control.stall:
            if step <= control.stall_step:
                running[2] = 0.0
                note(events, time, HALTED, 2)
            return True
    for finger in range(2):
        load = 0.0
        for link in range(count):
            load += forces[1 + finger * count + link] * running[finger]
        if load > control.stall:
            over = True
            if step <= control.stall_step:
                stop(states, running, finger, STALLED, events, time)
    return over


@njit(error_model="numpy")
def keep(path, every, time, pose, clocks):
    """Append to the path, not more often than `every`."""
    row = int(path[0, 0]) + 1
    if row < len(path) and (row == 1 or time >= path[row - 1, 0] + every):
        path[row, 0], path[row, 4], path[row, 5] = time, clocks[0], clocks[1]
        for i in range(3):
            path[row, 1 + i] = pose[i]
        path[0, 0] = row


@njit(error_model="numpy")
def travel(thing, motion, control, pose, path, events, ends, latest):
    """Run both fingers to their stops: (clocks, states, steps, steps accepted without convergence).

    `pose`, the final segments `ends` and normal forces `latest` are filled, so are `path` and `events` (row 0 of
    these counts the others).
    """
    count = len(motion.lengths)
    bodies = len(latest)
    thickness, touched, unused = np.zeros(bodies), np.zeros(bodies), np.zeros((bodies, 4))
    for body in range(bodies):
        thickness[body] = thing.rounding + (motion.half_thickness if 0 < body <= 2 * count else 0.0)
    links = Links(ends, np.zeros((bodies, 4)), np.zeros((bodies, 4)), thickness)
    out = Sum(np.zeros(3), np.zeros((3, 3)), np.ones(1), np.zeros(bodies))
    spare = Sum(np.zeros(3), np.zeros((3, 3)), np.ones(1), np.zeros(bodies))
    clocks, states, running = np.zeros(3), np.zeros(2, np.int64), np.zeros(3)
    running[2] = 1.0
    for finger in range(2):
        clocks[finger], running[finger] = motion.clock[0], 1.0
    velocity, before, change = np.zeros(3), np.zeros(3), np.zeros(3)
    step, last_step, time, steps, unsolved = control.step, control.step, 0.0, 0, 0
    while running[0] + running[1] > 0.0 and steps < control.most_steps:
        steps += 1
        for finger in range(2):
            if running[finger] > 0.0:
                step = min(step, max(motion.last - clocks[finger], 1e-12))
        place_links(motion, clocks, running, step, links.ends, unused)
        if not motion.crossing and fingers_meet(links.ends, count, motion.half_thickness):
            for finger in range(2):
                if step <= control.stall_step and running[finger] > 0.0:
                    stop(states, running, finger, MET, events, time)
            step = max(0.25 * step, control.stall_step)
            continue
        place_links(motion, clocks, running, control.weight * step, links.mid, links.rates)
        solved, ratio = False, 0.5 * (step + last_step) / last_step
        for attempt in range(3):  # nothing touches; Newton from the extrapolated velocity; Newton from rest
            for i in range(3):
                change[i] = step * (velocity[i] + (velocity[i] - before[i]) * ratio) if attempt == 1 else 0.0
            if attempt == 0:
                solved = add_contacts(thing, links, pose, change, step, change, control.weight, out) >= 0.0
            else:
                solved = solve_step(thing, links, pose, change, step, control.weight, out, spare)
            if solved:
                break
        moved = math.sqrt(change[0] ** 2 + change[1] ** 2 + (thing.size * change[2]) ** 2)
        if (moved > control.farthest or not solved) and step > control.smallest_step:
            step = max(0.25 * step, control.smallest_step)
            continue
        if loads_too_high(motion, control, out.forces, step, states, running, events, time):
            step = max(0.25 * step, min(step, control.stall_step))
            continue
        unsolved += not solved
        time += step
        for i in range(3):
            before[i], velocity[i] = velocity[i], change[i] / step
            pose[i] += change[i]
        for body in range(bodies):
            latest[body] = out.forces[body]
            if latest[body] > 0.0 and touched[body] == 0.0:
                touched[body] = 1.0
                note(events, time, TOUCHED, body)
        clocks[2] += step * running[2]
        for finger in range(2):
            clocks[finger] += step * running[finger]
            if running[finger] > 0.0 and clocks[finger] >= motion.last - 1e-11:
                stop(states, running, finger, TRAVELLED, events, time)
        keep(path, 1e-4 * (motion.last - motion.clock[0]), time, pose, clocks)
        last_step, step = (
            step,
            min(control.step, step * max(0.5, min(2.0, 0.8 * control.farthest / max(moved, 1e-300)))),
        )
    place_links(motion, clocks, running, 0.0, ends, unused)
    return clocks[:2], states, steps, unsolved
