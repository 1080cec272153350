"""Batches of starts through the closing motion of a straight-fingered hand on a table, by the event-to-event kernel."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.batch import in_parts
from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_disk import End, close_on_disk
from palmar.mechanics.pushing.closing_tables import ClosingHand, Tables, build_tables
from palmar.mechanics.pushing.limit_surface import LimitSurface

Floats = NDArray[np.float64]
ROWS_PER_TASK = 20_000
"""Up to so many starts are carried without threads."""


@dataclass(frozen=True)
class Ends:
    """How N starts ended: outcome codes (N,), poses (N, 3) as x, y (m), theta (rad), and base angles (N, 2) right, left."""

    codes: NDArray[np.int8]
    poses: Floats
    fingers: Floats


def close_disk(
    hand: ClosingHand,
    surface: LimitSurface,
    starts: ArrayLike,
    tables: Tables | None = None,
    threads: int | None = None,
) -> Ends:
    """Close a straight-fingered crossing hand on a disk from each start (N, 2), its centre in m; see closing_disk.

    ``surface`` must be rotationally symmetric about the disk's centre. ``tables`` may be passed to save building them
    again for the same hand and surface. Rows are independent, so the result does not depend on ``threads``.
    """
    hand = ClosingHand(*map(float, hand))
    places = np.ascontiguousarray(starts, dtype=float)
    codes, ends = np.empty(len(places), np.int8), np.empty((len(places), 5))
    known, alpha = tables or build_tables(hand, surface), atan(hand.friction)

    def part(some: slice) -> None:
        close_on_few(hand, known, alpha, places[some], codes[some], ends[some])

    in_parts(part, len(places), ROWS_PER_TASK, threads)
    return Ends(codes, ends[:, :3], ends[:, 3:])


@compiled
def close_on_few(
    hand: ClosingHand, tables: Tables, alpha: float, starts: Floats, codes: NDArray[np.int8], ends: Floats
) -> None:
    """Batch on one thread: ``starts`` (N, 2) -> ``codes`` (N,) and ``ends`` (N, 5) = x, y, theta, right, left."""
    for k in range(len(starts)):
        _store(close_on_disk(hand, tables, alpha, starts[k, 0], starts[k, 1]), codes, ends, k)


@compiled
def _store(end: End, codes: NDArray[np.int8], ends: Floats, k: int) -> None:
    codes[k] = end.code
    ends[k, 0], ends[k, 1], ends[k, 2] = end.x, end.y, end.theta
    ends[k, 3], ends[k, 4] = end.right, end.left
