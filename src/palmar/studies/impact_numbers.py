"""The numbers of section 4.3.2 for a case: how hard a finger strikes the object, and what would soften that.

The finger on the object's side meets it, at the case's start, where its side first touches: at the foot X from the base
joint. Disks only; the finger is a uniform rod, or heavy without a mass.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import asin, atan2, hypot, inf, sqrt

from palmar.errors import InputError, NotCoveredError
from palmar.mechanics.impact.collision import rod_inertia
from palmar.mechanics.impact.impact_force_4_3_2 import (
    compression,
    contact_duration,
    damping_ratio_for,
    effective_mass,
    pad_stiffness,
    peak_force,
    restitution,
    stiffness_for,
)
from palmar.mechanics.impact.touch_down_4_3_2 import touch_down
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.studies.softening import Feedback, LetGo, Paddle, feedback, letting_go, paddle

ROUNDING = 1e-15
"""A damping ratio below this is none."""


@dataclass(frozen=True)
class Asked:
    """Approach speed (m/s; None: the finger's at its rate), stiffness (N/m) of the contact, damping ratio (None: that of
    the case's restitution), force limit (N), torque limit of the finger (N m; None: the case's), lag of a force-controlled
    drive (s) and its force gain; threshold (N) and delay (s) of a drive that lets go; share of its speed at which a paddle
    returns the object, stroke (m) to stop it, acceleration of the arm (m/s^2).
    """

    speed: float | None = None
    stiffness: float | None = None
    damping: float | None = None
    force_limit: float | None = None
    torque: float | None = None
    lag: float | None = None
    gain: float | None = None
    trigger: tuple[float, float] | None = None
    returned: float | None = None
    stroke: float | None = None
    acceleration: float | None = None


@dataclass(frozen=True)
class Softness:
    """Of a contact of ``stiffness`` (N/m): peak force (N), duration (s), greatest compression (m)."""

    stiffness: float
    peak: float
    duration: float
    compression: float


@dataclass(frozen=True)
class BangBang:
    """Base angle (rad) and time (s) of the torque's reversal, time of the touch (s), speed there (m/s)."""

    switch_angle: float
    switch_time: float
    time: float
    speed: float


@dataclass(frozen=True)
class ImpactNumbers:
    """``foot`` (m) and base ``angle`` (rad) of the touch, approach ``speed`` (m/s), reduced ``mass`` (kg), damping ratio and
    the restitution that it gives; and what was asked for. ``pad`` (N/m): inf where none is needed, None without a contact.
    """

    foot: float
    angle: float
    speed: float
    mass: float
    damping: float
    restitution: float
    contact: Softness | None = None
    softest: Softness | None = None
    pad: float | None = None
    touch_down: BangBang | None = None
    feedback: Feedback | None = None
    let_go: LetGo | None = None
    paddle: Paddle | None = None


def told_by(case: Case, asked: Asked) -> Asked:
    """With the stiffness of the case's contact and the lag of its drive, where they are not given and the case has them."""
    stiffness = case.contact.stiffness if asked.stiffness is None else asked.stiffness
    lag = asked.lag
    if lag is None and case.hand.drive_lag > 0.0 and case.hand.finger_mass is not None and stiffness is not None:
        lag = case.hand.drive_lag
    return replace(asked, stiffness=stiffness, lag=lag)


def impact_numbers(case: Case, asked: Asked) -> ImpactNumbers:
    """Work out what is asked; raises InputError where something that it needs is missing, NotCoveredError for polygons."""
    if not isinstance(case.object, Disk):
        raise NotCoveredError('object.shape = "polygon": impacts are worked out for disks')
    angle, foot = _touch(case, case.object.radius)
    speed = case.hand.finger_rate * foot if asked.speed is None else asked.speed
    inertia = inf if case.hand.finger_mass is None else rod_inertia(case.hand.finger_mass, case.hand.finger_length)
    mass, zeta = float(effective_mass(case.object.mass, foot, inertia)), _damping(case, asked)
    contact = None if asked.stiffness is None else _softness(mass, speed, asked.stiffness, zeta)
    softest, pad = None, None
    if asked.force_limit is not None:
        whole = float(stiffness_for(asked.force_limit, mass, speed, zeta))
        softest = _softness(mass, speed, whole, zeta)
        pad = None if asked.stiffness is None else float(pad_stiffness(whole, asked.stiffness))
    return ImpactNumbers(
        foot, angle, speed, mass, zeta, float(restitution(zeta)), contact, softest, pad,
        _bang_bang(case, asked, angle, foot, speed, inertia), _feedback(asked, mass, foot, zeta, inertia),
        _letting_go(case, asked, mass, speed), _paddle(case, asked),
    )  # fmt: skip


def _touch(case: Case, radius: float) -> tuple[float, float]:
    """(base angle, foot) where the side of the straight finger meets the disk at the case's start."""
    hand, (x, y) = case.hand, case.start.at
    qx, off = abs(x) - hand.half_palm, radius + hand.half_thickness
    apart = hypot(qx, y)
    if apart > off:
        angle, foot = atan2(y, qx) - asin(off / apart), sqrt(apart * apart - off * off)
        if foot <= hand.finger_length and angle >= hand.open:
            return angle, foot
    raise NotCoveredError("no finger meets the object at the case's start with its side")


def _damping(case: Case, asked: Asked) -> float:
    if asked.damping is not None:
        return asked.damping
    zeta = float(damping_ratio_for(case.contact.restitution))
    if zeta == inf:
        raise InputError(
            "--damping", None, "must be given where the case's restitution is 0: no finite damping has that"
        )
    return zeta if zeta > ROUNDING else 0.0


def _softness(mass: float, speed: float, stiffness: float, zeta: float) -> Softness:
    return Softness(
        stiffness, float(peak_force(mass, speed, stiffness, zeta)), float(contact_duration(mass, stiffness, zeta)),
        float(compression(mass, speed, stiffness, zeta)),
    )  # fmt: skip


def _bang_bang(case: Case, asked: Asked, angle: float, foot: float, speed: float, inertia: float) -> BangBang | None:
    """From rest at the open angle."""
    torque = case.hand.finger_torque if asked.torque is None else asked.torque
    if torque is None:
        return None
    if inertia == inf:
        raise InputError("--torque", None, "needs the finger's mass: hand.finger_mass_kg")
    found = touch_down(angle - case.hand.open, speed / foot, torque, inertia)
    return BangBang(
        case.hand.open + float(found.switch_angle), float(found.switch_time), float(found.time),
        float(found.arrival) * foot,
    )  # fmt: skip


def _feedback(asked: Asked, mass: float, foot: float, zeta: float, inertia: float) -> Feedback | None:
    """Of the finger's mass at the foot, with the stiffness and the damper of the contact."""
    if asked.lag is None:
        if asked.gain is not None:
            raise InputError("--gain", None, "needs --lag, of the drive that the force is fed back to")
        return None
    if inertia == inf or asked.stiffness is None:
        raise InputError("--lag", None, "needs --stiffness and the finger's mass: hand.finger_mass_kg")
    damper = 2.0 * zeta * sqrt(asked.stiffness * mass)
    return feedback(inertia / foot**2, damper, asked.stiffness, asked.lag, asked.gain)


def _letting_go(case: Case, asked: Asked, mass: float, speed: float) -> LetGo | None:
    """The finger is driven until it is let go, and then has its own mass only."""
    if asked.trigger is None:
        return None
    if case.hand.finger_mass is None or asked.stiffness is None:
        raise InputError("--trigger", None, "needs --stiffness and the finger's mass: hand.finger_mass_kg")
    return letting_go(case.object.mass, mass, speed, asked.stiffness, *asked.trigger)


def _paddle(case: Case, asked: Asked) -> Paddle | None:
    """Of the object's speed: the one given, else that of the case's start."""
    if asked.returned is None:
        if asked.stroke is not None or asked.acceleration is not None:
            raise InputError(
                "--returned", None, "is needed beside --stroke and --acceleration; 0 stops the object dead"
            )
        return None
    speed = hypot(*case.start.velocity) if asked.speed is None else asked.speed
    if speed == 0.0:
        raise InputError("--speed", None, "must be given for --returned where the case's object starts at rest")
    return paddle(
        case.object.mass, speed, case.contact.restitution, asked.returned, asked.stroke, asked.acceleration
    )  # fmt: skip
