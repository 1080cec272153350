"""``palmar impact``: how hard a finger strikes the object, and what softens that."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, CaseName, number, numbers, show
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
    stiffness: Annotated[str | None, _option("Of the contact in N/mm; else the case's.")] = None,
    damping: Annotated[str | None, _option("Damping ratio; else that of the case's restitution.")] = None,
    force_limit: Annotated[str | None, _option("N: how soft the contact must be.")] = None,
    torque: Annotated[str | None, _option("N m: touch-down with full torque, then full counter-torque.")] = None,
    lag: Annotated[str | None, _option("ms: of a drive that force is fed back to; else the case's.")] = None,
    gain: Annotated[
        str | None, _option("Of that feedback: whether it is stable, and how fast it grows if not.")
    ] = None,
    trigger: Annotated[
        str | None, _option("FORCE_N,DELAY_MS: the drive lets the finger go so long after the force passed that.")
    ] = None,
    returned: Annotated[
        str | None, _option("Share of its speed at which the hand, as a paddle, returns the object; 0 stops it dead.")
    ] = None,
    stroke: Annotated[str | None, _option("mm: over which a matched object is brought to rest.")] = None,
    acceleration: Annotated[str | None, _option("mm/s^2 of the arm: its run-up to match the object.")] = None,
    json: AsJson = False,
) -> None:
    """Peak force and duration of a finger's impact, and what softens it: a pad, touch-down, letting go, a matched return."""
    from palmar.studies.impact_numbers import Asked, impact_numbers, told_by

    asked = Asked(
        _above("--speed", speed, 1e-3), _above("--stiffness", stiffness, 1e3), _above("--damping", damping, 1.0, zero=True),
        _above("--force-limit", force_limit, 1.0), _above("--torque", torque, 1.0), _above("--lag", lag, 1e-3),
        _above("--gain", gain, 1.0), _trigger(trigger), _above("--returned", returned, 1.0, zero=True),
        _above("--stroke", stroke, 1e-3), _above("--acceleration", acceleration, 1e-3),
    )  # fmt: skip
    name, given = open_case(case)
    asked = told_by(given, asked)
    if asked == Asked(asked.speed, damping=asked.damping):
        raise InputError(
            "palmar impact", None, "give at least one of --stiffness, --force-limit, --torque, --lag and --returned"
        )
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


def _trigger(text: str | None) -> tuple[float, float] | None:
    """Threshold (N) and delay (s)."""
    if text is None:
        return None
    force, delay = numbers(text, "--trigger", (2,), "FORCE_N,DELAY_MS")
    if not (force > 0.0 and delay >= 0.0):
        raise InputError("--trigger", text[:60], "FORCE_N,DELAY_MS: the force must be positive, the delay not negative")
    return force, 1e-3 * delay


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
        rows.append(
            ("force gain", "stable at any" if back.gain_limit is None else f"stable below {back.gain_limit:.4g}")
        )
        if back.hammering is not None:
            rows.append(("  at the limit", f"hammers at {back.hammering / (2.0 * math.pi):.4g} Hz"))
        if back.worst_lag is not None:
            rows.append(("  worst lag", f"{1e3 * back.worst_lag:.4g} ms"))
        if back.gain is not None and back.growth is not None:
            grows = "dies out" if back.doubling is None else f"grows, doubling every {1e3 * back.doubling:.4g} ms"
            rows.append((f"  a gain of {back.gain:.4g}", f"{grows} ({back.growth:.4g} per s)"))
    return rows + _softened(found)


def _softened(found: ImpactNumbers) -> list[Row]:
    """Letting go, and playing the paddle."""
    rows: list[Row] = []
    if found.let_go is not None:
        go = found.let_go
        rows += [
            ("drive lets go", f"{1e3 * go.delay:.4g} ms after {go.threshold:.4g} N"),
            ("  peak force", f"{go.peak:.4g} N, without it {go.without:.4g} N"),
        ]
    if found.paddle is not None:
        paddle = found.paddle
        rows += [
            ("paddle's mirror gain", f"{paddle.mirror_gain:.4g}"),
            ("  paddle's speed", f"{1e3 * paddle.paddle_speed:.4g} mm/s against the object"),
            (
                "  impact",
                f"at {1e3 * paddle.impact:.4g} mm/s, the object returns at {1e3 * paddle.returned + 0.0:.4g} mm/s",
            ),
        ]
        for title, stop in (("  stop, even", paddle.quadratic), ("  stop, along a sine", paddle.sinusoidal)):
            if stop is not None:
                rows.append(
                    (title, f"in {stop.time:.4g} s, at most {1e3 * stop.deceleration:.4g} mm/s^2, {stop.force:.4g} N")
                )
        if paddle.run_up is not None:
            rows.append(("  run-up to match it", f"{1e3 * paddle.run_up:.4g} mm"))
    return rows


UNITS = {
    "foot": "foot_m", "angle": "angle_rad", "speed": "speed_m_s", "mass": "mass_kg", "damping": "damping_ratio",
    "stiffness": "stiffness_n_m", "peak": "peak_n", "duration": "duration_s", "compression": "compression_m",
    "pad": "pad_n_m", "switch_angle": "switch_angle_rad", "switch_time": "switch_time_s", "time": "time_s",
    "worst_lag": "worst_lag_s", "hammering": "hammering_rad_s", "growth": "growth_per_s", "doubling": "doubling_s",
    "threshold": "threshold_n", "delay": "delay_s", "without": "without_n", "paddle_speed": "paddle_speed_m_s",
    "impact": "impact_m_s", "returned": "returned_m_s", "deceleration": "deceleration_m_s2", "force": "force_n",
    "run_up": "run_up_m",
}  # fmt: skip


def _record(found: ImpactNumbers) -> dict[str, Any]:
    """Keys with their units; parts that were not asked for, and a pad that is not needed, are null."""

    def named(part: dict[str, Any]) -> dict[str, Any]:
        return {UNITS.get(key, key): named(each) if isinstance(each, dict) else each for key, each in part.items()}

    return named(asdict(found))
