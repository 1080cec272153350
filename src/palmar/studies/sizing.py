"""The inverse of closure: the palm width or finger length that holds a range of radii, or why none does."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf

from palmar.mechanics.closure.sizing import Dimension, Grip, sufficient


@dataclass(frozen=True)
class Sizing:
    """What was asked (SI), the intervals of the sought dimension that suffice (m, palm as full width), and words."""

    sought: Dimension
    radius_min: float
    radius_max: float
    intervals: tuple[tuple[float, float], ...]
    reason: str


def size_hand(
    radius_min: float,
    radius_max: float,
    palm_width: float | None,
    finger_length: float | None,
    friction_angle: float,
    finger_thickness: float,
    *,
    crossing: bool,
) -> Sizing:
    """Exactly one of palm width and finger length (m) is None: the one sought. Friction angle 0 = structural hold."""
    sought = Dimension.HALF_PALM if palm_width is None else Dimension.FINGER_LENGTH
    grip = Grip(
        half_palm=0.5 * palm_width if palm_width is not None else 0.0,
        finger_length=finger_length if finger_length is not None else 0.0,
        half_thickness=0.5 * finger_thickness,
        friction_angle=friction_angle or None,
        crossing=crossing,
    )
    scale = 2.0 if sought is Dimension.HALF_PALM else 1.0
    found = sufficient(grip, sought, radius_min, radius_max)
    intervals = tuple(_scaled(found, scale))
    reason = "" if found else _why_none(grip, sought, radius_min, radius_max, scale)
    return Sizing(sought, radius_min, radius_max, intervals, reason)


def _why_none(grip: Grip, sought: Dimension, radius_min: float, radius_max: float, scale: float) -> str:
    """Which end of the range of radii no value serves, or what the two ends ask for."""
    what = "palm width" if sought is Dimension.HALF_PALM else "finger length"
    for name, radius in (("largest", radius_max), ("smallest", radius_min)):
        if not sufficient(grip, sought, radius, radius):
            return f"no {what} holds the {name} radius, {1e3 * radius:.4g} mm: {_limit(grip, sought)}"
    ends = [
        f"radius {1e3 * radius:.4g} mm needs {interval_words(_scaled(sufficient(grip, sought, radius, radius), scale))}"
        for radius in (radius_min, radius_max)
    ]
    return f"no {what} serves both ends: {ends[0]}, {ends[1]}"


def _limit(grip: Grip, sought: Dimension) -> str:
    if sought is Dimension.FINGER_LENGTH:
        inner = grip.half_palm - grip.half_thickness
        if grip.friction_angle:
            return "the fingers, however long, do not bring it into the friction cones"
        return f"without friction it must fit between the finger bases, at most {1e3 * inner:.4g} mm for this palm"
    return f"the finger, {1e3 * grip.finger_length:.4g} mm, is too short to reach its equator at any palm width"


def _scaled(intervals: Iterable[tuple[float, float]], scale: float) -> list[tuple[float, float]]:
    return [(scale * low, scale * high) for low, high in intervals]


def interval_words(intervals: Iterable[tuple[float, float]]) -> str:
    """Intervals (m) in words, in mm; 0 and inf are no ends."""
    return " or ".join(_interval(1e3 * low, 1e3 * high) for low, high in intervals)


def _interval(low: float, high: float) -> str:
    if high == inf:
        return f"at least {low:.6g} mm" if low > 0.0 else "any size"
    return f"{low:.6g} to {high:.6g} mm" if low > 0.0 else f"at most {high:.6g} mm"
