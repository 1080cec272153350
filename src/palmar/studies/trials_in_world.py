"""What becomes of the object in a case's own motion, in any world: many starts, their outcomes only.

Closing goes through the kernels, or tick by tick in another world. Any other behaviour is run as ``palmar behaviours run``
does, in the planar world too.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case
from palmar.models.outcome import Outcome
from palmar.studies.run_behaviour import Circumstances, run_behaviour
from palmar.studies.simulate import simulate_starts
from palmar.studies.simulate_in_world import simulate_starts_in
from palmar.worlds.world import WorldMaker

Floats = NDArray[np.float64]
TICK = 0.02
"""Time (s) between two observations of a behaviour."""


def outcomes(case: Case, starts: Floats, make: WorldMaker | None) -> list[Outcome]:
    """Of starts (N, 3), in m and rad; ``make``: the world, None the planar one.

    Raises NotCoveredError for what the world does not have.
    """
    if case.behaviour.name is not BehaviourName.CLOSE:
        places = [(float(x), float(y), float(theta)) for x, y, theta in starts]
        around = Circumstances(tick=TICK, make=make)
        return [run_behaviour(case, each, around).trace.outcome for each in places]
    ends = simulate_starts(case, starts) if make is None else simulate_starts_in(case, starts, make)
    return [Outcome.from_code(int(code)) for code in ends.codes]


def in_one_go(case: Case, make: WorldMaker | None) -> bool:
    """Whether many starts take hardly longer than one."""
    return make is None and case.behaviour.name is BehaviourName.CLOSE


def valid(case: Case, starts: Floats) -> NDArray[np.bool_]:
    """Which starts (N, 3) do not overlap the open hand."""
    closing = case.model_copy(update={"behaviour": Behaviour()})
    found: NDArray[np.bool_] = simulate_starts(closing, starts).codes != Outcome.INVALID.code
    return found


def change_aside(case: Case, start: Sequence[float], within: Sequence[float]) -> float | None:
    """The first of these distances (m) at which the planar world catches what it loses at a start, or loses what it catches.

    Looked for in WAYS directions; None where all of that is alike.
    """
    place = np.asarray(start, dtype=float)
    here = outcomes(case, place[None], None)[0].caught
    around = np.linspace(0.0, 2.0 * np.pi, WAYS, endpoint=False)
    for far in within:
        about = place + far * np.column_stack([np.cos(around), np.sin(around), np.zeros(WAYS)])
        if any(each.caught != here for each in outcomes(case, about, None)):
            return far
    return None


WAYS = 24
"""Directions."""
