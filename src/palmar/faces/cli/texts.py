"""Whole answers as text for the terminal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from palmar.faces.words import Row, change_line, closure_rows, headline, region_rows, resting_rows, slope_row
from palmar.models.case import Case
from palmar.regions.region import Region
from palmar.studies.closure import ClosureAnswer

if TYPE_CHECKING:
    from palmar.studies.compare import Comparison


def closure_text(case: Case, result: ClosureAnswer) -> str:
    """The answer of `palmar closure CASE`."""
    lines = [table(closure_rows(case, result)), "", f"This object: {result.object.reason}."]
    if result.changes:
        lines += ["", "One of these changes alone would do:", *(f"  {change_line(each)}" for each in result.changes)]
    if result.slopes:
        heads = ("How the limits move", "largest radius", "smallest radius")
        lines += ["", table([heads, *(slope_row(each) for each in result.slopes)])]
    return "\n".join(lines + notes(result.notes))


def region_text(region: Region) -> str:
    """The answer of `palmar region CASE`."""
    if region.reason is not None:
        lines = [f"Nothing is caught ({region.closure.value}): {region.reason}."]
        lines += [f"{name}: {value}." for name, value in resting_rows(region)]
    else:
        lines = [table(region_rows(region))]
    return "\n".join(lines + notes(region.notes))


def comparison_text(result: Comparison) -> str:
    """The answer of `palmar region CASE --compare A,B`."""
    rows = [(each.model.value, f"{1e4 * each.area:.4g} cm2", each.guarantee.meaning) for each in result.regions]
    lines = [table([("model", "area of the centre region", "guarantee"), *rows]), ""]
    for each in result.differences:
        x, y = (1e3 * value for value in each.start)
        found = each.outcome is not None and each.outcome.caught
        seen = "" if each.outcome is None else f"; from ({x:.2f}, {y:.2f}) mm, simulated: {each.outcome.value}"
        lines.append(
            f"{each.promised_by.value} {'finds' if found else 'promises'} {1e4 * each.where.area:.4g} cm2 that "
            f"{each.denied_by.value} does not{seen}."
        )
    if not result.differences:
        lines.append("They do not differ.")
    heads = ("farthest first contact", *(each.model.value for each in result.regions))
    reaches = [
        (f"at {math.degrees(each.angle):.0f} deg about a base joint", *(_millimetres(one) for one in each.distances))
        for each in result.reaches
    ]
    return "\n".join([*lines, "", table([heads, *reaches])])


def _millimetres(length: float | None) -> str:
    return "-" if length is None else f"{1e3 * length:.1f} mm"


def titled(name: str, case: Case, *parts: str) -> str:
    """The headline and the parts, with blank lines between."""
    return "\n\n".join([headline(name, case), *parts])


def notes(texts: tuple[str, ...]) -> list[str]:
    """Notes as lines, after a blank one."""
    return ["", *(f"Note: {each}." for each in texts)] if texts else []


def table(rows: Sequence[Row]) -> str:
    """Rows of text in columns, two spaces apart; the last column is not padded."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]) - 1)]
    padded = ([*(f"{cell:<{width}}" for cell, width in zip(row[:-1], widths, strict=True)), row[-1]] for row in rows)
    return "\n".join("  ".join(row) for row in padded)
