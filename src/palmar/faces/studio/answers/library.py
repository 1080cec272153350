"""Cases in and out: the shipped ones, TOML texts, and a case's tables."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from palmar.faces.studio.answers.part import Part, Question
from palmar.models.case import Case
from palmar.models.case_file import case_tables, dump_tables, parse_case
from palmar.models.quantity import Value
from palmar.models.shipped import description, shipped_names, shipped_text


class Shipped(Value):
    """The name of a shipped case; None lists them."""

    name: str | None = None


class Text(Value):
    """A case file's text."""

    text: str


def cases(asked: Question) -> Iterator[Part]:
    """The shipped cases, or one of them."""
    name = asked.parameters(Shipped).name
    if name is None:
        known = [{"name": each, "description": description(each)} for each in shipped_names()]
        yield Part("cases", {"cases": known})
        return
    text = shipped_text(name)
    yield Part("case", {"name": name, **case_value(parse_case(text, name)), "toml": text})


def read_toml(asked: Question) -> Iterator[Part]:
    """A case from a text that was dropped onto the page."""
    yield Part("case", case_value(parse_case(asked.parameters(Text).text)))


def write_toml(asked: Question) -> Iterator[Part]:
    """The case as a text."""
    yield Part("case", case_value(asked.required_case))


def case_value(case: Case) -> dict[str, Any]:
    """A case as a TOML text and as tables with all their keys."""
    tables = case_tables(case)
    return {"toml": dump_tables(tables), "case": tables}
