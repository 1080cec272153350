"""``palmar report``: one self-contained page about a case."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from palmar.faces.cli.jointed_texts import jointed_text
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, progress, show
from palmar.faces.cli.texts import closure_text, region_text, titled
from palmar.faces.jointed_record import jointed_record
from palmar.faces.records import closure_record, region_record
from palmar.models.shipped import open_case
from palmar.studies.report import Report, report_facts

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
    facts = report_facts(name, given, progress)
    progress("pictures")
    page = report_page(facts)
    path = make_folder(out) / f"{name}.html"
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
    return titled(facts.name, facts.case, closure, *regions, f"Page: {path}")


def _record(facts: Report, path: Path) -> dict[str, object]:
    straight, bent = closure_record(facts.closure), facts.jointed
    return {
        "page": str(path),
        "closure": straight if bent is None else jointed_record(facts.case.hand, bent),
        **({} if bent is None else {"closure_kept_straight": straight}),
        "regions": [region_record(each) for each in facts.regions],
        "uncovered": facts.uncovered,
    }
