"""Answers in words and table rows, shared by the terminal and the pages; lengths in mm."""

from __future__ import annotations

import math
from collections.abc import Sequence

from palmar.mechanics.closure.sizing import Dimension
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.objects import Disk
from palmar.regions.region import Region
from palmar.studies.closure import Change, ClosureAnswer, RadiusRange, Slope
from palmar.studies.jointed_closure import JointedClosure
from palmar.studies.jointed_reason import IN_WORDS, Intervals
from palmar.studies.sizing import Sizing, interval_words

Row = tuple[str, ...]

_WORDS = {
    Dimension.HALF_PALM: "palm width",
    Dimension.FINGER_LENGTH: "finger length",
    Dimension.FRICTION_ANGLE: "friction",
}
_HOW = {Closure.STRUCTURAL: "without friction", Closure.FRICTIONAL: "with friction"}


def _word(dimension: Dimension | int) -> str:
    return _WORDS[dimension] if isinstance(dimension, Dimension) else f"length of link {dimension}"


def headline(name: str, case: Case) -> str:
    """One line: the hand and the object."""
    hand = case.hand
    links = " + ".join(f"{1e3 * each:.4g}" for each in hand.finger_links)
    thick = f", {1e3 * hand.finger_thickness:.4g} mm thick" if hand.finger_thickness else ""
    if isinstance(case.object, Disk):
        what = f"a disk of radius {1e3 * case.object.radius:.4g} mm"
    else:
        what = f"a polygon of {len(case.object.vertices)} corners"
    return f"{name}: palm {1e3 * hand.palm_width:.4g} mm, fingers {links} mm{thick}, {hand.fingers.value}; {what}"


def region_notes(regions: Sequence[Region]) -> list[str]:
    """What is to be said of regions of one case, as sentences: of all of them, then of each by its closure."""
    shared = [note for note in regions[0].notes if all(note in each.notes for each in regions)]
    own = [f"{_HOW[each.closure]}: {note}" for each in regions for note in each.notes if note not in shared]
    return [f"{each[0].upper()}{each[1:]}." for each in (*shared, *dict.fromkeys(own))]


def closure_rows(case: Case, result: ClosureAnswer) -> list[Row]:
    """(closure, radii held, verdict on the object) for both closures."""
    held = {True: "this object: held", False: "this object: not held"}
    return [
        ("radii held without friction", _radii(result.structural), held[result.object.structural]),
        (f"radii held with friction {_friction(case)}", _radii(result.frictional), held[result.object.frictional]),
    ]


def jointed_rows(case: Case, result: JointedClosure) -> list[Row]:
    """(closure, radii held, verdict on the object) of fingers that bend, and of the same ones kept straight."""
    held = {True: "this object: held", False: "this object: not held"}
    friction, verdict = f"with friction {_friction(case)}", result.object
    plain, rough = (
        " and ".join(map(_span, several)) if several else _radii(radii)
        for radii, several in zip((result.structural, result.frictional), result.intervals, strict=True)
    )
    rows: list[Row] = [
        ("radii held without friction", plain, held[verdict.structural]),
        (f"radii held {friction}", rough, held[verdict.frictional]),
    ]
    if result.coupled:
        return rows
    return [
        *rows,
        ("fingers kept straight, without friction", _radii(result.straight[0]), ""),
        (f"fingers kept straight, {friction}", _radii(result.straight[1]), ""),
    ]


def carried_rows(known: dict[str, Intervals]) -> list[Row]:
    """(links that hold, radii) without friction."""
    return [(IN_WORDS[name], " and ".join(map(_span, each)) or "none") for name, each in known.items()]


def change_line(change: Change) -> str:
    """One change that makes the object held."""
    scale, unit = (1.0, "") if change.dimension is Dimension.FRICTION_ANGLE else (1e3, " mm")
    values = f"{scale * change.now:.4g} -> {scale * change.to:.4g}{unit}"
    return f"to hold it {_HOW[change.closure]}: {_word(change.dimension)} {values}"


def slope_row(slope: Slope) -> Row:
    """(what is changed, change of the largest radius, change of the smallest radius)."""
    if slope.dimension is Dimension.FRICTION_ANGLE:
        step, scale = "0.1 more friction", 0.1e3
    else:
        step, scale = f"1 mm more {_word(slope.dimension)}", 1.0
    moved = (f"{_signed(scale * limit[1])} mm" for limit in (slope.radius_max, slope.radius_min))
    return (f"{_HOW[slope.closure]}, {step}", *moved)


def region_rows(region: Region) -> list[Row]:
    """(what, value) of a region that is not empty."""
    circle = region.allowed_error
    assert circle is not None
    x, y = (round(1e3 * each, 1) + 0.0 for each in circle.centre)
    return [
        ("area of the object's centre", f"{1e4 * region.area:.4g} cm2"),
        ("allowed position error", f"{1e3 * circle.radius:.1f} mm about ({x:.1f}, {y:.1f}) mm"),
        *_certain_rows(region),
        *resting_rows(region),
        ("hold at the end", region.closure.value),
        ("model", region.model.value),
        ("guarantee", f"{region.guarantee.value}: {region.guarantee.meaning}"),
        ("curves flattened within", f"{1e3 * region.flattening:.2g} mm"),
    ]


def resting_rows(region: Region) -> list[Row]:
    """Where along a wall an object may rest to be caught."""
    if region.resting is None:
        return []
    spans = ", ".join(f"{1e3 * low:.1f} to {1e3 * high:.1f} mm" for low, high in region.resting)
    return [("resting on the wall", f"x from {spans}" if spans else "caught from nowhere along it")]


def _certain_rows(region: Region) -> list[Row]:
    """The part of a sampled region that is certain, and the orientations it is for."""
    if region.certain is None:
        return []
    rows: list[Row] = [("of it certain", f"{1e4 * region.certain.area:.4g} cm2, by bounds instead of simulation")]
    low, high = (math.degrees(each) for each in region.orientations or (0.0, 0.0))
    return [*rows, ("orientation", f"{low:.4g} deg" if low == high else f"every one from {low:.4g} to {high:.4g} deg")]


def sizing_line(result: Sizing) -> str:
    """The palm widths or finger lengths that suffice, or why none does."""
    wanted = f"radii {_mm(result.radius_min)} to {_mm(result.radius_max)}"
    if not result.intervals:
        return f"{wanted}: {result.reason}."
    return f"{wanted} are held with a {_WORDS[result.sought]} of {interval_words(result.intervals)}."


def _friction(case: Case) -> str:
    known = [each for each in case.ranges if each.place == ("contact", "friction")]
    return f"{known[0].low:.3g}..{known[0].high:.3g}" if known else f"{case.contact.friction:.3g}"


def _radii(radii: RadiusRange | None) -> str:
    return "none" if radii is None else _span((radii.radius_min, radii.radius_max))


def _span(ends: tuple[float, float]) -> str:
    return f"{1e3 * ends[0]:.1f} to {1e3 * ends[1]:.1f} mm"


def _signed(value: float) -> str:
    rounded = round(value, 2)
    return f"{rounded:+.2f}" if rounded else "0.00"


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"
