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
    from palmar.studies.arm_motion import Travel, Way


def travel(
    case: CaseName,
    *,
    uncertainty: Annotated[str, Parameter(help="disk:R_MM: how well the object's place is known.")],
    json: AsJson = False,
    check: Check = False,
) -> None:
    """The best advance, before or while the fingers close, and the ratio of speeds, for a given uncertainty."""
    from palmar.studies.arm_motion import Way, least_travel

    radius = _radius(uncertainty)
    name, given = open_case(case)
    found: dict[Way, Travel | None] = {}
    for way in Way:
        progress(f"simulating: {way.value}")
        found[way] = least_travel(given, radius, way)
    done = [each for each in found.values() if each is not None]
    best = min(done, key=lambda each: each.travel, default=None)
    show(titled(name, given, _text(given, radius, found, best)), _record(given, radius, found, best), json)
    answer(best is not None, check)


def _radius(text: str) -> float:
    kind, _, rest = text.partition(":")
    if kind != "disk" or not rest:
        raise InputError("--uncertainty", repr(text[:60]), "must be disk:R_MM")
    value = 1e-3 * number(rest, "--uncertainty")
    if not 0.0 < value <= LARGEST_LENGTH:
        allowed = f"lengths must be above 0 and at most {1e3 * LARGEST_LENGTH:g} mm"
        raise InputError("--uncertainty", repr(text[:60]), allowed)
    return value


def _text(case: Case, radius: float, found: dict[Way, Travel | None], best: Travel | None) -> str:
    from palmar.studies.arm_motion import FARTHEST

    rows = [("", "travel", "before closing", "for each radian", "of the tip's speed", "object about")]
    for way, each in found.items():
        if each is None:
            rows.append((way.value, f"none up to {1e3 * FARTHEST * case.hand.finger_length:.4g} mm", "", "", "", ""))
            continue
        x, y = (1e3 * value for value in each.room.centre)
        rows.append(
            (
                way.value,
                f"{1e3 * each.travel:.4g} mm",
                f"{1e3 * each.motion.first:.4g} mm",
                f"{1e3 * each.motion.per_radian:.4g} mm",
                f"{_ratio(case, each):.3g}",
                f"({x + 0.0:.4g}, {y:.4g}) mm",
            )
        )
    known = f"an object known within {1e3 * radius:.4g} mm"
    verdict = f"No arm motion straight ahead catches {known}, as far as was simulated."
    if best is not None:
        verdict = f"Caught, {known}: with the least travel by {best.way.value}, {1e3 * best.travel:.4g} mm (sampled)."
    return f"{verdict}\n\n{table(rows)}"


def _ratio(case: Case, travel: Travel) -> float:
    """Speed of the arm while the fingers close, as a share of that of their tips."""
    return travel.motion.per_radian / case.hand.finger_length


def _record(case: Case, radius: float, found: dict[Way, Travel | None], best: Travel | None) -> dict[str, Any]:
    return {
        "uncertainty_m": radius,
        "guarantee": "sampled",
        "best": None if best is None else best.way.name.lower(),
        "ways": {way.name.lower(): None if each is None else _one(case, each) for way, each in found.items()},
    }


def _one(case: Case, each: Travel) -> dict[str, Any]:
    return {
        "travel_m": each.travel,
        "first_m": each.motion.first,
        "per_radian_m": each.motion.per_radian,
        "speed_ratio": _ratio(case, each),
        "speed_m_s": each.motion.per_radian * case.hand.finger_rate,
        "at_m": list(each.room.centre),
        "allowed_error_m": each.room.radius,
    }
