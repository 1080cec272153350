"""Batches of starts through the closing motion of a straight-fingered hand on a table, by the event-to-event kernel."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan

import numba
import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.pushing.closing_disk import End, close_on_disk
from palmar.mechanics.pushing.closing_tables import ClosingHand, Tables, build_tables
from palmar.mechanics.pushing.compiled import compiled
from palmar.mechanics.pushing.limit_surface import LimitSurface

Floats = NDArray[np.float64]
FEW = 2000
"""Up to so many starts are carried without threads."""


@dataclass(frozen=True)
class Ends:
    """How N starts ended: outcome codes (N,), poses (N, 3) as x, y (m), theta (rad), and base angles (N, 2) right, left."""

    codes: NDArray[np.int8]
    poses: Floats
    fingers: Floats


def close_disk(hand: ClosingHand, surface: LimitSurface, starts: ArrayLike, tables: Tables | None = None) -> Ends:
    """Close a straight-fingered crossing hand on a disk from each start (N, 2), its centre in m; see closing_disk.

    ``surface`` must be rotationally symmetric about the disk's centre. ``tables`` may be passed to save building them
    again for the same hand and surface.
    """
    hand = ClosingHand(*map(float, hand))
    places = np.ascontiguousarray(starts, dtype=float)
    codes, ends = np.empty(len(places), np.int8), np.empty((len(places), 5))
    kernel = close_on_few if len(places) <= FEW else close_on_disks
    kernel(hand, tables or build_tables(hand, surface), atan(hand.friction), places, codes, ends)
    return Ends(codes, ends[:, :3], ends[:, 3:])


@compiled
def close_on_few(
    hand: ClosingHand, tables: Tables, alpha: float, starts: Floats, codes: NDArray[np.int8], ends: Floats
) -> None:
    """``close_on_disks`` without threads, whose launch costs more than a few starts do."""
    for k in range(len(starts)):
        _store(close_on_disk(hand, tables, alpha, starts[k, 0], starts[k, 1]), codes, ends, k)


@compiled
def _store(end: End, codes: NDArray[np.int8], ends: Floats, k: int) -> None:
    codes[k] = end.code
    ends[k, 0], ends[k, 1], ends[k, 2] = end.x, end.y, end.theta
    ends[k, 3], ends[k, 4] = end.right, end.left


@numba.njit(parallel=True, cache=True, error_model="numpy")
def close_on_disks(
    hand: ClosingHand, tables: Tables, alpha: float, starts: Floats, codes: NDArray[np.int8], ends: Floats
) -> None:
    """Batch: ``starts`` (N, 2) -> ``codes`` (N,) and ``ends`` (N, 5) = x, y, theta, right, left; parallel, no order."""
    for k in numba.prange(len(starts)):
        _store(close_on_disk(hand, tables, alpha, starts[k, 0], starts[k, 1]), codes, ends, k)
