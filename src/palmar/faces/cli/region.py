"""``palmar region``: from where the motion catches the object."""

from __future__ import annotations

import math
from enum import Enum
from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, number, show
from palmar.faces.cli.texts import comparison_text, region_text, titled
from palmar.faces.records import comparison_record, region_record
from palmar.models.case import Case
from palmar.models.case_file import with_friction
from palmar.models.closure import Closure
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.regions.region import Model

app = App(name="region")
FINEST = 1e-8
"""Least tolerance in finger lengths."""


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
    theta: Annotated[
        str | None,
        Parameter(help="Orientations of a polygon: DEG, LOW..HIGH or all.", allow_leading_hyphen=True),
    ] = None,
    tolerance: Annotated[
        str | None,
        Parameter(
            help="In mm: how far curves may be flattened, or simulated starts be apart.", allow_leading_hyphen=True
        ),
    ] = None,
    compare: Annotated[str | None, Parameter(help="Two models side by side, as exact,published.")] = None,
    seen_from: Annotated[
        Seen, Parameter(help="hand: where may the object be; object: where may the hand be.")
    ] = Seen.HAND,
    out: Annotated[Path | None, Parameter(help="Also write a file: svg, pdf, png, dxf, geojson, csv or json.")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Centre, contact and whole region of the closing motion, area and allowed position error."""
    if out is not None:
        from palmar.faces.exports.region_file import known_ending

        known_ending(out)
    name, given = open_case(case)
    if friction is not None:
        given = with_friction(given, friction, "--friction")
    if compare is not None:
        _compare(name, given, _models(compare), closure, out, json)
        return
    result = build_region(given, model, closure, _orientations(theta), _tolerance(tolerance, given))
    from_object = seen_from is Seen.OBJECT
    if out is not None:
        from palmar.faces.exports.region_file import write_region

        write_region(out, given, result, from_object=from_object)
    written = [f"Written: {out}"] if out is not None else []
    show(titled(name, given, region_text(result), *written), region_record(result, from_object=from_object), json)
    answer(not result.centre.is_empty, check)


def _tolerance(text: str | None, case: Case) -> float | None:
    """Millimetres -> m, within what can be computed and drawn for a hand of this size."""
    if text is None:
        return None
    value, length = 1e-3 * number(text, "--tolerance"), case.hand.finger_length
    if not FINEST * length <= value <= length:
        allowed = f"must be from {1e3 * FINEST * length:.2g} to {1e3 * length:.4g} mm for this hand"
        raise InputError("--tolerance", repr(text[:60]), allowed)
    return value


def _models(text: str) -> list[Model]:
    names = text.split(",")
    known = [each.value for each in Model]
    if len(names) != 2 or names[0] == names[1] or any(each not in known for each in names):
        raise InputError("--compare", repr(text[:60]), f"must be two of {', '.join(known)}, with a comma between")
    return [Model(each) for each in names]


def _compare(name: str, case: Case, models: list[Model], closure: Closure, out: Path | None, as_json: bool) -> None:
    from palmar.studies.compare import compare_regions

    if out is not None and out.suffix.lower() not in (".svg", ".pdf", ".png"):
        raise InputError("--out", str(out), "a comparison is drawn as svg, pdf or png")
    result = compare_regions(case, models, closure)
    if out is not None:
        from palmar.faces.plots.compare_picture import compare_picture
        from palmar.faces.plots.style import save

        save(compare_picture(case, result), out)
    written = [f"Written: {out}"] if out is not None else []
    show(titled(name, case, comparison_text(result), *written), comparison_record(result), as_json)


def _orientations(text: str | None) -> tuple[float, float] | None:
    """Degrees, LOW..HIGH or all -> first and last orientation (rad)."""
    if text is None:
        return None
    if text == "all":
        return 0.0, 2.0 * math.pi
    low, between, high = text.partition("..")
    first = number(low, "--theta")
    last = number(high, "--theta") if between else first
    if not first <= last <= first + 360.0 or abs(first) > 1e4:
        raise InputError("--theta", repr(text[:60]), "must be DEG, LOW..HIGH with at most 360 between, or all")
    return math.radians(first), math.radians(last)
