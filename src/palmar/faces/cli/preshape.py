"""``palmar preshape``: the angle of the distal joint with which a disk rides on the turning finger."""

from __future__ import annotations

from math import degrees, pi, radians
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, number, show
from palmar.faces.cli.texts import table, titled
from palmar.faces.closing_records import preshape_record
from palmar.faces.closing_words import PRESHAPE_HEADS, preshape_notes, preshape_rows, preshape_words
from palmar.models.case import Case
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.studies.preshape import Preshapes
    from palmar.studies.redirect import Redirection

app = App(name="preshape")


@app.default
def preshape(
    case: CaseName,
    *,
    coming: Annotated[
        str | None,
        Parameter(
            name="--from", allow_leading_hyphen=True, help="DEG from which a free disk comes; 90 is straight ahead."
        ),
    ] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """The distal angle without rolling on a table, or without sliding in free space, and what it depends on.

    With --from: the still preshape that turns most of what comes from there to the palm.
    """
    from palmar.studies.preshape import preshapes

    name, given = open_case(case)
    if coming is not None:
        from palmar.studies.redirect import redirection

        turned = redirection(given, radians(_coming(coming)) - pi)
        show(titled(name, given, _turned_text(turned)), _turned_record(turned), json)
        answer(turned is not None, check)
        return
    found = preshapes(given)
    show(titled(name, given, _text(given, found)), preshape_record(found), json)
    answer(found.tip is not None or found.centrifugal is not None, check)


def _coming(text: str) -> float:
    value = number(text, "--from")
    if not 0.0 < value < 180.0:
        raise InputError("--from", repr(text[:60]), "must be between 0 and 180 deg, 90 is straight ahead of the palm")
    return value


def _turned_text(found: Redirection | None) -> str:
    if found is None:
        return "No preshape turns anything from there to the palm."
    hand, low, high = found.hand, *(degrees(each) + 180.0 for each in found.cone)
    from palmar.mechanics.impact.redirect_5_3_2 import width

    both = 1e3 * (width(found.catch.right) + width(found.catch.left))
    return (
        f"Base joints at {degrees(hand.base):.4g} deg, distal joints at {degrees(hand.bend):.4g} deg: paths over"
        f" {1e3 * found.catch.width:.4g} mm end at the palm,\n{1e3 * width(found.catch.direct):.4g} mm of them directly and"
        f" {both:.4g} mm by a distal link. At least half as many do from {low:.4g} to {high:.4g} deg."
    )


def _turned_record(found: Redirection | None) -> dict[str, Any]:
    if found is None:
        return {
            "base_rad": None,
            "distal_rad": None,
            "width_m": 0.0,
            "direct_m": None,
            "right_m": None,
            "left_m": None,
            "cone_rad": None,
        }
    windows = {
        f"{name}_m": list(each) if each[0] < each[1] else None
        for name, each in (("direct", found.catch.direct), ("right", found.catch.right), ("left", found.catch.left))
    }
    return {
        "base_rad": found.hand.base,
        "distal_rad": found.hand.bend,
        "width_m": found.catch.width,
        **windows,
        "cone_rad": [each + pi for each in found.cone],
        "by_direction": [{"from_rad": each.direction + pi, "width_m": each.width} for each in found.by_direction],
    }


def _text(case: Case, found: Preshapes) -> str:
    parts, rows = [preshape_words(case, found)], preshape_rows(found)
    if rows:
        parts += [table([PRESHAPE_HEADS, *rows]), "\n".join(preshape_notes(found))]
    return "\n\n".join(parts)
