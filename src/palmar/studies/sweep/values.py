"""The numbers of each row of a sweep: a mixed-radix count through the grids, and draws addressed by the row itself.

Draw i of a column is the i-th output of SplitMix64 (Steele, Lea and Flood 2014) from a start that depends on the seed and
the column's key, so that any stretch of rows can be made alone.
"""

from __future__ import annotations

import hashlib

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from palmar.models.sweep import Axis, Spread, Sweep

Floats = NDArray[np.float64]
Counts = NDArray[np.uint64]
STEP, FIRST, SECOND = np.uint64(0x9E3779B97F4A7C15), np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)


def values(sweep: Sweep, first: int, last: int) -> dict[str, Floats]:
    """Columns (last - first,) of the axes, in the order of the specification and the units of the file."""
    rows = np.arange(first, last, dtype=np.int64)
    cell, columns = rows // sweep.samples, {}
    for axis in reversed(sweep.grids):
        cell, here = np.divmod(cell, len(axis.numbers))
        columns[axis.key] = np.asarray(axis.numbers)[here]
    for axis in sweep.axes:
        if axis.spread is not Spread.GRID:
            columns[axis.key] = _drawn(axis, sweep.seed, rows)
    return {axis.key: columns[axis.key] for axis in sweep.axes}


def _drawn(axis: Axis, seed: int, rows: NDArray[np.int64]) -> Floats:
    share, (one, other) = uniform(f"{seed}:{axis.key}", rows), axis.numbers
    if axis.spread is Spread.NORMAL:
        normal: Floats = one + other * ndtri(share)
        return normal
    if axis.spread is Spread.LOG_UNIFORM:
        even: Floats = one * (other / one) ** share
        return even
    drawn: Floats = one + (other - one) * share
    return drawn


def uniform(key: str, rows: NDArray[np.int64]) -> Floats:
    """Numbers strictly between 0 and 1 of rows (N,), for the stream of a key."""
    start = np.frombuffer(hashlib.sha256(key.encode()).digest()[:8], np.uint64)[0]
    with np.errstate(over="ignore"):
        z: Counts = start + (rows.astype(np.uint64) + np.uint64(1)) * STEP
        z = (z ^ (z >> np.uint64(30))) * FIRST
        z = (z ^ (z >> np.uint64(27))) * SECOND
        z = z ^ (z >> np.uint64(31))
    found: Floats = ((z >> np.uint64(12)).astype(np.float64) + 0.5) * 2.0**-52
    return found
