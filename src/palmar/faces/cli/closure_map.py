"""``palmar closure map``: what 4-jointed hands hold, over the lengths of both links."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
from cyclopts import Parameter

from palmar.errors import InputError
from palmar.faces.cli.jointed_texts import map_text
from palmar.faces.cli.printing import AsJson, number, show
from palmar.faces.jointed_record import map_record
from palmar.studies.closure_map import ClosureMap, closure_map, grid_map

LARGEST_GRID, MOST_POINTS = 1000, 100_000
FORM = "must be Q,P;Q,P;...: distal and proximal link as shares of half the hand"


def closure_map_command(
    *,
    grid: Annotated[str | None, Parameter(help="N: a map of N x N hands.", allow_leading_hyphen=True)] = None,
    points: Annotated[
        str | None, Parameter(help='"Q,P;Q,P;...": distal and proximal links.', allow_leading_hyphen=True)
    ] = None,
    out: Annotated[Path | None, Parameter(help="Also draw it: svg, pdf or png.")] = None,
    json: AsJson = False,
) -> None:
    """Largest and smallest radius of 4-jointed hands by the links that carry the disk; half palm = 1 - Q - P."""
    if (grid is None) == (points is None):
        raise InputError("--grid, --points", None, "give exactly one of the two")
    if out is not None and out.suffix.lower() not in (".svg", ".pdf", ".png"):
        raise InputError("--out", str(out), "this is drawn as svg, pdf or png")
    result = grid_map(_count(grid)) if grid is not None else _at_points(points or "")
    if out is not None:
        from palmar.faces.plots.closure_map_picture import map_picture
        from palmar.faces.plots.style import save

        asked = zip(result.distal, result.proximal, strict=True) if points is not None else ()
        shown = [(distal, proximal) for distal, proximal in asked if distal + proximal < 1.0]
        save(map_picture(shown), out)
    text = map_text(result)
    show(text if out is None else f"{text}\n\nWritten: {out}", map_record(result), json)


def _count(text: str) -> int:
    allowed = f"must be a whole number from 2 to {LARGEST_GRID}"
    try:
        count = int(text)
    except ValueError:
        raise InputError("--grid", repr(text[:60]), allowed) from None
    if not 2 <= count <= LARGEST_GRID:
        raise InputError("--grid", repr(text[:60]), allowed)
    return count


def _at_points(text: str) -> ClosureMap:
    parts = text.strip().removesuffix(";").split(";")
    if len(parts) > MOST_POINTS:
        raise InputError("--points", f"{len(parts)} points", f"at most {MOST_POINTS} are taken")
    places = [_point(part) for part in parts]
    distal, proximal = np.array(places).T
    return closure_map(distal, proximal)


def _point(text: str) -> tuple[float, float]:
    pair = text.split(",")
    if len(pair) != 2:
        raise InputError("--points", repr(text[:60]), FORM)
    distal, proximal = (number(each, "--points") for each in pair)
    if distal < 0.0 or proximal < 0.0:
        raise InputError("--points", repr(text[:60]), "both links must be at least 0")
    return distal, proximal
