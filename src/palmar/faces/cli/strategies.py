"""``palmar strategies``: closing strategies of a hand of two joints a finger, by the region each catches from."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, progress, show
from palmar.faces.cli.texts import table, titled
from palmar.faces.closing_records import strategies_record
from palmar.faces.closing_words import STRATEGY_HEADS, search_note, strategy_rows, strategy_verdict
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.studies.strategies import Strategy

app = App(name="strategies")
ENDINGS = (".svg", ".pdf", ".png")


@app.default
def strategies(
    case: CaseName,
    *,
    out: Annotated[Path | None, Parameter(help="Also draw them: svg, pdf or png.")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Straight closing, curling first, and both joints together: areas of their regions, and the winner."""
    from palmar.studies.strategies import strategies as compared
    from palmar.studies.strategies import winner

    if out is not None and out.suffix.lower() not in ENDINGS:
        raise InputError("--out", str(out), "this is drawn as svg, pdf or png")
    name, given = open_case(case)
    found = compared(given, lambda words: progress(f"simulating: {words}"))
    best = winner(found)
    if out is not None:
        from palmar.faces.plots.strategies_picture import strategies_picture
        from palmar.faces.plots.style import save

        save(strategies_picture(given, found), out)
    written = [f"Written: {out}"] if out is not None else []
    show(titled(name, given, strategies_text(found), *written), strategies_record(found, best), json)
    answer(best.region.area > 0.0, check)


def strategies_text(found: tuple[Strategy, ...]) -> str:
    """The winner, the table, and how it was searched."""
    from palmar.studies.strategies import winner

    note = search_note(found)
    parts = [strategy_verdict(found, winner(found)), table([STRATEGY_HEADS, *strategy_rows(found)])]
    return "\n\n".join(parts + ([f"{note[0].upper()}{note[1:]}."] if note else []))
