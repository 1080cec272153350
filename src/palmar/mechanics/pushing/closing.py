"""Batches of starts through the closing motion of a straight-fingered hand on a table, by the event-to-event kernel."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.pushing.closing_disk import close_on_disks
from palmar.mechanics.pushing.closing_tables import ClosingHand, Tables, build_tables
from palmar.mechanics.pushing.limit_surface import LimitSurface

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Ends:
    """How N starts ended: outcome codes (N,), poses (N, 3) as x, y (m), theta (rad), and base angles (N, 2) right, left."""

    codes: NDArray[np.int8]
    poses: Floats
    fingers: Floats


def close_disk(hand: ClosingHand, surface: LimitSurface, starts: ArrayLike, tables: Tables | None = None) -> Ends:
    """Close a straight-fingered crossing hand on a disk from each start (N, 2), its centre in m; see closing_disk.

    ``surface`` must be rotationally symmetric about the disk's centre. Thick fingers only without friction.
    ``tables`` may be passed to save building them again for the same hand and surface.
    """
    if hand.half_thickness > 0.0 and hand.friction > 0.0:
        raise ValueError("thick fingers with friction are for the stepping kernel")
    hand = ClosingHand(*map(float, hand))
    places = np.ascontiguousarray(starts, dtype=float)
    codes, ends = np.empty(len(places), np.int8), np.empty((len(places), 5))
    close_on_disks(hand, tables or build_tables(hand, surface), atan(hand.friction), places, codes, ends)
    return Ends(codes, ends[:, :3], ends[:, 3:])
