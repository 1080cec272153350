"""``palmar closure``: can this hand hold it, and what size of hand would."""

from __future__ import annotations

import math
from typing import Annotated

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.closure_map import closure_map_command
from palmar.faces.cli.jointed_texts import jointed_text
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, number, show
from palmar.faces.cli.texts import closure_text, titled
from palmar.faces.jointed_record import jointed_record
from palmar.faces.records import closure_record, sizing_record
from palmar.faces.words import sizing_line
from palmar.models.shipped import open_case
from palmar.studies.closure import closure_answer
from palmar.studies.jointed_closure import bends, jointed_closure
from palmar.studies.sizing import size_hand

app = App(name="closure")
app.command(closure_map_command, name="map")


@app.default
def closure(case: CaseName, *, json: AsJson = False, check: Check = False) -> None:
    """Which radii the hand holds, structurally and with friction, and whether it holds this object."""
    name, given = open_case(case)
    if bends(given):
        bent = jointed_closure(given)
        show(titled(name, given, jointed_text(given, bent)), jointed_record(given.hand, bent), json)
        answer(bent.object.structural or bent.object.frictional, check)
        return
    result = closure_answer(given)
    show(titled(name, given, closure_text(given, result)), closure_record(result), json)
    answer(result.object.structural or result.object.frictional, check)


@app.command
def size(
    *,
    radius: Annotated[
        str, Parameter(help="Radii to hold in mm, SMALLEST..LARGEST, or one radius.", allow_leading_hyphen=True)
    ],
    palm_width: Annotated[str | None, Parameter(help="Given palm width in mm.", allow_leading_hyphen=True)] = None,
    finger_length: Annotated[
        str | None, Parameter(help="Given finger length in mm.", allow_leading_hyphen=True)
    ] = None,
    friction: Annotated[
        str, Parameter(help="Friction; 0 asks for a structural hold.", allow_leading_hyphen=True)
    ] = "0",
    thickness: Annotated[str, Parameter(help="Finger thickness in mm.", allow_leading_hyphen=True)] = "0",
    colliding: Annotated[bool, Parameter(negative="", help="The fingers lie in one plane.")] = False,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """The finger length that suffices for a palm width, or the palm width for a finger length, or why none does."""
    smallest, largest = _radii(radius)
    given = {"--palm-width": palm_width, "--finger-length": finger_length}
    if sum(value is not None for value in given.values()) != 1:
        raise InputError("--palm-width, --finger-length", None, "give exactly one of the two, the other is sought")
    palm, finger = (None if text is None else 1e-3 * _positive(text, option) for option, text in given.items())
    mu, thick = number(friction, "--friction"), 1e-3 * number(thickness, "--thickness")
    if mu < 0.0 or thick < 0.0:
        raise InputError(
            "--friction" if mu < 0.0 else "--thickness", friction if mu < 0.0 else thickness, "must be at least 0"
        )
    result = size_hand(smallest, largest, palm, finger, math.atan(mu), thick, crossing=not colliding)
    show(sizing_line(result), sizing_record(result), json)
    answer(bool(result.intervals), check)


def _radii(text: str) -> tuple[float, float]:
    low, _, high = text.partition("..")
    smallest, largest = 1e-3 * _positive(low, "--radius"), 1e-3 * _positive(high or low, "--radius")
    if smallest > largest:
        raise InputError("--radius", repr(text), "the smaller radius comes first")
    return smallest, largest


def _positive(text: str, option: str) -> float:
    value = number(text, option)
    if not 0.0 < value <= 1e6:
        raise InputError(option, repr(text), "must be greater than 0 and at most 1000000 mm")
    return value
