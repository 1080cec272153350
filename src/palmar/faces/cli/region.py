"""``palmar region``: from where the motion catches the object, how surely, how little the hand must open, and what then."""

from __future__ import annotations

from enum import Enum
from math import radians
from pathlib import Path
from typing import Annotated, Any

from cyclopts import App, Parameter

from palmar.errors import InputError, NotCoveredError
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, number, numbers, show
from palmar.faces.cli.region_texts import answers_text
from palmar.faces.cli.texts import region_text, titled
from palmar.faces.records import region_record
from palmar.faces.region_records import answers_record
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.quantity import LARGEST_LENGTH
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.regions.region import Model, Region
from palmar.studies.capture import PoseError
from palmar.studies.region_questions import Answers, Questions, answers

app = App(name="region")

Text = Annotated[str | None, Parameter(allow_leading_hyphen=True)]


class Seen(Enum):
    """From where a region is seen."""

    HAND = "hand"
    OBJECT = "object"


@app.default
def region(
    case: CaseName,
    *,
    model: Annotated[Model, Parameter(help="How the region is obtained.")] = Model.EXACT,
    closure: Annotated[Closure, Parameter(help="structural takes the contacts as frictionless.")] = Closure.FRICTIONAL,
    error: Annotated[
        Text,
        Parameter(
            help="SX_MM,SY_MM[,STHETA_DEG]: standard deviations of a Gaussian pose error; adds the capture chance."
        ),
    ] = None,
    correlation: Annotated[Text, Parameter(help="Of the errors along x and y, between -1 and 1.")] = None,
    uncertainty: Annotated[
        Text,
        Parameter(help="disk:R_MM, box:W_MM,H_MM or a GeoJSON file: position errors; adds the smallest safe opening."),
    ] = None,
    at: Annotated[Text, Parameter(help="X_MM,Y_MM: the nominal place, else the case's start.")] = None,
    ends: Annotated[
        bool, Parameter(negative="", help="Add where the object ends and what the fingers then show.")
    ] = False,
    pressure_offset: Annotated[Text, Parameter(help="MM: add what an off-centre pressure costs.")] = None,
    seen_from: Annotated[
        Seen, Parameter(help="hand: where may the object be; object: where may the hand be.")
    ] = Seen.HAND,
    out: Annotated[Path | None, Parameter(help="Also write a file: svg, pdf, png, dxf, geojson, csv or json.")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Centre, contact and whole region of the closing motion, area and allowed position error; and how far they apply."""
    if out is not None:
        from palmar.faces.exports.region_file import known_ending

        known_ending(out)
    name, given = open_case(case)
    asked = _questions(error, correlation, uncertainty, at, ends, pressure_offset)
    result, uncovered = _built(given, model, closure, asked)
    found = answers(given, result, model, closure, asked)
    from_object = seen_from is Seen.OBJECT
    if result is None:
        record: dict[str, Any] = {
            "model": model.value,
            "closure": closure.value,
            "guarantee": "sampled",
            "centre": None,
        }
        record["reason"], text, caught = uncovered, f"No region: {uncovered}.", _any_caught(found)
    else:
        record, text = region_record(result, from_object=from_object), region_text(result)
        caught = not result.centre.is_empty
    record |= answers_record(given, found)
    if out is not None and result is not None:
        from palmar.faces.exports.region_file import write_region

        write_region(out, given, result, from_object=from_object, record=record)
    written = [f"Written: {out}"] if out is not None and result is not None else []
    show(titled(name, given, text, *answers_text(given, found), *written), record, json)
    answer(caught, check)


def _built(case: Case, model: Model, closure: Closure, asked: Questions) -> tuple[Region | None, str]:
    """The region, or why there is none where the questions can be answered without."""
    try:
        return build_region(case, model, closure), ""
    except NotCoveredError as error:
        by_starts = asked.error is not None or (asked.ends and asked.uncertainty is not None)
        if not by_starts:
            raise
        return None, str(error)


def _questions(
    error: str | None, correlation: str | None, uncertainty: str | None, at: str | None, ends: bool, offset: str | None
) -> Questions:
    errors = None
    if uncertainty is not None:
        from palmar.faces.cli.uncertainty import parse_uncertainty

        errors = parse_uncertainty(uncertainty)
    if correlation is not None and error is None:
        raise InputError("--correlation", None, "needs --error")
    return Questions(
        error=None if error is None else _pose_error(error, correlation),
        uncertainty=errors,
        ends=ends,
        offset=None
        if offset is None
        else 1e-3 * _positive([number(offset, "--pressure-offset")], "--pressure-offset")[0],
        at=None if at is None else _place(at),
    )


def _pose_error(text: str, correlation: str | None) -> PoseError:
    values = numbers(text, "--error", (2, 3), "SX_MM,SY_MM[,STHETA_DEG]")
    x, y = _positive(values[:2], "--error")
    turn = values[2] if len(values) == 3 else 0.0
    if not 0.0 <= turn <= 180.0:
        raise InputError("--error", repr(text[:60]), "the angle's standard deviation must be between 0 and 180 deg")
    shared = 0.0 if correlation is None else number(correlation, "--correlation")
    if not abs(shared) <= 0.999999:
        raise InputError("--correlation", repr(str(correlation)[:60]), "must be above -1 and below 1")
    return PoseError((1e-3 * x, 1e-3 * y), shared, radians(turn))


def _positive(values: list[float], option: str) -> list[float]:
    if not all(1e-6 <= value <= 1e3 * LARGEST_LENGTH for value in values):
        raise InputError(option, ",".join(f"{each:g}" for each in values), "lengths must be 0.000001 to 1000000 mm")
    return values


def _place(text: str) -> tuple[float, float]:
    x, y = numbers(text, "--at", (2,), "X_MM,Y_MM")
    return 1e-3 * x, 1e-3 * y


def _any_caught(found: Answers) -> bool:
    by_chance = found.capture is not None and found.capture.nominal.probability > 0.0
    return by_chance or (found.ends is not None and found.ends.caught > 0.0)
