"""Can this hand hold it: the radii it holds, the verdict on the object, and what to change."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import cos, isnan, tan
from typing import TYPE_CHECKING

from palmar.mechanics.closure.disk_2_2 import Radii
from palmar.mechanics.closure.sizing import Dimension, Grip, slopes, sufficient
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.studies.closure_reason import disk_reason

if TYPE_CHECKING:
    from palmar.studies.closure_polygon import PolygonClosure


@dataclass(frozen=True)
class RadiusRange:
    """Radii (m) that are held; the limits are suprema and count as held."""

    radius_min: float
    radius_max: float


@dataclass(frozen=True)
class Verdict:
    """Whether the case's object is held; a polygon counts as held if it is at every orientation."""

    structural: bool
    frictional: bool
    reason: str


@dataclass(frozen=True)
class Change:
    """The smallest change of one dimension alone that makes the disk held: ``now`` and ``to`` in m, or as friction.

    A number stands for the length of that link, counted from the palm.
    """

    closure: Closure
    dimension: Dimension | int
    now: float
    to: float


@dataclass(frozen=True)
class Slope:
    """How a limit moves with one dimension: m per m, or m per unit of friction; on decreasing and on increasing it."""

    closure: Closure
    dimension: Dimension | int
    radius_min: tuple[float, float]
    radius_max: tuple[float, float]


@dataclass(frozen=True)
class ClosureAnswer:
    """Everything `palmar closure` reports. None where no radius is held."""

    structural: RadiusRange | None
    frictional: RadiusRange | None
    object: Verdict
    changes: tuple[Change, ...]
    slopes: tuple[Slope, ...]
    polygon: PolygonClosure | None
    notes: tuple[str, ...]


def grip_of(hand: Hand, friction_angle: float | None) -> Grip:
    """The closed hand with straight fingers; ``friction_angle`` None for structural closure."""
    return Grip(
        hand.half_palm,
        hand.finger_length,
        hand.half_thickness,
        friction_angle,
        hand.fingers is Fingers.CROSSING,
        hand.base_limits,
    )


def closure_answer(case: Case) -> ClosureAnswer:
    """The answer for a case; with ranges in it, what holds at every combination of their ends.

    The ends suffice for a disk and crossing fingers: for a given radius the hand dimensions that hold it form a convex
    set, and a larger friction angle only adds to it.
    """
    found = closure_verdict(case)
    changes = () if case.ranges else tuple(_changes(case, found.object))
    return replace(found, changes=changes, slopes=tuple(_slopes(case)))


def closure_verdict(case: Case) -> ClosureAnswer:
    """``closure_answer`` without changes and slopes, which take longer."""
    corners = [_corner(each) for each in case.corners()]
    nominal = corners[0] if len(corners) == 1 else _corner(case.model_copy(update={"ranges": ()}))
    return ClosureAnswer(
        structural=_common([each.structural for each in corners]),
        frictional=_common([each.frictional for each in corners]),
        object=_joined(corners, nominal),
        changes=(),
        slopes=(),
        polygon=nominal.polygon,
        notes=tuple(_notes(case)),
    )


@dataclass(frozen=True)
class _Corner:
    structural: RadiusRange | None
    frictional: RadiusRange | None
    verdict: Verdict
    polygon: PolygonClosure | None


def _corner(case: Case) -> _Corner:
    plain, rough = grip_of(case.hand, None), grip_of(case.hand, case.contact.friction_angle)
    structural, frictional = _range(plain.radii()), _range(rough.radii())
    if isinstance(case.object, ConvexPolygon):
        from palmar.studies.closure_polygon import polygon_closure

        polygon = polygon_closure(case, plain.radii(), rough.radii())
        verdict = Verdict(polygon.structural.every, polygon.frictional.every, polygon.reason)
        return _Corner(structural, frictional, verdict, polygon)
    radius = case.object.radius
    holds = [bool(each.radii().holds(radius)) for each in (plain, rough)]
    return _Corner(structural, frictional, Verdict(holds[0], holds[1], disk_reason(plain, rough, radius)), None)


def _range(radii: Radii) -> RadiusRange | None:
    low, high = float(radii.min), float(radii.max)
    return None if isnan(high) else RadiusRange(low, high)


def _common(ranges: list[RadiusRange | None]) -> RadiusRange | None:
    """Radii held in every one of the ranges."""
    known = [each for each in ranges if each is not None]
    if len(known) < len(ranges):
        return None
    low, high = max(each.radius_min for each in known), min(each.radius_max for each in known)
    return RadiusRange(low, high) if low <= high else None


def _joined(corners: list[_Corner], nominal: _Corner) -> Verdict:
    structural = all(each.verdict.structural for each in corners)
    frictional = all(each.verdict.frictional for each in corners)
    if len(corners) == 1:
        return nominal.verdict
    worst = min(corners, key=lambda each: (each.verdict.frictional, each.verdict.structural))
    return Verdict(structural, frictional, f"at the worst end of the ranges: {worst.verdict.reason}")


def _changes(case: Case, verdict: Verdict) -> Iterator[Change]:
    """For each closure that fails, the nearest sufficient value of each dimension by itself."""
    if not isinstance(case.object, Disk):
        return
    radius = case.object.radius
    for closure, held in ((Closure.STRUCTURAL, verdict.structural), (Closure.FRICTIONAL, verdict.frictional)):
        alpha = case.contact.friction_angle if closure is Closure.FRICTIONAL else None
        grip = grip_of(case.hand, alpha)
        for dimension in Dimension if not held else ():
            if dimension is Dimension.FRICTION_ANGLE and alpha is None:
                continue
            now = getattr(grip, dimension.value)
            ends = [end for interval in sufficient(grip, dimension, radius, radius) for end in interval]
            if ends:
                to = min(ends, key=lambda end: abs(end - now))
                yield Change(closure, dimension, _shown(dimension, now), _shown(dimension, to))


def _slopes(case: Case) -> Iterator[Slope]:
    alpha = case.contact.friction_angle
    for closure, angle in ((Closure.STRUCTURAL, None), (Closure.FRICTIONAL, alpha)):
        grip = grip_of(case.hand, angle)
        if isnan(float(grip.radii().max)):
            continue
        for dimension in Dimension:
            if dimension is Dimension.FRICTION_ANGLE and not angle:
                continue
            down, up = slopes(grip, dimension)
            scale = {Dimension.HALF_PALM: 0.5, Dimension.FRICTION_ANGLE: cos(alpha) ** 2}.get(dimension, 1.0)
            yield Slope(
                closure,
                dimension,
                (scale * float(down.min), scale * float(up.min)),
                (scale * float(down.max), scale * float(up.max)),
            )


def _shown(dimension: Dimension, value: float) -> float:
    """Half palm -> palm width, friction angle -> friction coefficient, as the case file has them."""
    if dimension is Dimension.HALF_PALM:
        return 2.0 * value
    return tan(value) if dimension is Dimension.FRICTION_ANGLE else value


def _notes(case: Case) -> Iterator[str]:
    if len(case.hand.finger_links) > 1:
        links = len(case.hand.finger_links)
        yield f"the {links} links of a finger are kept straight; curling them can only add to what is held"
    if case.hand.finger_thickness > 0.0:
        yield f"fingers are {1e3 * case.hand.finger_thickness:g} mm thick with round tips, the palm is a line"
    if case.hand.fingers is Fingers.COLLIDING:
        yield "fingers lie in one plane and stop where they meet"
    if isinstance(case.object, ConvexPolygon):
        yield "polygons are balanced against translation at a fixed orientation; whether one could turn is not asked"
        if case.hand.fingers is Fingers.COLLIDING or case.hand.joint_limits is not None:
            yield "orientations of a polygon are found for crossing fingers without joint limits"
    if case.ranges:
        yield "what is reported holds over the whole of the given ranges"
