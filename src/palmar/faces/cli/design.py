"""``palmar design``: from what a hand is to hold and to tolerate to the smallest hand that does, or why there is none."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, Check, answer, progress, show
from palmar.models.design_brief_file import open_brief

app = App(name="design")
MOST_CASES, MOST_POINTS = 10_000_000, 50


@app.default
def design(
    brief: Annotated[str, Parameter(help="A brief (TOML), or the name of a shipped one.", show_default=False)],
    *,
    front: Annotated[int, Parameter(help="Points of the front of hand size against tolerated error.")] = 0,
    links: Annotated[bool, Parameter(negative="", help="Also the smallest hand by number of links a finger.")] = False,
    cases: Annotated[int, Parameter(help="Random cases in which the hand is tried.")] = 100_000,
    seed: Annotated[int, Parameter(help="Of these cases.")] = 0,
    out: Annotated[Path | None, Parameter(help="Also draw front and hand: svg, pdf or png.")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """The smallest hand for a brief, what binds, how it was verified; or a reason why there is none."""
    from palmar.faces.design_record import design_record
    from palmar.faces.design_words import design_text
    from palmar.studies.design.design import design as designed

    _within("--front", front, 0, MOST_POINTS)
    _within("--cases", cases, 1, MOST_CASES)
    _within("--seed", seed, 0, 2**32 - 1)
    if out is not None and out.suffix.lower() not in (".svg", ".pdf", ".png"):
        raise InputError("--out", str(out), "a design is drawn as svg, pdf or png")
    name, given = open_brief(brief)
    if given.targets.error > 0.0:
        progress("searching, which takes a minute or two for polygons, fingers that curl, and plans by touch")
    found = designed(given, cases, seed, front)
    text = design_text(name, found, by_links=links)
    if out is not None:
        if found.chosen is None:
            raise InputError("--out", str(out), "there is no hand to draw: " + (found.because or ""))
        from palmar.faces.plots.design_picture import design_picture
        from palmar.faces.plots.style import save

        save(design_picture(found), out)
        text = f"{text}\n\nWritten: {out}"
    show(text, design_record(found), json)
    answer(found.chosen is not None, check)


def _within(option: str, value: int, low: int, high: int) -> None:
    if not low <= value <= high:
        raise InputError(option, str(value), f"must be from {low} to {high}")
