"""A slow, regularised simulation of two fingers that close on a disk or a convex polygon lying on a table.

Nothing here knows a closed form. At every small step the pose q of the object solves the force balance

    0 = -sum_i w_i v_i / sqrt(|v_i|^2 + eps^2)  +  contacts(q, v),      v = (q - q_before) / step,

with the table friction carried by many points of weight w_i (sum 1: forces count in units of the whole friction
force) and with the stiff contacts of slow_contacts. Gaps are those at the end of the step; directions, arms and
velocities are taken at the fraction `weight` of it (1: backward Euler; 1/2: midpoint, of second order between
events). Newton's method finds q; steps are cut where it fails or where the object moves too far.

The hand is prescribed. The palm is the segment (-D,0)-(D,0) at rest; each finger follows a table of joint angles
along its own clock, which runs at rate 1. A finger whose contacts would need more than `stall` times the friction
force stops its clock for good: it is neither driven back nor does it start again. A finger also stops where one of
its links comes down to the palm line, and, if the fingers share one plane, where it meets the other finger.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .slow_contacts import Thing
from .slow_links import Motion
from .slow_model import Hand, Numerics, Object, Run, core, disk_support, end_of_travel, fastest_end, polygon_support
from .slow_stepping import HALTED, MET, STALLED, TOUCHED, TRAVELLED, Control, travel
from .slow_verdict import judge, overlaps

EVENTS = {HALTED: "halt", TOUCHED: "touch", STALLED: "stall", TRAVELLED: "end of travel", MET: "met"}
COARSE = Numerics()
FINE = Numerics(step=2.5e-4, eps=2e-5, stiffness=2e8, stall=2e3, rings=12, farthest=2.5e-4, rounding=2.5e-5)


@dataclass(frozen=True)
class Result:
    """The outcome (see slow_verdict), the final pose (x, y, theta), the joint angles (right, left) and the run."""

    outcome: str
    pose: np.ndarray
    joints: np.ndarray  # (2, links) relative angles, the first one of the base joint
    run: Run | None


def close_hand(
    hand: Hand, thing: Object, friction: float, start: tuple[float, ...], numerics: Numerics = COARSE
) -> Result:
    """Close the hand on the object that starts at (x, y) or (x, y, theta)."""
    pose = np.array([*start, 0.0][:3], float)
    clock, directions = hand.table()
    if overlaps(hand, thing, pose):
        return Result("invalid", pose, np.repeat(np.diff(directions[:1], prepend=0.0), 2, axis=0), None)
    run = run_fingers(hand, thing, friction, pose, numerics)
    at = np.stack([np.interp(run.clocks, clock, column) for column in directions.T], axis=1)
    outcome = "undecided" if run.steps >= numerics.most_steps else judge(hand, thing, friction, run)
    return Result(outcome, run.pose, np.diff(at, prepend=0.0), run)


def run_fingers(hand: Hand, thing: Object, friction: float, start: np.ndarray, numerics: Numerics = COARSE) -> Run:
    """Move the fingers until both have stopped."""
    unit = float(sum(hand.links))
    vertices = np.ascontiguousarray(np.asarray(thing.vertices, float) / unit)
    size = float(np.hypot(*vertices.T).max()) if len(vertices) else thing.radius / unit
    points, weights = thing.points, thing.weights
    if points is None or weights is None:
        points, weights = (
            polygon_support(np.asarray(thing.vertices, float), max(3, round(2 * numerics.rings / len(vertices) ** 0.5)))
            if len(vertices)
            else disk_support(thing.radius, numerics.rings)
        )
    points = np.ascontiguousarray(np.asarray(points, float) / unit)
    lengths, (clock, directions) = np.asarray(hand.links, float) / unit, hand.table()
    half = hand.half_thickness / unit
    motion = Motion(
        hand.half_palm / unit,
        lengths,
        clock,
        np.ascontiguousarray(directions),
        end_of_travel(lengths, clock, directions, half),
        half,
        hand.crossing,
        hand.wall / unit,
        hand.speed / unit,
    )
    rounding = numerics.rounding if len(vertices) else 0.0
    vertices = core(vertices, rounding) if len(vertices) else vertices
    most = 0.4 * rounding / fastest_end(lengths, clock, directions) if len(vertices) else math.inf  # no tunnelling
    control = Control(
        min(numerics.step, most),
        numerics.stall_step,
        numerics.smallest_step,
        numerics.weight,
        numerics.stall,
        min(numerics.farthest, rounding) if len(vertices) else numerics.farthest,
        numerics.most_steps,
    )
    damping = 10.0 * numerics.stiffness * numerics.smallest_step**2
    law = (size, numerics.stiffness, float(friction), numerics.eps, numerics.viscous, damping)
    scale = np.array([unit, unit, 1.0])
    pose = start / scale
    path, events = np.zeros((20000, 6)), np.zeros((100, 3))
    bodies = 2 * len(lengths) + (2 if hand.wall < math.inf else 1)
    links, loads = np.zeros((bodies, 4)), np.zeros(bodies)
    clocks, states, steps, unsolved = travel(
        Thing(thing.radius / unit, vertices, rounding, points, np.asarray(weights, float), *law),
        motion,
        control,
        pose,
        path,
        events,
        links,
        loads,
    )
    named = [(float(time), EVENTS[int(what)], int(who)) for time, what, who in events[1 : 1 + int(events[0, 0])]]
    path = path[1 : 1 + int(path[0, 0])] * np.array([1.0, unit, unit, 1.0, 1.0, 1.0])
    return Run(pose * scale, clocks, states, loads, links * unit, named, path, steps, unsolved, rounding * unit)
