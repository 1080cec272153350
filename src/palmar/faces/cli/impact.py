"""``palmar impact``: how hard a finger strikes the object, and what softens that."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, CaseName, number, show
from palmar.faces.cli.texts import table, titled
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.faces.words import Row
    from palmar.studies.impact_numbers import ImpactNumbers

app = App(name="impact")
LARGEST = 1e9


def _option(words: str) -> Parameter:
    return Parameter(help=words, allow_leading_hyphen=True)


@app.default
def impact(
    case: CaseName,
    *,
    speed: Annotated[str | None, _option("Approach speed in mm/s; else the finger's at its rate.")] = None,
    stiffness: Annotated[str | None, _option("Of the contact in N/mm.")] = None,
    damping: Annotated[str | None, _option("Damping ratio; else that of the case's restitution.")] = None,
    force_limit: Annotated[str | None, _option("N: how soft the contact must be.")] = None,
    torque: Annotated[str | None, _option("N m: touch-down with full torque, then full counter-torque.")] = None,
    lag: Annotated[str | None, _option("ms: of a drive that force is fed back to.")] = None,
    json: AsJson = False,
) -> None:
    """Peak force and duration of a finger's impact, the pad for a force limit, touch-down, and limits of force feedback."""
    from palmar.studies.impact_numbers import Asked, impact_numbers

    asked = Asked(
        _above("--speed", speed, 1e-3), _above("--stiffness", stiffness, 1e3), _above("--damping", damping, 1.0, zero=True),
        _above("--force-limit", force_limit, 1.0), _above("--torque", torque, 1.0), _above("--lag", lag, 1e-3),
    )  # fmt: skip
    if asked == Asked(asked.speed, damping=asked.damping):
        raise InputError("palmar impact", None, "give at least one of --stiffness, --force-limit, --torque and --lag")
    name, given = open_case(case)
    found = impact_numbers(given, asked)
    show(titled(name, given, table(_rows(found))), _record(found), json)


def _above(option: str, text: str | None, factor: float, *, zero: bool = False) -> float | None:
    """A positive number in SI; None if it is not given."""
    if text is None:
        return None
    value = number(text, option)
    if value < 0.0 or (value == 0.0 and not zero) or value > LARGEST:
        least = "must be at least 0" if zero else "must be greater than 0"
        raise InputError(option, repr(text[:60]), f"{least} and at most {LARGEST:g}")
    return factor * value


def _rows(found: ImpactNumbers) -> list[Row]:
    rows: list[Row] = [
        ("finger touches", f"at {math.degrees(found.angle):.2f} deg, {1e3 * found.foot:.2f} mm from its base"),
        ("approach speed", f"{1e3 * found.speed:.4g} mm/s"),
        ("reduced mass", f"{found.mass:.4g} kg"),
        ("damping ratio", f"{found.damping:.4g} (restitution {found.restitution:.4g})"),
    ]
    for title, contact in (("contact", found.contact), ("softest allowed", found.softest)):
        if contact is not None:
            rows += [
                (title, f"{1e-3 * contact.stiffness:.4g} N/mm"),
                ("  peak force", f"{contact.peak:.4g} N"),
                ("  duration", f"{1e3 * contact.duration:.4g} ms"),
                ("  compression", f"{1e3 * contact.compression:.4g} mm"),
            ]
    if found.pad is not None:
        pad = "none is needed" if found.pad == math.inf else f"at most {1e-3 * found.pad:.4g} N/mm"
        rows.append(("pad before the contact", pad))
    if found.touch_down is not None:
        down = found.touch_down
        rows += [
            ("torque reversed", f"at {math.degrees(down.switch_angle):.2f} deg, after {down.switch_time:.4g} s"),
            ("  touch", f"after {down.time:.4g} s at {1e3 * down.speed:.4g} mm/s"),
        ]
    if found.feedback is not None:
        back = found.feedback
        rows += [
            ("force gain", f"stable below {back.gain_limit:.4g}"),
            ("  at the limit", f"hammers at {back.hammering / (2.0 * math.pi):.4g} Hz"),
            ("  worst lag", f"{1e3 * back.worst_lag:.4g} ms"),
        ]
    return rows


UNITS = {
    "foot": "foot_m", "angle": "angle_rad", "speed": "speed_m_s", "mass": "mass_kg", "damping": "damping_ratio",
    "stiffness": "stiffness_n_m", "peak": "peak_n", "duration": "duration_s", "compression": "compression_m",
    "pad": "pad_n_m", "switch_angle": "switch_angle_rad", "switch_time": "switch_time_s", "time": "time_s",
    "worst_lag": "worst_lag_s", "hammering": "hammering_rad_s",
}  # fmt: skip


def _record(found: ImpactNumbers) -> dict[str, Any]:
    """Keys with their units; parts that were not asked for, and a pad that is not needed, are null."""

    def named(part: dict[str, Any]) -> dict[str, Any]:
        return {UNITS.get(key, key): named(each) if isinstance(each, dict) else each for key, each in part.items()}

    return named(asdict(found))
