"""``palmar report``: one self-contained page about a case."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from palmar.faces.cli.jointed_texts import jointed_text
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, progress, show
from palmar.faces.cli.strategies import strategies_text
from palmar.faces.cli.texts import closure_text, region_text, titled
from palmar.faces.closing_records import preshape_record, strategies_record
from palmar.faces.closing_words import preshape_words
from palmar.faces.jointed_record import jointed_record
from palmar.faces.records import closure_record, region_record
from palmar.models.case import Case
from palmar.models.shipped import open_case
from palmar.studies.report import Closings, Report, report_facts
from palmar.studies.strategies import winner

app = App(name="report")


@app.default
def report(
    case: CaseName,
    *,
    out: Annotated[Path, Parameter(help="Folder for the page; made if it does not exist.")],
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Write CASE.html with pictures and tables, and print the findings as text too."""
    from palmar.faces.exports.whole_file import make_folder, write_whole
    from palmar.faces.pages.report_page import report_page

    name, given = open_case(case)
    path = make_folder(out) / f"{name}.html"
    facts = report_facts(name, given, progress)
    progress("pictures")
    page = report_page(facts)
    write_whole(path, lambda partial: _write(partial, page))
    show(_text(facts, path), _record(facts, path), json)
    answer(facts.verdict.structural or facts.verdict.frictional, check)


def _write(path: Path, page: str) -> None:
    path.write_text(page, encoding="utf-8")


def _text(facts: Report, path: Path) -> str:
    regions = [region_text(each) for each in facts.regions] or [f"No region: {facts.uncovered}."]
    closure = closure_text(facts.case, facts.closure)
    if facts.jointed is not None:
        closure = jointed_text(facts.case, facts.jointed)
    closings = [] if facts.closings is None else [_closings_text(facts.case, facts.closings)]
    return titled(facts.name, facts.case, closure, *regions, *closings, f"Page: {path}")


def _closings_text(case: Case, told: Closings) -> str:
    if told.preshapes is None:
        return f"No closing strategies: {told.uncovered}."
    return f"{strategies_text(told.strategies)}\n\n{preshape_words(case, told.preshapes)}"


def _record(facts: Report, path: Path) -> dict[str, object]:
    straight, bent = closure_record(facts.closure), facts.jointed
    return {
        "page": str(path),
        "closure": straight if bent is None else jointed_record(facts.case.hand, bent),
        **({} if bent is None else {"closure_kept_straight": straight}),
        "regions": [region_record(each) for each in facts.regions],
        "uncovered": facts.uncovered,
        **({} if facts.closings is None else {"closings": _closings_record(facts.closings)}),
    }


def _closings_record(told: Closings) -> dict[str, object] | None:
    if told.preshapes is None:
        return None
    record = strategies_record(told.strategies, winner(told.strategies))
    return {**record, "preshape": preshape_record(told.preshapes)}
