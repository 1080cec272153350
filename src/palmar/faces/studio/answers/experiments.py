"""The source's figures redone, and the facts of a report."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial
from typing import Annotated, Any

from pydantic import Field

from palmar.errors import InputError
from palmar.faces.jointed_record import jointed_record
from palmar.faces.plots.source_figures import FIGURES
from palmar.faces.plots.style import encoded
from palmar.faces.records import closure_record, region_facts
from palmar.faces.source_numbers_record import source_numbers_record
from palmar.faces.studio.answers.part import Part, Question
from palmar.models.case import Case
from palmar.models.quantity import Value
from palmar.studies.report import report_facts
from palmar.studies.source_numbers import source_numbers


class Shown(Value):
    """One figure by its number, the numbers of a chapter, or the facts about the case; else the list of figures."""

    figure: str | None = None
    numbers: Annotated[int, Field(ge=1, le=8, strict=True)] | None = None
    facts: bool = False


def experiments(asked: Question) -> Iterator[Part]:
    """What was asked for."""
    given = asked.parameters(Shown)
    if given.facts:
        yield _facts(asked.required_case)
    elif given.numbers is not None:
        yield Part("numbers", _numbers(given.numbers))
    elif given.figure is not None:
        yield _figure(given.figure)
    else:
        known = [{"number": number, "title": title_of(number)} for number in FIGURES]
        yield Part("list", {"figures": known})


@cache
def _numbers(chapter: int) -> dict[str, Any]:
    """As ``palmar figures numbers``; they depend on nothing."""
    return source_numbers_record(source_numbers(chapter))


def known_figure(number: str) -> str:
    """The number, if there is such a figure; raises InputError."""
    if number not in FIGURES:
        raise InputError("parameters.figure", repr(number[:60]), f"must be one of {', '.join(FIGURES)}")
    return number


def title_of(number: str) -> str:
    """What a figure shows, in a line."""
    draw = FIGURES[number]
    words = str(draw.args[-1]) if isinstance(draw, partial) else str(draw.__doc__).strip().splitlines()[0]
    words = words.removeprefix(f"Figure {number}: ").removesuffix(".")
    return words[0].upper() + words[1:]


def _figure(number: str) -> Part:
    svg = encoded(FIGURES[known_figure(number)]()).decode("utf-8")
    return Part("figure", {"number": number, "title": title_of(number), "svg": svg})


def _facts(case: Case) -> Part:
    """As ``palmar report``, the regions without their coordinates."""
    found = report_facts("case", case, lambda step: None)
    bent = found.jointed
    value = {
        "closure": closure_record(found.closure) if bent is None else jointed_record(case.hand, bent),
        "regions": [region_facts(each) for each in found.regions],
        "uncovered": found.uncovered,
    }
    return Part("facts", value)
