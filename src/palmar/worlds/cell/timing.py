"""How well a run in real time kept its times."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from palmar.worlds.cell.wire import Sightings

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Timing:
    """Of one run. ``late``: how late (s) each servo tick began; ``replies``: how long (s) each reply took; ``slipped``:
    time (s) by which ticks were put off; ``ranked``: whether the system gave the servos real-time priority (SCHED_FIFO);
    ``ended``, ``at_rest``: when (s) the cell ended, and came to rest (None: never); ``fault_s``: when (s) the fault set in,
    None: not before the end.
    """

    simulated: float
    wall: float
    late: Floats
    replies: Floats
    slipped: float
    asked: int
    missed: int
    malformed: int
    outdated: int
    ranked: bool
    ended: float
    sightings: Sightings = field(default_factory=Sightings)
    at_rest: float | None = None
    fault_s: float | None = None


def percentiles(seconds: Iterable[Floats]) -> dict[str, float | None]:
    """Median, 95th and 99th percentile and the greatest of all (s); None where there are none."""
    every = np.concatenate([*seconds, np.zeros(0)])
    if not len(every):
        return {"median": None, "p95": None, "p99": None, "max": None}
    median, high, higher = np.percentile(every, (50.0, 95.0, 99.0)).tolist()
    return {"median": median, "p95": high, "p99": higher, "max": float(every.max())}
