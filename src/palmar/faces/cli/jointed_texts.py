"""Closure of jointed fingers, and maps of it, as text for the terminal."""

from __future__ import annotations

import numpy as np

from palmar.faces.cli.texts import notes, table
from palmar.faces.words import carried_rows, change_line, jointed_rows, slope_row
from palmar.models.case import Case
from palmar.studies.closure_map import ClosureMap
from palmar.studies.jointed_closure import JointedClosure


def jointed_text(case: Case, result: JointedClosure) -> str:
    """The answer of `palmar closure CASE` for fingers with joints."""
    lines = [table(jointed_rows(case, result)), "", f"This object: {result.object.reason}."]
    if result.cases:
        lines += ["", table([("Held without friction by", "radii"), *carried_rows(result.cases)])]
    if result.changes:
        lines += ["", "One of these changes alone would do:", *(f"  {change_line(each)}" for each in result.changes)]
    if result.slopes:
        heads = ("How the limits move", "largest radius", "smallest radius")
        lines += ["", table([heads, *(slope_row(each) for each in result.slopes)])]
    return "\n".join(each.rstrip() for each in "\n".join(lines + notes(result.notes)).split("\n"))


def map_text(result: ClosureMap) -> str:
    """The answer of `palmar closure map`: each point of a few, else the best hand of each case."""
    count = result.distal.size
    if count <= POINTS_SHOWN:
        heads = ("distal", "proximal", *(_title(name) for name in result.radius_max))
        columns = [result.distal, result.proximal, *result.radius_max.values()]
        return table([heads, *(tuple(map(_number, row)) for row in zip(*columns, strict=True))])
    rows: list[tuple[str, ...]] = [("case", "largest radius", "distal", "proximal")]
    for name, radii in result.radius_max.items():
        best = int(np.nanargmax(radii)) if np.isfinite(radii).any() else None
        found = ("none", "-", "-") if best is None else (radii[best], result.distal[best], result.proximal[best])
        rows.append((_title(name), *(each if isinstance(each, str) else _number(each) for each in found)))
    return f"{count} hands, lengths as shares of half the hand\n\n{table(rows)}"


POINTS_SHOWN = 40


def _title(name: str) -> str:
    return name.replace("_", ", ")


def _number(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.7g}"
