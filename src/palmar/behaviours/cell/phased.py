"""What the cell's behaviours have in common: a state with a phase, one step at each request of the arm, and an end.

A behaviour says what it does in each phase; ending, stopping and waiting for vision are the same for all.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import ClassVar, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from palmar.behaviours.cell.arm_path import ArmPath, halt
from palmar.behaviours.cell.sightings import Seen
from palmar.models.cell_messages import CellEnd, CellOrder, CellSeen, HandOrder

Floats = NDArray[np.float64]
PATIENCE = 1.0
"""How long (s) the arm waits for a fresh sighting or the fingers for a grip."""
TIRED = 25.0
"""A motion by vision that takes longer (s), because sightings are hardly ever fresh, is given up."""
GIVEN_WAY = 0.05
"""Curl (rad) by which fingers have closed further when what they held is gone."""


@dataclass(frozen=True)
class PhaseState:
    """Phase and when it began (s), the arm's set-point, sightings, curls (rad) at the grip, approaches so far, the end."""

    phase: Enum
    since: float
    path: ArmPath
    seen: Seen = field(default_factory=Seen)
    gripped_at: tuple[float, float, float] | None = None
    approaches: int = 0
    end: CellEnd | None = None


S = TypeVar("S", bound=PhaseState)


class Phased(ABC, Generic[S]):
    """A behaviour that goes from phase to phase; in those of ``guided`` the arm moves by what vision says."""

    guided: ClassVar[frozenset[Enum]]

    @abstractmethod
    def begin(self, pose: Floats, time: float) -> S:
        """At the arm's present set-point of the hand frame (4, 4)."""

    @abstractmethod
    def in_phase(self, state: S, seen: CellSeen) -> S:
        """What the present phase does at one request."""

    @abstractmethod
    def hand_order(self, state: S) -> HandOrder:
        """What the hand is to do."""

    def step(self, state: S, seen: CellSeen) -> tuple[S, CellOrder]:
        """One request of the arm's controller."""
        state = replace(state, seen=state.seen.take(seen.sighting, seen.time))
        if seen.stopped is not None:
            state = replace(state, end=state.end or CellEnd.STOPPED)
        if state.end is None:
            state = self.in_phase(state, seen)
        if state.end is not None and state.end is not CellEnd.HOLDS:
            state = replace(state, path=halt(state.path))
        guided = state.phase in self.guided and state.end is None
        order = CellOrder(state.path.pose, self.hand_order(state), str(state.phase.value), state.end, guided)
        return state, order

    def blind(self, state: S, seen: CellSeen) -> S | None:
        """The state that holds still where there is no fresh sighting, None where there is one."""
        if state.seen.fresh(seen.time):
            return None
        gone = not state.seen.kept or seen.time - state.seen.kept[-1].stamp_s > PATIENCE or state.seen.same > 0
        gone = gone or seen.time - state.since > TIRED
        return replace(state, path=halt(state.path), end=CellEnd.NO_FRESH_SIGHTING if gone else None)


@dataclass
class Programme(Generic[S]):
    """A behaviour under way: it keeps the state that the pure steps pass on."""

    behaviour: Phased[S]
    state: S

    def step(self, seen: CellSeen) -> CellOrder:
        """One request of the arm's controller."""
        self.state, order = self.behaviour.step(self.state, seen)
        return order


def lost(gripped_at: tuple[float, float, float] | None, seen: CellSeen) -> bool:
    """Whether fingers have closed further since the grip: what they held is gone."""
    assert gripped_at is not None
    return max(now - then for now, then in zip(seen.curls, gripped_at, strict=True)) > GIVEN_WAY
