"""The preshape with which a disk rides on the distal link without rolling (section 5.2.1 of the source).

The distal joint is kept at the angle delta and the whole finger turns about its base, here the origin, with the proximal
link along x. The disk touches the distal link at X from its joint and turns about the base as if fixed to the finger. Its
centre is (L cos delta + X) along the link and R + h - L sin delta across it, at the distance H from the base, h the half
thickness of the finger. The friction overcome on the table is a force across the ray from the base to the pressure's
centre and a moment; with the moment M about the contact zero the disk does not roll. For a pressure that is alike all
round, with T(H) / F(H) the moment over the force of the limit surface, 5.3 to 5.8 come down to

    L sin(delta) - R - h = (H / R) T / F,        for H >> R:  sin(delta) = (R + h + s^2 / R) / L,

s^2 half the mean square of the distance under the pressure: R^2 / 4 for a uniform one, R^2 / 2 for a thin ring. A larger
angle rolls the disk in, towards the palm, a smaller one out. The scan of 5.3 and 5.7 mixes sin(theta + delta) with
cos(theta - delta); see docs/derivations/preshape.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, sin

from scipy.optimize import brentq

from palmar.mechanics.pushing.limit_surface import LimitSurface, wrench

CLOSE = 1e-13


@dataclass(frozen=True)
class RidingFinger:
    """Length L of the proximal link and half thickness h (m)."""

    proximal: float
    half_thickness: float = 0.0


@dataclass(frozen=True)
class RidingDisk:
    """Radius R (m), limit surface about its pressure's centre, and where that lies from the disk's centre (m).

    The offset and the surface are in axes along the ray from the base to the disk's centre, and across it.
    """

    radius: float
    surface: LimitSurface
    offset: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True)
class Ride:
    """At a distal angle (rad): the moment (m) about the contact that turns the disk, per friction force, and the friction.

    ``moment`` > 0 rolls the disk in. ``friction``: coefficient that keeps it from slipping on the link. ``arm``: distance
    H (m) of its centre from the base joint.
    """

    angle: float
    moment: float
    friction: float
    arm: float


def ride(finger: RidingFinger, disk: RidingDisk, along: float, angle: float) -> Ride:
    """The disk that touches the distal link at ``along`` (m) from its joint, which is at ``angle`` (rad)."""
    x = finger.proximal * cos(angle) + along
    y = disk.radius + finger.half_thickness - finger.proximal * sin(angle)
    arm = hypot(x, y)
    u = x / arm, y / arm  # of the ray, in axes along the distal link and across it, towards the disk
    px, py = disk.offset
    fx, fy, turning = wrench(disk.surface, -py, arm + px, 1.0)
    # About the contact, at -R n from the centre, with n = (0, 1) along the link turned into the ray's axes.
    nx, ny = u[1], u[0]
    cx, cy = -disk.radius * nx, -disk.radius * ny
    about = (px - cx) * fy - (py - cy) * fx + turning
    along_n, across_n = fx * nx + fy * ny, -fx * ny + fy * nx
    friction = abs(across_n) / along_n if along_n > 0.0 else float("inf")
    return Ride(angle, -about / hypot(fx, fy), friction, arm)


def preshape(finger: RidingFinger, disk: RidingDisk, along: float) -> Ride | None:
    """The ride without rolling, at the least angle between 0 and 90 degrees; None if every angle rolls the disk out.

    0 where even the straight finger rolls it in, which takes a pressure centre far off.
    """
    if ride(finger, disk, along, 0.5 * pi).moment <= 0.0:
        return None
    if ride(finger, disk, along, 0.0).moment >= 0.0:
        return ride(finger, disk, along, 0.0)
    angle = brentq(lambda each: ride(finger, disk, along, each).moment, 0.0, 0.5 * pi, xtol=CLOSE)
    return ride(finger, disk, along, float(angle))


def disc_radius(proximal: float, distal: float, angle: float) -> float:
    """Of the disc about the base joint that the source takes for the contact region: to the tip of the bent finger (m)."""
    return hypot(proximal + distal * cos(angle), distal * sin(angle))
