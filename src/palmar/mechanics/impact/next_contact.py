"""The next contact of a disk in free flight with any body of the hand, found so that none is skipped.

A gap g with g'' >= -A stays above g + g' tau - A tau^2 / 2, so up to that parabola's root nothing touches; stepping from
root to root ends at the gap's own root, from below and in the end as fast as Newton's method. For the side of a link,
w = n.(q - a): w'' = -n.a'' - 2 rate u.(q' - a') - rate^2 w - acceleration u.(q - a). For a point b the distance is convex
but for the point's own acceleration: its second derivative is at least -|b''|. Palm and base joints rest: closed forms.
A root of a side whose foot lies off the link is no contact; the disk may come back to the line from the slab about it.
"""

from __future__ import annotations

from math import inf, sqrt

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.impact.contact_view import BASE, END, PALM, SIDE
from palmar.mechanics.impact.finger_motion import (
    FASTER,
    RATE,
    CaptureHand,
    Floats,
    joint,
    joint_bounds,
    moves,
    side_of,
    turned,
)
from palmar.mechanics.impact.segments import length_of

TOUCH = 1e-14
"""Gap, in reaches, that counts as a root; what is left is taken out by one step of Newton's method."""
SKIN = 1e-10
"""Overlap, in reaches, that is still a touch."""
GRAZE = 1e-13
"""Part of the speed at which a wall that touches is approached by rounding only."""
MOST_STEPS = 400
NOTHING, UNSURE = -1, -2
"""Instead of a body: no contact; none before the time returned, from which the search must go on."""


@inlined
def parabola_root(gap: float, rate: float, bound: float) -> float:
    """First positive root of gap + rate tau - bound tau^2 / 2; inf without."""
    if bound == 0.0:
        return -gap / rate if rate < 0.0 else inf
    root = sqrt(rate * rate + 2.0 * bound * gap)
    return 2.0 * gap / (root - rate) if rate < 0.0 else (rate + root) / bound


@inlined
def circle_times(qx: float, qy: float, vx: float, vy: float, radius: float) -> tuple[float, float]:
    """Times at which q + v tau enters and leaves the circle about 0; (inf, -inf) if never."""
    a, b, c = vx * vx + vy * vy, qx * vx + qy * vy, qx * qx + qy * qy - radius * radius
    if a == 0.0:
        return (-inf, inf) if c <= 0.0 else (inf, -inf)
    d = b * b - a * c
    if d < 0.0:
        return inf, -inf
    root = sqrt(d)
    far = -b - root if b > 0.0 else root - b
    if far == 0.0:
        return 0.0, 0.0
    return (far / a, c / far) if b > 0.0 else (c / far, far / a)


@inlined
def side_view(
    hand: CaptureHand, finger: Floats, j: int, t: float, qx: float, qy: float, vx: float, vy: float
) -> tuple[float, float, float]:
    """(distance w of (qx, qy) along the normal of link j's line, w', foot along the link), in the finger's frame."""
    ax, ay, ax1, ay1 = joint(hand, finger, j, t)
    angle, rate = turned(finger, j, t)
    c, s = cosine_sine(angle)
    qx, qy = qx - ax, qy - ay
    foot = qx * c + qy * s
    return qy * c - qx * s, (vy - ay1) * c - (vx - ax1) * s - rate * foot, foot


@inlined
def end_view(
    hand: CaptureHand, finger: Floats, j: int, t: float, qx: float, qy: float, vx: float, vy: float
) -> tuple[float, float]:
    """(distance of (qx, qy) from link j's distal end, its rate)."""
    bx, by, bx1, by1 = joint(hand, finger, j + 1, t)
    qx, qy = qx - bx, qy - by
    apart = length_of(qx, qy)
    return apart, (qx * (vx - bx1) + qy * (vy - by1)) / apart


@inlined
def side_bound(hand: CaptureHand, finger: Floats, j: int, until: float, far: float, speed: float) -> float:
    """A for the side of link j until ``until`` (s from ``since``) within the distance ``far`` of the base joint."""
    joint_speed, acceleration = joint_bounds(hand, finger, j, until)
    rate = max(abs(finger[RATE + j]), abs(finger[RATE + j] + finger[FASTER] * until))
    for i in range(j):
        far += hand.lengths[i]
    return acceleration + 2.0 * rate * (speed + joint_speed) + (rate * rate + abs(finger[FASTER])) * far


@compiled
def _side_contact(
    hand: CaptureHand, finger: Floats, j: int, t: float, qx: float, qy: float, vx: float, vy: float,
    low: float, high: float, bound: float, small: float,
) -> tuple[float, int]:  # fmt: skip
    """(time from t, side) of the first contact with link j's side within (low, high); (inf, 0) none, (time, 0) unsure."""
    off, tau, side = hand.radius + hand.half_thickness, low, 2
    for _ in range(MOST_STEPS):
        w, w1, foot = side_view(hand, finger, j, t + tau, qx + vx * tau, qy + vy * tau, vx, vy)
        if side == 2:
            side = 1 if w >= off - SKIN / TOUCH * small else (-1 if w <= SKIN / TOUCH * small - off else 0)
        if side == 0 and off - abs(w) <= small and w * w1 > 0.0:
            side = 1 if w > 0.0 else -1
        if side != 0:
            gap, rate = side * w - off, side * w1
            if gap <= small:
                if rate < 0.0 and 0.0 <= foot <= hand.lengths[j]:
                    return tau + max(gap, 0.0) / -rate, side
                if rate < 0.0:
                    side = 0
                gap = max(gap, small)
        if side != 0:
            tau += parabola_root(gap, rate, bound)
        else:
            tau += min(
                parabola_root(max(off - w, small), -w1, bound), parabola_root(max(off + w, small), w1, bound)
            )  # fmt: skip
        if not tau < high:
            return inf, 0
    return tau, 0


@compiled
def _end_contact(
    hand: CaptureHand, finger: Floats, j: int, t: float, qx: float, qy: float, vx: float, vy: float,
    low: float, high: float, bound: float, small: float,
) -> tuple[float, bool]:  # fmt: skip
    """(time from t, sure) of the first contact with link j's distal end within (low, high); (inf, True) none."""
    off, tau = hand.radius + hand.half_thickness, low
    for _ in range(MOST_STEPS):
        apart, rate = end_view(hand, finger, j, t + tau, qx + vx * tau, qy + vy * tau, vx, vy)
        gap = apart - off
        if gap <= small:
            if rate < 0.0:
                return tau + max(gap, 0.0) / -rate, True
            gap = small
        tau += parabola_root(gap, rate, bound)
        if not tau < high:
            return inf, True
    return tau, False


@inlined
def _still_contact(
    hand: CaptureHand, x: float, y: float, vx: float, vy: float, high: float, skin: float
) -> tuple[float, int, int, int]:  # fmt: skip
    """(time, body, feature, side) of the first contact with the palm or about a base joint before ``high``."""
    best, body, feature, side = high, NOTHING, SIDE, 1
    up = 1.0 if y > 0.0 else -1.0
    if up * vy < 0.0:
        tau = max((up * y - hand.radius) / (-up * vy), 0.0)
        if tau < best and up * y >= hand.radius - skin and abs(x + vx * tau) <= hand.half_palm:
            best, body, side = tau, PALM, int(up)
    off = hand.radius + hand.half_thickness
    for f in range(2):
        qx = side_of(f) * x - hand.half_palm
        if qx * side_of(f) * vx + y * vy < 0.0:
            enter, _ = circle_times(qx, y, side_of(f) * vx, vy, off)
            enter = max(enter, 0.0)
            along = enter == 0.0 and qx * side_of(f) * vx + y * vy > -GRAZE * off * length_of(vx, vy)
            if enter < best and not along:
                best, body, feature, side = enter, 1 + f * len(hand.lengths), BASE, 1
    return best, body, feature, side


@compiled
def next_contact(
    hand: CaptureHand, fingers: Floats, t: float, x: float, y: float, vx: float, vy: float, horizon: float,
    reach: float, left_body: int, left_other: int, left_until: float,
) -> tuple[float, int, int, int]:  # fmt: skip
    """(time from t, body, feature, side) of the first contact within ``horizon``; body NOTHING or UNSURE instead.

    The bodies ``left_body`` and ``left_other`` are known not to touch again before ``left_until`` (s from t): they were
    just left without speed.
    """
    best, body, feature, side = _still_contact(hand, x, y, vx, vy, horizon, SKIN * reach)
    n, small, speed = len(hand.lengths), TOUCH * reach, length_of(vx, vy)
    within = hand.lengths.sum() + hand.radius + hand.half_thickness
    for f in range(2):
        finger, turning = fingers[f], moves(hand, fingers[f])
        if speed == 0.0 and not turning:
            continue
        qx, ux = side_of(f) * x - hand.half_palm, side_of(f) * vx
        enter, leave = circle_times(qx, y, ux, vy, within)
        enter = max(enter, 0.0)
        if enter >= min(leave, best):
            continue
        for j in range(n):
            b = 1 + f * n + j
            left = b in (left_body, left_other)
            low, high = max(enter, left_until) if left else enter, min(leave, best)
            if low >= high:
                continue
            until, bound = t + high - finger[0], 0.0
            if turning:
                far = max(length_of(qx + ux * low, y + vy * low), length_of(qx + ux * high, y + vy * high))
                bound = side_bound(hand, finger, j, until, far, speed)
            tau, which = _side_contact(hand, finger, j, t, qx, y, ux, vy, low, high, bound, small)
            if tau < best:
                best, body, feature, side = tau, b if which != 0 else UNSURE, SIDE, which
            high = min(leave, best)
            bound = joint_bounds(hand, finger, j + 1, until)[1] if turning else 0.0
            tau, sure = _end_contact(hand, finger, j, t, qx, y, ux, vy, low, high, bound, small)
            if tau < best:
                best, body, feature, side = tau, b if sure else UNSURE, END, 1
    return best, body, feature, side
