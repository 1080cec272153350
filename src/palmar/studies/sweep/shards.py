"""One shard of a sweep: a stretch of rows, answered and written. What every engine calls, in whatever process."""

from __future__ import annotations

from time import perf_counter

import numpy as np
import pyarrow as pa

from palmar.mechanics.batch import allotted
from palmar.models.sweep import Sweep
from palmar.studies.sweep.answers import NOT_ANSWERED, OUTCOMES, answers
from palmar.studies.sweep.store import Store
from palmar.studies.sweep.values import values


def shard_table(sweep: Sweep, first: int, last: int) -> pa.Table:
    """Rows ``first`` to ``last`` (excluded): row, the numbers by their keys, the answers, ``error`` where none.

    On one processor: the others have shards of their own.
    """
    given = values(sweep, first, last)
    with allotted(1):
        found, reasons = answers(sweep, given)
    columns = {"row": pa.array(np.arange(first, last)), **{key: pa.array(column) for key, column in given.items()}}
    for name, column in found.items():
        if name == "outcome":
            columns |= _outcomes(column)
        else:
            columns[name] = pa.array(column, mask=np.isnan(column))
    columns["error"] = pa.array(reasons, pa.string())
    return pa.table(columns)


def _outcomes(codes: np.ndarray) -> dict[str, pa.Array]:
    none = codes == NOT_ANSWERED
    words = pa.DictionaryArray.from_arrays(pa.array(codes, mask=none), pa.array(OUTCOMES))
    caught = np.array([True, True, True, *[False] * (len(OUTCOMES) - 3)])[np.where(none, 0, codes)]
    return {"outcome": words, "caught": pa.array(caught, mask=none)}


def run_shard(sweep: Sweep, url: str, shard: int, stretch: tuple[int, int]) -> tuple[int, int, float]:
    """Answer and write a shard; (its number, its rows, seconds)."""
    began = perf_counter()
    Store(url).write(shard, shard_table(sweep, *stretch))
    return shard, stretch[1] - stretch[0], perf_counter() - began


def rate(sweep: Sweep, rows: int) -> float:
    """Rows a second in this process, from the last of a few tries with more and more of up to so many rows."""
    number = 1
    while True:
        began = perf_counter()
        shard_table(sweep, 0, min(number, rows))
        took = perf_counter() - began
        if number >= rows or (took > 0.2 and number > 1):
            return min(number, rows) / max(took, 1e-6)
        number *= 8
