"""The source's numbers beside palmar's: the record of `palmar figures numbers`, and the same in words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from palmar.faces.cli.texts import table
from palmar.faces.words import Row
from palmar.studies.source_numbers import SourceNumber

NOTHING = 1e-12
"""Differences below this are rounding."""


def source_numbers_record(numbers: Sequence[SourceNumber]) -> dict[str, Any]:
    """`palmar figures numbers --json`; units as the source has them."""
    return {"numbers": [_record(each) for each in numbers]}


def source_numbers_text(numbers: Sequence[SourceNumber]) -> str:
    """A table, and below it why some differ."""
    heads: Row = ("section", "what", "source", "palmar", "difference", "guarantee")
    rows: list[Row] = [heads, *map(_row, numbers)]
    why = [f"{each.section}, {each.what}: {each.why}." for each in numbers if each.why]
    return "\n\n".join([table(rows), "\n".join(why)])


def amount(values: Sequence[float] | None, unit: str, digits: int = 4) -> str:
    """A number, or a few that belong together, with its unit."""
    if values is None:
        return "none"
    words = ", ".join(f"{0.0 if abs(each) < NOTHING else each:.{digits}g}" for each in values)
    return f"({words})" if len(values) > 1 else f"{words} {unit}".strip()


def _row(each: SourceNumber) -> Row:
    difference = "" if each.difference is None else amount(each.difference, "", 2)
    printed, found = (amount(values, each.unit) for values in (each.printed, each.found))
    return each.section, each.what, printed, found, difference, each.guarantee.value


def _record(each: SourceNumber) -> dict[str, Any]:
    return {
        "chapter": each.chapter,
        "section": each.section,
        "figure": each.figure,
        "what": each.what,
        "unit": each.unit,
        "source": list(each.printed),
        "palmar": None if each.found is None else list(each.found),
        "difference": None if each.difference is None else list(each.difference),
        "guarantee": each.guarantee.value,
        "why": each.why,
    }
