"""What the disk meets at a contact: the normal, the wall's velocity, and how fast it must accelerate to stay there.

Contacts are named by (body, feature, side): body 0 the palm, 1 + j the right finger's link j, 1 + n + j the left one's;
feature SIDE, the straight part on the side (1 or -1) to which its normal (-sin, cos) points or not, END, the round distal
end, or BASE, the round about the base joint, which also stands for the palm's end (body 1 or 1 + n).
"""

from __future__ import annotations

from math import hypot

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled
from palmar.mechanics.impact.finger_motion import (
    FASTER,
    CaptureHand,
    Floats,
    joint,
    joint_acceleration,
    side_of,
    turned,
)

SIDE, END, BASE = 0, 1, 2
PALM = 0


@compiled
def wall_at(
    hand: CaptureHand, fingers: Floats, body: int, feature: int, side: float, t: float, x: float, y: float
) -> tuple[float, float, float, float, float]:
    """(normal (2), velocity of the wall at the contact (2), lever arm of the normal force on the finger about its base).

    The lever arm counts positive where a push on the wall, against the normal, turns the finger towards closing.
    """
    if body == PALM:
        return 0.0, side, 0.0, 0.0, 0.0
    n, h = len(hand.lengths), hand.half_thickness
    f, j = (body - 1) // n, (body - 1) % n
    mirror = side_of(f)
    qx, qy = mirror * x - hand.half_palm, y
    if feature == BASE:
        apart = hypot(qx, qy)
        return mirror * qx / apart, qy / apart, 0.0, 0.0, 0.0
    ax, ay, ax1, ay1 = joint(hand, fingers[f], j, t)
    angle, rate = turned(fingers[f], j, t)
    c, s = cosine_sine(angle)
    if feature == SIDE:
        nx, ny = -side * s, side * c
        foot = (qx - ax) * c + (qy - ay) * s
        rx, ry = foot * c + h * nx, foot * s + h * ny
    else:
        ex, ey = hand.lengths[j] * c, hand.lengths[j] * s
        nx, ny = qx - ax - ex, qy - ay - ey
        apart = hypot(nx, ny)
        nx, ny = nx / apart, ny / apart
        rx, ry = ex + h * nx, ey + h * ny
    arm = -((ax + rx) * ny - (ay + ry) * nx)
    return mirror * nx, ny, mirror * (ax1 - rate * ry), ay1 + rate * rx, arm


@compiled
def gap_at(
    hand: CaptureHand, fingers: Floats, body: int, feature: int, side: float, t: float, x: float, y: float
) -> tuple[float, float]:
    """(distance of the disk from the contact's line or point, foot on the line; 0 for points)."""
    if body == PALM:
        return side * y - hand.radius, x
    n = len(hand.lengths)
    f, j = (body - 1) // n, (body - 1) % n
    qx, qy, off = side_of(f) * x - hand.half_palm, y, hand.radius + hand.half_thickness
    if feature == BASE:
        return hypot(qx, qy) - off, 0.0
    ax, ay, _, _ = joint(hand, fingers[f], j, t)
    angle, _ = turned(fingers[f], j, t)
    c, s = cosine_sine(angle)
    qx, qy = qx - ax, qy - ay
    if feature == SIDE:
        return side * (qy * c - qx * s) - off, qx * c + qy * s
    return hypot(qx - hand.lengths[j] * c, qy - hand.lengths[j] * s) - off, 0.0


@compiled
def demand(
    hand: CaptureHand, fingers: Floats, body: int, feature: int, side: float,
    t: float, x: float, y: float, vx: float, vy: float,
) -> float:  # fmt: skip
    """Acceleration along the normal with which the disk stays on the contact; N / m if that is its only one.

    On a link: n.(q - a) = c, twice differentiated, with n' = -rate u, gives n.a'' - 2 n'.(q' - a') - n''.(q - a).
    For a finger that turns about its base: 2 rate r' - rate^2 c. On a point b: n.b'' - |tangential velocity|^2 / |q - b|.
    """
    if body == PALM:
        return 0.0
    n = len(hand.lengths)
    f, j = (body - 1) // n, (body - 1) % n
    mirror = side_of(f)
    qx, qy, vx = mirror * x - hand.half_palm, y, mirror * vx
    if feature == BASE:
        across = qx * vy - qy * vx
        return -across * across / (qx * qx + qy * qy) ** 1.5
    ax, ay, ax1, ay1 = joint(hand, fingers[f], j, t)
    angle, rate = turned(fingers[f], j, t)
    c, s = cosine_sine(angle)
    qx, qy, vx, vy = qx - ax, qy - ay, vx - ax1, vy - ay1
    if feature == SIDE:
        ax2, ay2 = joint_acceleration(hand, fingers[f], j, t)
        along, off, foot = vx * c + vy * s, qy * c - qx * s, qx * c + qy * s
        return side * (ay2 * c - ax2 * s + 2.0 * rate * along + rate * rate * off + fingers[f, FASTER] * foot)
    bx2, by2 = joint_acceleration(hand, fingers[f], j + 1, t)
    ex, ey = hand.lengths[j] * c, hand.lengths[j] * s
    qx, qy, vx, vy = qx - ex, qy - ey, vx + rate * ey, vy - rate * ex
    apart, across = hypot(qx, qy), qx * vy - qy * vx
    return (qx * bx2 + qy * by2) / apart - across * across / apart**3
