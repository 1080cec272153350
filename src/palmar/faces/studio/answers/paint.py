"""A grid of starts, each carried through the motion."""

from __future__ import annotations

from collections.abc import Iterator
from math import radians
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from palmar.errors import InputError
from palmar.faces.plots.hand import object_reach
from palmar.faces.studio.answers.drawing import MM
from palmar.faces.studio.answers.motion import Pair, outcomes
from palmar.faces.studio.answers.part import Part, Question, Stage
from palmar.models.case import Case
from palmar.models.guarantee import Guarantee
from palmar.models.quantity import Real, Value
from palmar.studies.simulate import simulate_starts

MOST_STARTS = 40_000
EVERY = 4
"""The first, coarse grid has every so many-th column and row."""
ROOM = 1.05
Floats = NDArray[np.float64]
Count = Annotated[int, Field(ge=2, le=400, strict=True)]


class Paint(Value):
    """The grid: x and y from the first to the last column and row; by default around the open hand."""

    x_mm: Pair | None = None
    y_mm: Pair | None = None
    columns: Count = 60
    rows: Count = 40
    theta_deg: Annotated[Real, Field(ge=-5730.0, le=5730.0)] | None = None


def coarsely(asked: Question) -> Iterator[Part]:
    """Every fourth column and row."""
    yield _painted(asked.required_case, _checked(asked), EVERY, "quick")


def wholly(asked: Question) -> Iterator[Part]:
    """The whole grid."""
    yield _painted(asked.required_case, _checked(asked), 1, "settled")


def _checked(asked: Question) -> Paint:
    given = asked.parameters(Paint)
    if given.columns * given.rows > MOST_STARTS:
        raise InputError("parameters.columns", str(given.columns), f"columns * rows must be at most {MOST_STARTS}")
    for name, pair in (("x_mm", given.x_mm), ("y_mm", given.y_mm)):
        if pair is not None and not pair[0] < pair[1]:
            raise InputError(f"parameters.{name}", str(list(pair)), "the lower end comes first")
    return given


def _painted(case: Case, given: Paint, every: int, stage: Stage) -> Part:
    xs, ys = (each[::every] for each in _lines(case, given))
    across, up = np.meshgrid(xs, ys)
    theta = case.start.theta if given.theta_deg is None else radians(given.theta_deg)
    starts = np.column_stack([across.ravel(), up.ravel(), np.full(across.size, theta)])
    codes = simulate_starts(case, starts).codes
    names, caught = outcomes()
    value: dict[str, Any] = {
        "x_mm": (MM * xs).tolist(),
        "y_mm": (MM * ys).tolist(),
        "codes": codes.tolist(),
        "names": names,
        "caught": caught,
        "counts": {name: int(np.count_nonzero(codes == code)) for code, name in enumerate(names)},
        "cell_mm": [MM * float(each[1] - each[0]) if len(each) > 1 else 0.0 for each in (xs, ys)],
    }
    return Part("outcomes", value, stage, Guarantee.SAMPLED)


def _lines(case: Case, given: Paint) -> tuple[Floats, Floats]:
    """Columns and rows (m)."""
    hand = case.hand
    far = ROOM * (hand.finger_length + object_reach(case.object))
    across = (-hand.half_palm - far, hand.half_palm + far) if given.x_mm is None else _metres(given.x_mm)
    up = (0.0, far) if given.y_mm is None else _metres(given.y_mm)
    return np.linspace(across[0], across[1], given.columns), np.linspace(up[0], up[1], given.rows)


def _metres(pair: Pair) -> Pair:
    return 1e-3 * pair[0], 1e-3 * pair[1]
