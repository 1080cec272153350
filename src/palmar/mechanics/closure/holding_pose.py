"""Where the fingers stand, and how high the disk lies, when a 2-jointed hand holds it.

Both fingers stand at the same angle psi, the disk's centre at (0, y), y >= R. Notation as in disk_2_2: rho = R + h is
the distance of a touching finger's joint line from the centre, e the contact's elevation above the disk's equator.
A disk is held on the palm with e >= 0 without friction and e >= -alpha with it, off the palm with |e| <= alpha.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import acos, asin, atan2, cos, hypot, pi, sin, sqrt

from palmar.geometry.straight_finger import last_angle
from palmar.mechanics.closure.sizing import Grip

ROUNDING = 1e-9
"""A limit counts as met within this angle (rad), or this share of the hand's size."""


@dataclass(frozen=True)
class Pose:
    """Fingers at ``psi`` (rad) touching a disk with its centre at (0, ``height``) (m), ``elevation`` e (rad)."""

    psi: float
    height: float
    elevation: float
    on_palm: bool


def holding_pose(grip: Grip, radius: float) -> Pose | None:
    """The pose in which the disk (radius in m) is held, None where it is not.

    On the palm where that holds it (only there without friction); else off the palm, between the two fingers, in the
    pose that asks for the least friction.
    """
    alpha = grip.friction_angle or 0.0
    palm = touching_pose(grip, radius, radius)
    if palm is not None and palm.elevation >= -alpha - ROUNDING and _reached(grip, palm.psi):
        return palm
    if alpha == 0.0:
        return None
    pinches = (touching_pose(grip, radius, height) for height in _pinching_heights(grip, radius))
    held = [each for each in pinches if each and abs(each.elevation) <= alpha + ROUNDING and _reached(grip, each.psi)]
    return min(held, key=lambda each: abs(each.elevation), default=None)


def touching_pose(grip: Grip, radius: float, height: float) -> Pose | None:
    """The fingers where they first touch, closing, a disk with its centre at (0, height); None where they never do.

    The distance of the centre from the finger falls until the finger points at the centre, at distance q of the base.
    Its angle from there is asin(rho / q) where it touches with its side, and by the law of cosines with its tip.
    Joint limits and the other finger are left out of account.
    """
    d, length, rho = grip.half_palm, grip.finger_length, radius + grip.half_thickness
    q = hypot(d, height)
    if not rho < q <= (length + rho) * (1.0 + ROUNDING):
        return None
    foot = sqrt((q - rho) * (q + rho))
    if foot <= length:
        psi = pi - atan2(height, d) - asin(rho / q)
        elevation = psi - 0.5 * pi
    else:
        aside = acos(min((length**2 + q**2 - rho**2) / (2.0 * length * q), 1.0))
        psi = pi - atan2(height, d) - aside
        elevation = atan2(length * sin(psi) - height, d + length * cos(psi))
    if psi < -ROUNDING:
        return None
    return Pose(max(psi, 0.0), height, elevation, height == radius)


def _pinching_heights(grip: Grip, radius: float) -> Iterator[float]:
    """Heights above the palm between which |e| of the touching fingers has no further least value.

    e rises or falls with the height on either side of the height at which the contact passes from the finger's side to
    its tip; besides its zero at the tip, the least |e| lies there or where the fingers reach a limit.
    """
    d, length, rho = grip.half_palm, grip.finger_length, radius + grip.half_thickness
    squares = (length**2 + rho**2 - d**2, length**2 - (rho - d) ** 2)
    heights = [sqrt(square) for square in squares if square > 0.0]
    for psi in (grip.psi_limits[0], _last(grip)):
        x, y = d + length * cos(psi), length * sin(psi)
        if abs(x) <= rho:
            drop = sqrt(rho**2 - x**2)
            heights += [y - drop, y + drop]
        if abs(cos(psi)) > ROUNDING:
            heights.append((rho - d * sin(psi)) / cos(psi))
    yield from (height for height in heights if height > radius)


def _reached(grip: Grip, psi: float) -> bool:
    return grip.psi_limits[0] - ROUNDING <= psi <= _last(grip) + ROUNDING


def _last(grip: Grip) -> float:
    return float(last_angle(grip.half_palm, grip.finger_length, grip.half_thickness, grip.crossing, grip.psi_limits[1]))
