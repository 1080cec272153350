"""``palmar touch``: what the hand's sensors buy, how wide to open, and how few sensors would do."""

from __future__ import annotations

from math import degrees, radians
from pathlib import Path
from typing import Annotated, Any

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, number, show
from palmar.faces.cli.texts import table, titled
from palmar.geometry.planar_set import coordinates
from palmar.models.case import Case
from palmar.models.case_file import with_layout
from palmar.models.closure import Closure
from palmar.models.sensors import Stretch
from palmar.models.shipped import open_case
from palmar.studies.touch import Touch, fewest_stretches, touch_at, touch_by_opening

app = App(name="touch")
Text = Annotated[str | None, Parameter(allow_leading_hyphen=True)]


@app.default
def touch(
    case: CaseName,
    *,
    sensors: Annotated[
        str | None, Parameter(help="Instead of the case's: none, palm, tips, distributed, full, or PART[,PART...].")
    ] = None,
    opening: Annotated[Text, Parameter(help="DEG of the base joints, else the case's.")] = None,
    travel: Annotated[Text, Parameter(help="MM of the approach, else a finger's length.")] = None,
    closure: Annotated[Closure, Parameter(help="structural takes the contacts as frictionless.")] = Closure.FRICTIONAL,
    out: Annotated[Path | None, Parameter(help="Also draw it: svg, pdf or png.")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """How wide an approach by touch is certain to end in a grasp, beside closing alone; by opening; the fewest sensors."""
    if out is not None and out.suffix.lower() not in (".svg", ".pdf", ".png"):
        raise InputError("--out", str(out), "this is drawn as svg, pdf or png")
    name, given = open_case(case)
    if sensors is not None:
        given = with_layout(given, sensors, "--sensors")
    angle = _angle(given, opening)
    way = _way(given, travel)
    here = touch_at(given, angle, way, closure)
    curve, fewest = touch_by_opening(given, way, closure), fewest_stretches(given, angle, closure)
    if out is not None:
        from palmar.faces.plots.style import save
        from palmar.faces.plots.touch_picture import touch_picture

        save(touch_picture(given, here), out)
    written = [f"Written: {out}"] if out is not None else []
    show(titled(name, given, _text(here, curve, fewest), *written), _record(here, curve, fewest), json)
    answer(here.good > 0.0, check)


def _angle(case: Case, text: str | None) -> float:
    if text is None:
        return case.hand.open
    low, high = (degrees(each) for each in case.hand.base_limits)
    value = number(text, "--opening")
    if not low <= value < high:
        raise InputError("--opening", repr(text[:60]), f"must be from {low:g} to below {high:g} deg for this hand")
    return radians(value)


def _way(case: Case, text: str | None) -> float:
    if text is None:
        return case.hand.finger_length
    value = 1e-3 * number(text, "--travel")
    if not 0.0 < value <= 1000.0 * case.hand.finger_length:
        raise InputError("--travel", repr(text[:60]), "must be above 0 mm and at most a thousand finger lengths")
    return value


def _text(here: Touch, curve: tuple[Touch, ...], fewest: tuple[Stretch, ...] | None) -> str:
    rows = [
        ("width across which the open hand touches", f"{1e3 * here.touched:.4g} mm"),
        ("of it felt", f"{1e3 * here.felt:.4g} mm"),
        ("of it certain to end in a grasp", f"{1e3 * here.good:.4g} mm, {1e3 * here.connected:.4g} mm in one run"),
        ("area from which closing alone catches", f"{1e4 * here.closing.area:.4g} cm2"),
        (f"area with an approach of {1e3 * here.travel:.4g} mm by touch", f"{1e4 * here.sensory.area:.4g} cm2"),
    ]
    best = max(curve, key=lambda each: (each.connected, each.good))
    few = "none: some stretch would have to be shorter than a thousandth of the finger"
    if fewest is not None:
        few = f"{len(fewest)}: {', '.join(each.name for each in fewest)}"
    lines = [
        table(rows), "",
        f"Widest in one run with the fingers open to {degrees(best.opening):.3g} deg: {1e3 * best.connected:.4g} mm.",
        f"Fewest sensors with which one approach suffices: {few}.", "",
        table([("opening", "felt", "certain", "in one run", "ratio"), *map(_row, curve[::3])]),
    ]  # fmt: skip
    return "\n".join(lines)


def _row(each: Touch) -> tuple[str, ...]:
    widths = (f"{1e3 * width:.4g} mm" for width in (each.felt, each.good, each.connected))
    return (f"{degrees(each.opening):.3g} deg", *widths, f"{each.ratio:.3g}")


def _record(here: Touch, curve: tuple[Touch, ...], fewest: tuple[Stretch, ...] | None) -> dict[str, Any]:
    return {
        **_widths(here),
        "travel_m": here.travel,
        "sensory": coordinates(here.sensory),
        "sensory_area_m2": here.sensory.area,
        "closing": coordinates(here.closing),
        "closing_area_m2": here.closing.area,
        "by_opening": [_widths(each) for each in curve],
        "fewest_sensors": None if fewest is None else [each.name for each in fewest],
    }


def _widths(each: Touch) -> dict[str, float]:
    return {
        "opening_rad": each.opening,
        "touched_m": each.touched,
        "felt_m": each.felt,
        "certain_m": each.good,
        "connected_m": each.connected,
        "connected_ratio": each.ratio,
    }
