"""``palmar region``: from where the motion catches the object, how surely, how little the hand must open, and what then."""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from typing import Annotated, Any

from cyclopts import App, Parameter

from palmar.errors import InputError, NotCoveredError
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, show
from palmar.faces.cli.region_options import fineness, models, orientations, questions
from palmar.faces.cli.region_texts import answers_text
from palmar.faces.cli.texts import comparison_text, region_text, titled
from palmar.faces.records import comparison_record, region_record
from palmar.faces.region_records import answers_record
from palmar.models.case import Case
from palmar.models.case_file import with_friction
from palmar.models.closure import Closure
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.regions.region import Model, Region
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
    friction: Annotated[str | None, Parameter(help="Instead of the case's: a number, or a range LOW..HIGH.")] = None,
    theta: Annotated[Text, Parameter(help="Orientations of a polygon: DEG, LOW..HIGH or all.")] = None,
    tolerance: Annotated[
        Text, Parameter(help="In mm: how far curves may be flattened, or simulated starts be apart.")
    ] = None,
    compare: Annotated[str | None, Parameter(help="Two or three models side by side, as exact,published.")] = None,
    error: Annotated[
        Text, Parameter(help="SX_MM,SY_MM[,STHETA_DEG] of a Gaussian pose error: adds the chance of a catch.")
    ] = None,
    correlation: Annotated[Text, Parameter(help="Of the errors along x and y, between -1 and 1.")] = None,
    uncertainty: Annotated[
        Text, Parameter(help="Position errors disk:R_MM, box:W_MM,H_MM, FILE.geojson: adds the smallest safe opening.")
    ] = None,
    at: Annotated[Text, Parameter(help="X_MM,Y_MM: the nominal place, else the case's start.")] = None,
    ends: Annotated[bool, Parameter(negative="", help="Add where it ends and what the fingers then show.")] = False,
    pressure_offset: Annotated[Text, Parameter(help="MM: add what an off-centre pressure costs.")] = None,
    velocities: Annotated[
        bool, Parameter(negative="", help="Of a free disk: add which velocities it may have at the nominal place.")
    ] = False,
    seen_from: Annotated[
        Seen, Parameter(help="hand: where may the object be; object: where may the hand be.")
    ] = Seen.HAND,
    sweep: Annotated[
        Text, Parameter(help="LENGTH_MM[,WIDTH_MM]: of a cylinder and the hand along its axis, for stl, glb, ply.")
    ] = None,
    palm_only: Annotated[
        bool, Parameter(negative="", help="With --sweep: only the palm feels, so the region shrinks to its width.")
    ] = False,
    out: Annotated[Path | None, Parameter(help="Also write a file: svg, pdf, png, dxf, geojson, csv or json.")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Centre, contact and whole region of the closing motion, area and allowed position error; and how far they apply."""
    if palm_only and (sweep is None or seen_from is Seen.OBJECT):
        raise InputError("--palm-only", None, "needs --sweep, and the region seen from the hand")
    if out is not None and sweep is None:
        from palmar.faces.exports.region_file import known_ending

        known_ending(out)
    name, given = open_case(case)
    if friction is not None:
        given = with_friction(given, friction, "--friction")
    asked = questions(error, correlation, uncertainty, at, ends, pressure_offset, velocities)
    if compare is not None:
        if asked != Questions() or theta is not None:
            raise InputError("--compare", None, "compares regions alone, without a question or orientations")
        _compare(name, given, models(compare), closure, out, json)
        return
    result, uncovered = _built(given, model, closure, (orientations(theta), fineness(tolerance, given)), asked)
    found = answers(given, result, model, closure, asked)
    from_object = seen_from is Seen.OBJECT
    if result is None:
        record: dict[str, Any] = {"model": model.value, "closure": closure.value, "centre": None, "reason": uncovered}
        text, caught = f"No region: {uncovered}.", _any_caught(found)
    else:
        record, text = region_record(result, from_object=from_object), region_text(result)
        caught = not result.centre.is_empty
    record |= answers_record(given, found)
    written = [] if result is None else _written(out, (sweep, palm_only), given, result, from_object, record)
    show(titled(name, given, text, *answers_text(given, found), *written), record, json)
    answer(caught, check)


def _built(
    case: Case,
    model: Model,
    closure: Closure,
    finely: tuple[tuple[float, float] | None, float | None],
    asked: Questions,
) -> tuple[Region | None, str]:
    """The region at (orientations, tolerance), or why there is none where the questions can be answered without."""
    try:
        return build_region(case, model, closure, *finely), ""
    except NotCoveredError as error:
        by_starts = asked.error is not None or (asked.ends and asked.uncertainty is not None)
        if not by_starts:
            raise
        return None, str(error)


def _written(
    out: Path | None,
    swept: tuple[str | None, bool],
    case: Case,
    region: Region,
    from_object: bool,
    record: dict[str, Any],
) -> list[str]:
    """Write the file asked for, flat or swept along the cylinder's axis (the lengths, palm only), and say so."""
    sweep, palm_only = swept
    if sweep is not None:
        from palmar.faces.cli.swept import tilt_of, write_swept
        from palmar.geometry.planar_set import seen_from_object

        centre = seen_from_object(region.centre) if from_object else region.centre
        said, record["swept"] = write_swept(out, centre, sweep, case.hand.half_palm if palm_only else None)
        tilt, record["swept"]["tilt"] = tilt_of(case, sweep)
        return [said, tilt] if tilt else [said]
    if out is None:
        return []
    from palmar.faces.exports.region_file import write_region

    write_region(out, case, region, from_object=from_object, record=record)
    return [f"Written: {out}"]


def _any_caught(found: Answers) -> bool:
    by_chance = found.capture is not None and found.capture.nominal.probability > 0.0
    return by_chance or (found.ends is not None and found.ends.caught > 0.0)


def _compare(name: str, case: Case, sides: list[Model], closure: Closure, out: Path | None, as_json: bool) -> None:
    from palmar.studies.compare import compare_regions

    if out is not None and out.suffix.lower() not in (".svg", ".pdf", ".png"):
        raise InputError("--out", str(out), "a comparison is drawn as svg, pdf or png")
    result = compare_regions(case, sides, closure)
    if out is not None:
        from palmar.faces.plots.compare_picture import compare_picture
        from palmar.faces.plots.style import save

        save(compare_picture(case, result), out)
    written = [f"Written: {out}"] if out is not None else []
    show(titled(name, case, comparison_text(result), *written), comparison_record(result), as_json)
