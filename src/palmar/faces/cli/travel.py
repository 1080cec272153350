"""``palmar behaviours travel``: the least travel of the arm with which a place known so well is certain to do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, number, progress, show
from palmar.faces.cli.texts import table, titled
from palmar.models.case import Case
from palmar.models.quantity import LARGEST_LENGTH
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.studies.arm_motion import ArmMotions, Travel

WAYS = {
    "first": "move and grab",
    "closing": "move while closing",
    "shortest": "least travel",
    "quickest": "least time",
}
"""Of ``ArmMotions``, and what they are called."""


HEADS = ("", "travel", "time", "before closing", "for each radian", "of the tip's speed", "object about", "region")


def travel(
    case: CaseName,
    *,
    uncertainty: Annotated[str, Parameter(help="disk:R_MM: how well the object's place is known.")],
    json: AsJson = False,
    check: Check = False,
) -> None:
    """The best advance, before and while the fingers close, and the ratio of speeds, for a given uncertainty."""
    from palmar.studies.arm_motion import best_arm_motions

    radius = _radius(uncertainty)
    name, given = open_case(case)
    found = best_arm_motions(given, radius, lambda words: progress(f"simulating: {words}"))
    show(titled(name, given, _text(given, radius, found)), _record(given, radius, found), json)
    answer(found.shortest is not None, check)


def _radius(text: str) -> float:
    kind, _, rest = text.partition(":")
    if kind != "disk" or not rest:
        raise InputError("--uncertainty", repr(text[:60]), "must be disk:R_MM")
    value = 1e-3 * number(rest, "--uncertainty")
    if not 0.0 < value <= LARGEST_LENGTH:
        allowed = f"lengths must be above 0 and at most {1e3 * LARGEST_LENGTH:g} mm"
        raise InputError("--uncertainty", repr(text[:60]), allowed)
    return value


def _text(case: Case, radius: float, found: ArmMotions) -> str:
    from palmar.studies.arm_motion import FARTHEST

    rows = [HEADS]
    for way, called in WAYS.items():
        each: Travel | None = getattr(found, way)
        if each is None:
            rows.append(
                (called, f"none up to {1e3 * FARTHEST * case.hand.finger_length:.4g} mm", "", "", "", "", "", "")
            )
            continue
        x, y = (1e3 * value for value in each.room.centre)
        rows.append(
            (
                called,
                f"{1e3 * each.travel:.4g} mm",
                f"{each.seconds:.3g} s",
                f"{1e3 * each.motion.first:.4g} mm",
                f"{1e3 * each.motion.per_radian:.4g} mm",
                f"{_ratio(case, each):.3g}",
                f"({x + 0.0:.4g}, {y:.4g}) mm",
                each.guarantee.value,
            )
        )
    known = f"an object known within {1e3 * radius:.4g} mm"
    if found.shortest is None or found.quickest is None:
        verdict = f"No arm motion straight ahead catches {known}, as far as was simulated."
    else:
        verdict = (
            f"Caught, {known}: with the least travel, {1e3 * found.shortest.travel:.4g} mm,"
            f" of which {1e3 * found.shortest.motion.first:.4g} mm before closing;"
            f" in the least time, {found.quickest.seconds:.3g} s, {1e3 * found.quickest.travel:.4g} mm,"
            f" of which {1e3 * found.quickest.motion.first:.4g} mm before closing."
        )
    return f"{verdict}\n\n{table(rows)}"


def _ratio(case: Case, travel: Travel) -> float:
    """Speed of the arm while the fingers close, as a share of that of their tips."""
    return travel.motion.per_radian / case.hand.finger_length


def _record(case: Case, radius: float, found: ArmMotions) -> dict[str, Any]:
    from palmar.studies.arm_motion import SPACING

    ways = {way: getattr(found, way) for way in WAYS}
    return {
        "uncertainty_m": radius,
        "spacing_m": SPACING * case.hand.finger_length,
        "ways": {way: None if each is None else _one(case, each) for way, each in ways.items()},
    }


def _one(case: Case, each: Travel) -> dict[str, Any]:
    speed, closing = case.behaviour.speed, each.motion.per_radian * case.hand.finger_rate
    return {
        "travel_m": each.travel,
        "seconds": each.seconds,
        "share_first": each.share,
        "first_m": each.motion.first,
        "per_radian_m": each.motion.per_radian,
        "speed_ratio": _ratio(case, each),
        "arm_speed_m_s": min(speed, closing),
        "finger_rate_rad_s": case.hand.finger_rate * min(1.0, speed / closing if closing > 0.0 else 1.0),
        "guarantee": each.guarantee.value,
        "at_m": list(each.room.centre),
        "allowed_error_m": each.room.radius,
    }
