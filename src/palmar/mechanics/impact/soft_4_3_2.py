"""A free disk and two straight fingers with soft contacts and motors that lag: section 4.3.2 as motion.

Disk (m, m R^2 / 2) against the right finger, the left one and the palm, each contact a spring k and a damper c on the
compression d, F = max(0, k d + c d'), with Coulomb's friction: mu F against the slip, or what stops the slip of a rim,
m / 3, within a step. A finger of inertia I about its base joint obeys I w' = M less the contact's moment, with the motor's
torque M:

    T M' = wanted - M,    wanted = within +- limit: I (rate - w) / ``SERVO`` for a rate, or the torque asked for;

without a lag M is the wanted torque. The damper is that of the restitution asked for, c = 2 zeta sqrt(k M_eff), with the
effective mass 1 / M_eff = 1 / m + X^2 / I of the moment. At the ends of its travel a finger stops.

Midpoint rule; the step is a small part of the quickest oscillation (``steps_for``). Fingers pass each other.
"""

from __future__ import annotations

from math import ceil, cos, hypot, sin, sqrt
from typing import NamedTuple

import numpy as np

from palmar.mechanics.compiled import compiled
from palmar.mechanics.impact.finger_motion import Floats

X, Y, THETA, VX, VY, SPIN, ANGLE, RATE, MOTOR = 0, 1, 2, 3, 4, 5, 6, 8, 10
"""Of the state: of the disk, then of the right and the left finger angle, rate and motor torque."""
STATE_WIDTH = 12
FORCE, MOMENT, PEAK = 0, 3, 5
"""Of what is felt: normal forces (N) on right finger, left finger and palm, moments (N m) about the base joints, closing
negative; and the largest forces since they were last set to 0."""
FELT_WIDTH = 8
SERVO = 2e-3
"""Time (s) in which a motor brings its finger to the rate, where its torque allows."""
FINENESS = 0.02
"""Steps of so many radians of the quickest oscillation."""


class SoftHand(NamedTuple):
    """Lengths (m), ``lowest`` and ``highest`` base angle (rad); ``inertia`` of a finger (kg m^2), ``limit`` of
    its motor (N m), its ``lag`` (s); ``radius`` and ``mass`` of the disk; ``stiffness`` (N/m) and ``damping``
    ratio of contacts, ``friction``.
    """

    half_palm: float
    length: float
    half_thickness: float
    lowest: float
    highest: float
    inertia: float
    limit: float
    lag: float
    radius: float
    mass: float
    stiffness: float
    damping: float
    friction: float


def steps_for(hand: SoftHand, seconds: float) -> int:
    """Into how many steps so long a time is to be divided."""
    lightest = 1.0 / (1.0 / hand.mass + hand.length**2 / hand.inertia)
    quickest = max(sqrt(hand.stiffness / lightest) * max(1.0, 2.0 * hand.damping), 1.0 / SERVO)
    quickest = max(quickest, 1.0 / hand.lag if hand.lag > 0.0 else 0.0)
    return max(1, ceil(seconds * quickest / FINENESS))


@compiled
def _contact(
    hand: SoftHand, state: Floats, felt: Floats, body: int, gap: float, nx: float, ny: float,
    foot: float, wx: float, wy: float, step: float, change: Floats,
) -> float:  # fmt: skip
    """Add a contact's forces to ``change``; (nx, ny) from the body to the disk's centre, (wx, wy) the body's velocity there.

    Returns the force along (-ny, nx) on the disk, the friction.
    """
    closing = (wx - state[VX]) * nx + (wy - state[VY]) * ny
    mass = 1.0 / (1.0 / hand.mass + foot * foot / hand.inertia)
    force = -hand.stiffness * gap + 2.0 * hand.damping * sqrt(hand.stiffness * mass) * closing
    felt[FORCE + body] = 0.0
    if gap >= 0.0 or force <= 0.0:
        return 0.0
    felt[FORCE + body] = force
    arm = hand.radius + gap
    slip = -(state[VX] - wx) * ny + (state[VY] - wy) * nx - arm * state[SPIN]
    most = hand.friction * force
    drag = min(max(-hand.mass * slip / (3.0 * step), -most), most)
    change[VX] += (force * nx - drag * ny) / hand.mass
    change[VY] += (force * ny + drag * nx) / hand.mass
    change[SPIN] -= 2.0 * drag * arm / (hand.mass * hand.radius * hand.radius)
    return drag


@compiled
def _finger(hand: SoftHand, state: Floats, told: Floats, felt: Floats, f: int, step: float, change: Floats) -> None:
    """Contact and motion of finger f; ``told``: rates (rad/s) of both, then torques (N m), NaN where a rate counts."""
    side = 1.0 if f == 0 else -1.0
    angle, rate = state[ANGLE + f], state[RATE + f]
    c, s = cos(angle), sin(angle)
    px, py = side * state[X] - hand.half_palm, state[Y]
    foot = min(max(px * c + py * s, 0.0), hand.length)
    ax, ay = px - foot * c, py - foot * s
    apart = hypot(ax, ay)
    nx, ny = (side * ax / apart, ay / apart) if apart > 0.0 else (-side * s, c)
    # The contact is on the finger's surface, a half thickness off its line.
    qx, qy = foot * c + hand.half_thickness * side * nx, foot * s + hand.half_thickness * ny
    gap = apart - hand.radius - hand.half_thickness
    drag = _contact(
        hand, state, felt, f, gap, nx, ny, foot, -side * rate * qy, rate * qx, step, change
    )  # fmt: skip
    force = felt[FORCE + f]
    fx, fy = -(force * nx - drag * ny), -(force * ny + drag * nx)
    moment = qx * fy - qy * side * fx
    felt[MOMENT + f] = moment
    change[ANGLE + f] = rate
    wanted = told[2 + f]
    if np.isnan(wanted):
        wanted = hand.inertia * (told[f] - rate) / SERVO
    wanted = min(max(wanted, -hand.limit), hand.limit)
    motor = wanted
    if hand.lag > 0.0:
        motor = state[MOTOR + f]
        change[MOTOR + f] = (wanted - motor) / hand.lag
    change[RATE + f] = (motor + moment) / hand.inertia


@compiled
def _changes(hand: SoftHand, state: Floats, told: Floats, felt: Floats, step: float, change: Floats) -> None:
    """Write the rate of change of the state, and what is felt."""
    change[:] = 0.0
    change[X], change[Y], change[THETA] = state[VX], state[VY], state[SPIN]
    along = min(max(state[X], -hand.half_palm), hand.half_palm)
    apart = hypot(state[X] - along, state[Y])
    nx, ny = ((state[X] - along) / apart, state[Y] / apart) if apart > 0.0 else (0.0, 1.0)
    _contact(hand, state, felt, 2, apart - hand.radius, nx, ny, 0.0, 0.0, 0.0, step, change)
    for f in range(2):
        _finger(hand, state, told, felt, f, step, change)


@compiled
def advance(
    hand: SoftHand, state: Floats, told: Floats, felt: Floats, seconds: float, steps: int, middle: Floats, change: Floats
) -> None:  # fmt: skip
    """Carry the state (STATE_WIDTH,) on in place; ``middle`` and ``change`` are scratch of its shape."""
    step = seconds / steps
    for _ in range(steps):
        for f in range(2):
            if state[RATE + f] > 0.0 and state[ANGLE + f] >= hand.highest:
                state[ANGLE + f], state[RATE + f] = hand.highest, 0.0
            elif state[RATE + f] < 0.0 and state[ANGLE + f] <= hand.lowest:
                state[ANGLE + f], state[RATE + f] = hand.lowest, 0.0
        _changes(hand, state, told, felt, step, change)
        for k in range(3):
            felt[PEAK + k] = max(felt[PEAK + k], felt[FORCE + k])
        for k in range(len(state)):
            middle[k] = state[k] + 0.5 * step * change[k]
        _changes(hand, middle, told, felt, step, change)
        for k in range(len(state)):
            state[k] += step * change[k]
