"""Task B (section 7.3.2): catch a cylinder that floats about its rest position, with the palm as the only sensor.

The arm drives the open hand toward the rest position. As soon as the palm feels the cylinder the reflex layer closes the
fingers while the arm still moves; the arm stops when the fingers have arrived, and carries the cylinder away.

With ``align`` (section 7.2) it takes a cylinder that stands on a table from the side: it drives slowly, the first palm bit
stops the arm, a hand of which only one side touches is turned about that contact until the other does, and then closes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from palmar.behaviours.cell.arm_path import PERIOD, ArmPath, halt, toward
from palmar.behaviours.cell.palm_alignment import aligned
from palmar.behaviours.cell.phased import Phased, PhaseState, lost
from palmar.behaviours.cell.table_pick import HOLD, LIFT
from palmar.mechanics.arm.salisbury_finger import meeting_curl
from palmar.models.cell_messages import NEVER, CellEnd, CellSeen, HandMode, HandOrder
from palmar.models.salisbury_hand import CYLINDRIC, SalisburyHand

Floats = NDArray[np.float64]
WATCHED = 0.8
"""How long (s) the rest position is watched before the arm moves."""
STAND_OFF, BEYOND = 0.16, 0.06
"""Palm to the rest position at the start of the drive and at the end, with what is held; how far past it it goes (m)."""
GENTLE, TURNING, TURNED = 0.02, 0.15, 5.0
"""With alignment: speed of the drive (m/s), rate of turning (rad/s), and the longest time (s) for it."""
UP = np.array([0.0, 0.0, 1.0])
CLOSING_TIME = 1.5
"""Fingers that have not arrived after this (s) do not."""


class Phase(Enum):
    """Of the catch."""

    LOOK = "watch the rest position"
    LINE_UP = "line up"
    DRIVE = "drive toward the rest position"
    ALIGN = "turn about the contact"
    CLOSING = "close"
    STOP = "stop the arm"
    CARRY = "carry away"
    HOLD = "hold"


@dataclass(frozen=True)
class Catching(PhaseState):
    """``rest``: the rest position (m); ``away``: where (m) the palm carries the cylinder; ``soft_from``: as the order's."""

    rest: tuple[float, float] = (0.0, 0.0)
    away: tuple[float, float, float] = (0.0, 0.0, 0.0)
    soft_from: float = NEVER
    approaches: int = 1


@dataclass(frozen=True)
class FloatingCatch(Phased[Catching]):
    """What is known beforehand: the hand, and the height (m) at which to catch; the drive goes along the hand's z."""

    hand: SalisburyHand
    height: float
    fast: float = 0.15
    drive: float = 0.12
    closing_rate: float = 4.0
    soft_rate: float = 1.0
    clearance: float = 0.010
    grip: float = 0.5
    align: bool = False
    guided = frozenset({Phase.LINE_UP, Phase.DRIVE})

    def begin(self, pose: Floats, time: float) -> Catching:
        """At the arm's present set-point of the hand frame (4, 4)."""
        return Catching(Phase.LOOK, time, ArmPath(pose))

    def in_phase(self, state: Catching, seen: CellSeen) -> Catching:
        """What the present phase does at one request."""
        return _STEPS[state.phase](self, state, seen)

    def hand_order(self, state: Catching) -> HandOrder:
        """Open, or closing from the moment the palm was felt."""
        closing = state.phase in (Phase.CLOSING, Phase.STOP, Phase.CARRY, Phase.HOLD)
        mode = HandMode.CLOSE if closing else HandMode.SHAPE
        armed = state.phase is Phase.DRIVE and not self.align
        return HandOrder(
            mode,
            (CYLINDRIC.opened,) * 3,
            CYLINDRIC,
            self.closing_rate,
            self.grip,
            armed,
            state.soft_from,
            self.soft_rate,
        )

    def _goal(self, state: Catching, distance: float) -> Floats:
        """Where (m) the palm is ``distance`` (m) before the axis, the axis across the middle of the palm."""
        turn = state.path.pose[:3, :3]
        axis = np.array([*state.rest, self.height])
        place: Floats = axis - turn @ np.array([0.0, self.hand.grasp_line, distance])
        return place

    def _look(self, state: Catching, seen: CellSeen) -> Catching:
        if any(seen.palm):
            return replace(state, end=CellEnd.SENSOR_FAULT)
        if seen.time - state.since < WATCHED:
            return state
        blind = self.blind(state, seen)
        if blind is not None:
            return blind
        soft_from = meeting_curl(self.hand, CYLINDRIC, state.seen.radius, self.clearance)
        return replace(state, phase=Phase.LINE_UP, since=seen.time, rest=state.seen.place, soft_from=soft_from)

    def _line_up(self, state: Catching, seen: CellSeen) -> Catching:
        blind = self.blind(state, seen)
        if blind is not None:
            return blind
        if any(seen.palm):
            return replace(state, end=CellEnd.SENSOR_FAULT)
        goal = self._goal(state, STAND_OFF)
        if state.path.there(goal):
            return replace(state, phase=Phase.DRIVE, since=seen.time)
        return replace(state, path=toward(state.path, goal, self.fast))

    def _drive(self, state: Catching, seen: CellSeen) -> Catching:
        if any(seen.palm) and self.align:
            return replace(state, phase=Phase.ALIGN, since=seen.time, path=halt(state.path))
        if any(seen.palm):
            return self._closing(replace(state, phase=Phase.CLOSING, since=seen.time), seen)
        blind = self.blind(state, seen)
        if blind is not None:
            return blind
        goal = self._goal(state, -BEYOND)
        if state.path.there(goal):
            return replace(state, end=CellEnd.NOTHING_FELT)
        return replace(state, path=toward(state.path, goal, GENTLE if self.align else self.drive))

    def _align(self, state: Catching, seen: CellSeen) -> Catching:
        """Turn about what is felt; what has gone is followed."""
        if all(seen.palm):
            return replace(state, phase=Phase.CLOSING, since=seen.time)
        if seen.time - state.since > TURNED:
            return replace(state, end=CellEnd.NOTHING_GRIPPED)
        if not any(seen.palm):
            ahead = state.path.place + 0.01 * state.path.pose[:3, 2]
            return replace(state, path=toward(state.path, ahead, GENTLE))
        turned = aligned(state.path.pose, seen.palm, self.hand, TURNING * PERIOD)
        return replace(state, path=ArmPath(turned))

    def _closing(self, state: Catching, seen: CellSeen) -> Catching:
        if seen.gripped or seen.at_end:
            return replace(state, phase=Phase.STOP, since=seen.time, gripped_at=seen.curls)
        if seen.time - state.since > CLOSING_TIME:
            return replace(state, end=CellEnd.NOTHING_GRIPPED)
        if self.align:
            return replace(state, path=halt(state.path))
        return replace(state, path=toward(state.path, self._goal(state, -BEYOND), self.drive))

    def _stop(self, state: Catching, seen: CellSeen) -> Catching:
        state = replace(state, path=halt(state.path))
        if seen.time - state.since < 0.25:
            return state
        if not seen.gripped:
            return replace(state, end=CellEnd.NOTHING_GRIPPED)
        away = state.path.place + LIFT * UP if self.align else self._goal(state, STAND_OFF)
        return replace(state, phase=Phase.CARRY, since=seen.time, gripped_at=seen.curls, away=tuple(away))

    def _carry(self, state: Catching, seen: CellSeen) -> Catching:
        if lost(state.gripped_at, seen):
            return replace(state, end=CellEnd.LOST_GRIP)
        goal = np.array(state.away)
        if state.path.there(goal):
            return replace(state, phase=Phase.HOLD, since=seen.time)
        return replace(state, path=toward(state.path, goal, self.fast))

    def _hold(self, state: Catching, seen: CellSeen) -> Catching:
        if lost(state.gripped_at, seen):
            return replace(state, end=CellEnd.LOST_GRIP)
        return state if seen.time - state.since < HOLD else replace(state, end=CellEnd.HOLDS)


_STEPS: dict[Enum, Callable[[FloatingCatch, Catching, CellSeen], Catching]] = {
    Phase.LOOK: FloatingCatch._look,
    Phase.LINE_UP: FloatingCatch._line_up,
    Phase.DRIVE: FloatingCatch._drive,
    Phase.ALIGN: FloatingCatch._align,
    Phase.CLOSING: FloatingCatch._closing,
    Phase.STOP: FloatingCatch._stop,
    Phase.CARRY: FloatingCatch._carry,
    Phase.HOLD: FloatingCatch._hold,
}
