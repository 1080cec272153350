"""A disk in sustained contact with one link or one point of a finger, advanced in time.

On a link, seen from it, the foot s of the disk's centre obeys s'' = rate^2 s - a''.u + F / m, a the link's joint. Without
friction and with constant rates, -a''.u = sum over the links before of l_i rate_i^2 cos(difference of angles), so s is the
sum of -l_i rate_i^2 cos(.) / (rate^2 + (rate - rate_i)^2) and of a cosh and a sinh of rate t (equation 4.1: r0 cosh where
s' = 0 at first). With friction the rim slips by s' + side R (spin - rate): sliding, F is mu N against the slip (4.3);
rolling, a uniform disk keeps the slip at 0 by F / m = -(rate^2 s - a''.u) / 3, so s'' = 2/3 rate^2 s (4.2), as long as that
is within mu N. N / m = side (n.a'' + 2 rate s') - rate^2 c. These, points, and fingers that speed up are integrated.
"""

from __future__ import annotations

from math import cos, cosh, hypot, sin, sinh

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.impact.finger_motion import (
    FASTER,
    CaptureHand,
    Floats,
    joint,
    joint_acceleration,
    side_of,
    turned,
)

SUBSTEP = 0.004
"""Step of the integration (rad of the fastest link); its error is of the order of its fourth power."""
SLIPS = 1e-12
"""Slip, in reaches times rates, that is none."""


@compiled
def to_link(
    hand: CaptureHand, finger: Floats, f: int, j: int, side: float, t: float,
    x: float, y: float, vx: float, vy: float,
) -> tuple[float, float]:  # fmt: skip
    """(foot, its rate) on link j of finger f."""
    ax, ay, ax1, ay1 = joint(hand, finger, j, t)
    angle, rate = turned(finger, j, t)
    c, s = cosine_sine(angle)
    qx, qy = side_of(f) * x - hand.half_palm - ax, y - ay
    vx, vy = side_of(f) * vx - ax1, vy - ay1
    return qx * c + qy * s, vx * c + vy * s + rate * (qy * c - qx * s)


@compiled
def from_link(
    hand: CaptureHand, finger: Floats, f: int, j: int, side: float, t: float, foot: float, foot1: float
) -> tuple[float, float, float, float]:
    """(position, velocity) of the centre that touches link j of finger f with this foot and its rate."""
    ax, ay, ax1, ay1 = joint(hand, finger, j, t)
    angle, rate = turned(finger, j, t)
    c, s = cosine_sine(angle)
    off = side * (hand.radius + hand.half_thickness)
    along, across = foot1 - rate * off, rate * foot
    x, y = ax + foot * c - off * s, ay + foot * s + off * c
    vx, vy = ax1 + along * c - across * s, ay1 + along * s + across * c
    return side_of(f) * (x + hand.half_palm), y, side_of(f) * vx, vy


@inlined
def _forced(hand: CaptureHand, finger: Floats, j: int, t: float) -> tuple[float, float]:
    """The particular solution of s'' = rate^2 s - a''.u, and its rate, for constant rates."""
    angle, rate = turned(finger, j, t)
    foot, foot1 = 0.0, 0.0
    for i in range(j):
        other, slower = turned(finger, i, t)
        apart = rate - slower
        if slower != 0.0:
            size = hand.lengths[i] * slower * slower / (rate * rate + apart * apart)
            foot -= size * cos(angle - other)
            foot1 += size * apart * sin(angle - other)
    return foot, foot1


@compiled
def slide_freely(
    hand: CaptureHand, finger: Floats, j: int, t: float, tau: float, foot: float, foot1: float
) -> tuple[float, float]:
    """(foot, its rate) after ``tau`` without friction, rates constant."""
    _, rate = turned(finger, j, t)
    forced, forced1 = _forced(hand, finger, j, t)
    foot, foot1 = foot - forced, foot1 - forced1
    forced, forced1 = _forced(hand, finger, j, t + tau)
    if rate == 0.0:
        return forced + foot + foot1 * tau, forced1 + foot1
    ch, sh = cosh(rate * tau), sinh(rate * tau)
    return forced + foot * ch + foot1 / rate * sh, forced1 + foot * rate * sh + foot1 * ch


@inlined
def _pulls(
    hand: CaptureHand, finger: Floats, j: int, side: float, friction: float, t: float,
    foot: float, foot1: float, slip: float, none: float,
) -> tuple[float, float, bool]:  # fmt: skip
    """(s'', friction force over mass, whether it rolls)."""
    ax2, ay2 = joint_acceleration(hand, finger, j, t)
    angle, rate = turned(finger, j, t)
    c, s = cosine_sine(angle)
    faster, off = finger[FASTER], hand.radius + hand.half_thickness
    push = side * (ay2 * c - ax2 * s + 2.0 * rate * foot1 + faster * foot) - rate * rate * off
    free = rate * rate * foot - (ax2 * c + ay2 * s)
    most, rolling = friction * max(push, 0.0), -(free + faster * side * hand.half_thickness) / 3.0
    free += faster * side * off
    if abs(slip) <= none and abs(rolling) <= most:
        return free + rolling, rolling, True
    if abs(slip) <= none:
        slip = -rolling
    force = -most if slip > 0.0 else most
    return free + force, force, False


@compiled
def _substep(
    hand: CaptureHand, finger: Floats, j: int, side: float, friction: float, t: float, h: float,
    foot: float, foot1: float, spin: float, slip: float, none: float,
) -> tuple[float, float, float]:  # fmt: skip
    """One step of the fourth order with the direction of friction as at its begin: (foot, its rate, spin)."""
    gain, none = 2.0 * side / hand.radius, none if abs(slip) <= none else -1.0
    a1, f1, _ = _pulls(hand, finger, j, side, friction, t, foot, foot1, slip, none)
    v2 = foot1 + 0.5 * h * a1
    a2, f2, _ = _pulls(hand, finger, j, side, friction, t + 0.5 * h, foot + 0.5 * h * foot1, v2, slip, none)
    v3 = foot1 + 0.5 * h * a2
    a3, f3, _ = _pulls(hand, finger, j, side, friction, t + 0.5 * h, foot + 0.5 * h * v2, v3, slip, none)
    v4 = foot1 + h * a3
    a4, f4, _ = _pulls(hand, finger, j, side, friction, t + h, foot + h * v3, v4, slip, none)
    sixth = h / 6.0
    return (
        foot + sixth * (foot1 + 2.0 * v2 + 2.0 * v3 + v4),
        foot1 + sixth * (a1 + 2.0 * a2 + 2.0 * a3 + a4),
        spin + gain * sixth * (f1 + 2.0 * f2 + 2.0 * f3 + f4),
    )


@inlined
def slip_of(hand: CaptureHand, finger: Floats, j: int, side: float, t: float, foot1: float, spin: float) -> float:
    """Velocity of the rim over link j at the contact, outward along the link; ``spin`` as seen in the finger's frame."""
    return foot1 + side * hand.radius * (spin - turned(finger, j, t)[1])


@compiled
def slide_by_steps(
    hand: CaptureHand, finger: Floats, j: int, side: float, friction: float, t: float, tau: float,
    foot: float, foot1: float, spin: float, fastest: float, reach: float,
) -> tuple[float, float, float]:  # fmt: skip
    """(foot, its rate, spin in the finger's frame) after ``tau``; where slip ends it does so within the step."""
    none, end = SLIPS * reach * fastest, t + tau
    most = SUBSTEP / fastest if fastest > 0.0 else tau
    while t < end:
        h = min(most, end - t)
        slip = slip_of(hand, finger, j, side, t, foot1, spin)
        s, s1, w = _substep(hand, finger, j, side, friction, t, h, foot, foot1, spin, slip, none)
        after = slip_of(hand, finger, j, side, t + h, s1, w)
        if friction > 0.0 and abs(slip) > none and after * slip < 0.0:
            low, high = 0.0, h
            for _ in range(60):
                h = 0.5 * (low + high)
                s, s1, w = _substep(hand, finger, j, side, friction, t, h, foot, foot1, spin, slip, none)
                after = slip_of(hand, finger, j, side, t + h, s1, w)
                low, high = (h, high) if after * slip > 0.0 else (low, h)
        if friction > 0.0 and (abs(slip) > none) == (after * slip <= 0.0) and abs(after) < 1e3 * none:
            w -= side * after / hand.radius  # the slip that rounding left
        foot, foot1, spin, t = s, s1, w, (t + h if t + h > t else end)
    return foot, foot1, spin


@compiled
def pivot_by_steps(
    hand: CaptureHand, finger: Floats, f: int, j: int, t: float, tau: float, fastest: float,
    x: float, y: float, vx: float, vy: float,
) -> tuple[float, float, float, float]:  # fmt: skip
    """(position, velocity) after ``tau`` about link j's distal end, without friction: c phi'' = -b''.t."""
    end, off, mirror = t + tau, hand.radius + hand.half_thickness, side_of(f)
    bx, by, bx1, by1 = joint(hand, finger, j + 1, t)
    nx, ny = mirror * x - hand.half_palm - bx, y - by
    apart = hypot(nx, ny)
    nx, ny = nx / apart, ny / apart
    turn = (nx * (vy - by1) - ny * (mirror * vx - bx1)) / off
    most = SUBSTEP / fastest if fastest > 0.0 else tau
    while t < end:
        h = min(most, end - t)
        angle, k1, k2, k3, k4 = 0.0, 0.0, 0.0, 0.0, 0.0
        for stage in range(4):
            at = 0.0 if stage == 0 else (1.0 if stage == 3 else 0.5)
            angle = h * at * (turn + 0.5 * h * at * (k1 if stage < 3 else k3))
            c, s = cosine_sine(angle)
            ax2, ay2 = joint_acceleration(hand, finger, j + 1, t + at * h)
            k = (ax2 * (nx * s + ny * c) - ay2 * (nx * c - ny * s)) / off
            k1, k2, k3, k4 = (k, k2, k3, k4) if stage == 0 else (
                (k1, k, k3, k4) if stage == 1 else ((k1, k2, k, k4) if stage == 2 else (k1, k2, k3, k))
            )  # fmt: skip
        c, s = cosine_sine(h * (turn + h * (k1 + k2 + k3) / 6.0))
        nx, ny = nx * c - ny * s, nx * s + ny * c
        turn += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0
        t = t + h if t + h > t else end
    bx, by, bx1, by1 = joint(hand, finger, j + 1, end)
    return (
        mirror * (bx + off * nx + hand.half_palm), by + off * ny,
        mirror * (bx1 - off * turn * ny), by1 + off * turn * nx,
    )  # fmt: skip
