"""Why a disk is held or not, in a sentence that names the limit and the distance from it."""

from __future__ import annotations

from math import degrees, isnan, pi, sqrt, tan

from palmar.geometry.straight_finger import last_angle
from palmar.mechanics.closure.sizing import Grip


def disk_reason(plain: Grip, rough: Grip, radius: float) -> str:
    """The verdict on a disk of ``radius`` (m) without friction (``plain``) and with it (``rough``), in words."""
    alone = _sentence(plain, radius)
    if not rough.friction_angle or plain.radii().holds(radius):
        return alone
    if rough.radii().holds(radius):
        return f"{_sentence(rough, radius)}; {_how(plain)} {alone}"
    return f"{_how(rough)} {_sentence(rough, radius)}; and {_how(plain)} {alone}"


def _how(grip: Grip) -> str:
    return f"with friction {tan(grip.friction_angle):.3g}" if grip.friction_angle else "without friction"


def _sentence(grip: Grip, radius: float) -> str:
    radii = grip.radii()
    low, high = float(radii.min), float(radii.max)
    if isnan(high):
        return _no_disk(grip)
    if radius > high:
        return f"too large by {_mm(radius - high)}: {_too_large(grip, radius)}"
    if radius < low:
        return f"too small by {_mm(low - radius)}: {_too_small(grip)}"
    above = f", {_mm(radius - low)} above the smallest" if low > 0.0 else ""
    return f"held {_how(grip)}, {_mm(high - radius)} below the largest{above}"


def _no_disk(grip: Grip) -> str:
    if grip.half_palm <= grip.half_thickness:
        return "no disk can be held: the thick fingers fill the space between their base joints"
    ratio = (grip.half_palm - grip.half_thickness) / grip.finger_length
    if grip.friction_angle and ratio > sqrt(2.0):
        return f"no disk can be held at this friction: half the palm is {ratio:.3g} times the finger's length"
    if ratio > sqrt(2.0):
        return f"no disk can be held: half the palm is {ratio:.3g} times the finger's length, at most 1.414 times works"
    return "no disk can be held: the fingers cannot close far enough"


def _too_large(grip: Grip, radius: float) -> str:
    if grip.friction_angle and grip.psi_limits[0] > 0.5 * pi - grip.friction_angle:
        return "the base joints do not open far enough for the fingertips to reach around it"
    if grip.friction_angle:
        angle = f"{degrees(grip.friction_angle):.3g} deg"
        return f"the fingers meet it more than the friction angle ({angle}) short of its equator and push it out"
    if radius > grip.half_palm - grip.half_thickness:
        return "it is wider than the gap between the finger bases, the fingers lean out on it and push it out"
    return "the fingertips meet it short of its equator and push it out"


def _too_small(grip: Grip) -> str:
    last = last_angle(grip.half_palm, grip.finger_length, grip.half_thickness, grip.crossing, grip.psi_limits[1])
    on_palm = last_angle(grip.half_palm, grip.finger_length, grip.half_thickness, True, pi)
    if float(last) >= float(on_palm) and grip.half_thickness:
        return "the fingertips reach the palm before they reach it"
    if float(last) >= float(on_palm):
        return "the fingertips cannot come close enough together"
    if grip.psi_limits[1] <= float(last):
        return "the base joints reach their limit before the fingers reach it"
    return "the fingertips meet each other before they reach it, it is caged with play"


def _mm(length: float) -> str:
    return f"{float(f'{1e3 * length:.3g}'):g} mm"
