"""The report of one case as one self-contained HTML page: pictures inside, no request leaves it."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from importlib import resources
from importlib.metadata import version

from palmar.faces.closing_words import (
    PRESHAPE_HEADS,
    STRATEGY_HEADS,
    preshape_notes,
    preshape_rows,
    preshape_words,
    search_note,
    strategy_rows,
    strategy_verdict,
)
from palmar.faces.pages.html import picture, table
from palmar.faces.plots.bent_picture import bent_picture
from palmar.faces.plots.closure_picture import closure_picture
from palmar.faces.plots.region_picture import region_pictures
from palmar.faces.plots.strategies_picture import strategies_picture
from palmar.faces.words import (
    carried_rows,
    change_line,
    closure_rows,
    headline,
    jointed_rows,
    region_notes,
    region_rows,
    slope_row,
)
from palmar.models.case import Case
from palmar.models.case_file import dump_case
from palmar.studies.closure import ClosureAnswer
from palmar.studies.jointed_closure import JointedClosure
from palmar.studies.report import Closings, Report
from palmar.studies.strategies import winner

CAREFULLY = "This is a quick search, with coarser spacings than palmar strategies has."


def report_page(report: Report) -> str:
    """The page's HTML."""
    title = headline(report.name, report.case)
    style = resources.files("palmar.faces.pages").joinpath("report.css").read_text(encoding="utf-8")
    body = [f"<h1>{escape(title)}</h1>", *_closure(report), *_regions(report)]
    if report.closings is not None:
        body += _closings(report.case, report.closings)
    body += _input(report)
    return "\n".join(
        [
            '<!doctype html><html lang="en"><head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escape(report.name)} - palmar</title><style>{style}</style></head><body><main>",
            *body,
            f"<footer>palmar {escape(version('palmar'))}</footer></main></body></html>",
        ]
    )


def _closure(report: Report) -> list[str]:
    parts = ["<h2>Can the hand hold it?</h2>", f'<p class="answer">{escape(_sentence(report.verdict.reason))}</p>']
    if report.jointed is None:
        return parts + _straight(report)
    bent = report.jointed
    parts += [table(("", "radii", "verdict"), jointed_rows(report.case, bent))]
    parts += [picture(bent_picture(report.case, bent), "Hand with its fingers bent around the largest disk it holds")]
    if bent.cases:
        parts += [table(("held without friction by", "radii"), carried_rows(bent.cases))]
    parts += [*_moves(bent), *_notes([_sentence(each) for each in bent.notes])]
    if bent.coupled:
        return parts
    said = report.closure.object.reason
    parts += [
        "<h3>With the fingers kept straight</h3>",
        f"<p>{escape(_sentence(said))}</p>",
    ]
    return parts + _straight(report)


def _straight(report: Report) -> list[str]:
    """What straight fingers hold: all there is to say of fingers of one link."""
    result = report.closure
    parts = [table(("", "radii", "verdict"), closure_rows(report.case, result))]
    parts += [picture(closure_picture(report.case, result), "Hand with the smallest and the largest disk it holds")]
    return parts + _moves(result) + _notes([_sentence(each) for each in result.notes])


def _moves(result: ClosureAnswer | JointedClosure) -> list[str]:
    """What to change so that the object is held, and how the limits move."""
    parts = []
    if result.changes:
        parts += ["<h3>What would have to change</h3>", _list(change_line(each) for each in result.changes)]
    if result.slopes:
        parts += ["<h3>How the limits move</h3>"]
        parts += [table(("change", "largest radius", "smallest radius"), [slope_row(each) for each in result.slopes])]
    return parts


def _regions(report: Report) -> list[str]:
    parts = ["<h2>From where does closing catch it?</h2>"]
    if report.uncovered is not None:
        return [*parts, f"<p>No region: {escape(_sentence(report.uncovered))}</p>"]
    caught = [each for each in report.regions if each.reason is None]
    parts += [f"<p>Nothing is caught: {escape(_sentence(each.reason))}</p>" for each in report.regions if each.reason]
    if not caught:
        return parts
    parts.append(picture(region_pictures(report.case, caught), "Regions from which the closing motion catches it"))
    columns = [{row[0]: row[1] for row in region_rows(each)} for each in caught]
    names = dict.fromkeys(name for column in columns for name in column)
    rows = [(name, *(column.get(name, "") for column in columns)) for name in names]
    parts.append(table(("", *(each.closure.value for each in caught)), rows))
    return parts + _notes(region_notes(caught))


def _closings(case: Case, told: Closings) -> list[str]:
    """Strategies side by side, and the preshapes that theory gives."""
    parts = ["<h2>How should two joints a finger close?</h2>"]
    if told.preshapes is None:
        return [*parts, f"<p>No comparison: {escape(told.uncovered or '')}.</p>"]
    found = told.strategies
    parts += [f'<p class="answer">{escape(strategy_verdict(found, winner(found)))}</p>']
    if any(not each.region.centre.is_empty for each in found):
        parts.append(picture(strategies_picture(case, found), "Regions of the closing strategies side by side"))
    parts.append(table(STRATEGY_HEADS, strategy_rows(found)))
    note = search_note(found)
    parts += _notes(([_sentence(note)] if note else []) + [CAREFULLY])
    parts += ["<h3>The preshape of theory</h3>", f"<p>{escape(preshape_words(case, told.preshapes))}</p>"]
    rows = preshape_rows(told.preshapes)
    return parts + ([table(PRESHAPE_HEADS, rows)] if rows else []) + _notes(preshape_notes(told.preshapes))


def _input(report: Report) -> list[str]:
    return ["<h2>The case</h2>", f"<pre>{escape(dump_case(report.case))}</pre>"]


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def _notes(sentences: list[str]) -> list[str]:
    return [f'<ul class="notes">{"".join(f"<li>{escape(each)}</li>" for each in sentences)}</ul>'] if sentences else []


def _list(texts: Iterable[str]) -> str:
    return f"<ul>{''.join(f'<li>{escape(each)}</li>' for each in texts)}</ul>"
