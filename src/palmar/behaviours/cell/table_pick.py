"""Task A (section 7.3.1): pick up a cylinder that stands on a table, from above along its axis, with three fingertips.

Vision says where the axis is, up to an error; the arm lowers the open hand there. The palm touched: close. Fingers touched
first: the tips say where the axis may be (``belief``), the arm rises, moves there and lowers the hand again. When two
fingers touch long before the third, or the grip is off the palm's middle, the tips say where the axis is: the hand opens,
the arm moves there, and it closes again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from palmar.behaviours.cell.arm_path import ArmPath, halt, toward
from palmar.behaviours.cell.belief import Belief, after_touch, around
from palmar.behaviours.cell.phased import PATIENCE, Phased, PhaseState, lost
from palmar.mechanics.arm.salisbury_finger import tip_in_hand
from palmar.models.cell_messages import CellEnd, CellSeen, HandMode, HandOrder
from palmar.models.salisbury_hand import TIP_PREHENSION, SalisburyHand

Floats = NDArray[np.float64]
ENOUGH = 10
"""Sightings before the first move."""
CLEARANCE, BACK_OFF, PAST_TOP = 0.025, 0.002, 0.0015
"""Of the tips over the top; how far the palm draws back to close; how far below the top it feels for it (m)."""
LIFT, HOLD = 0.115, 2.3
"""How far (m) and how long (s)."""
CAUGHT = 0.015
"""What was within so much (m) of the palm's middle when the hand closed on nothing would have been caught."""
DRAWN_BACK = 0.25
"""So long (s) after the touch the palm is clear of the top again."""
ALONE, OFF = 0.12, 0.005
"""So long (s) two fingers touch without the third before the arm moves, if that is further than this (m)."""


class Phase(Enum):
    """Of the pick."""

    LOOK = "look"
    OVER = "move over the cylinder"
    DESCEND = "lower the open hand"
    RETREAT = "rise from what the fingers touched"
    CLOSE = "close"
    CENTRE = "move where two fingers felt it"
    LIFT = "lift"
    HOLD = "hold"


@dataclass(frozen=True)
class Picking(PhaseState):
    """``belief``: places of the axis; ``contact``: height (m) at which the palm touched; ``pair``: since when (s) two
    fingers touch without the third; ``centre``: where (m) they say the axis is.
    """

    belief: Belief | None = None
    contact: float = 0.0
    pair: float | None = None
    centre: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True)
class TablePick(Phased[Picking]):
    """What is known beforehand: the hand, the cylinder's top (m), a bound (m) on vision's systematic error."""

    hand: SalisburyHand
    top: float
    error: float
    approaches_most: int = 4
    fast: float = 0.15
    slow: float = 0.04
    guided = frozenset({Phase.OVER, Phase.DESCEND})

    def begin(self, pose: Floats, time: float) -> Picking:
        """At the arm's present set-point of the hand frame (4, 4)."""
        return Picking(Phase.LOOK, time, ArmPath(pose))

    def in_phase(self, state: Picking, seen: CellSeen) -> Picking:
        """What the present phase does at one request."""
        return _STEPS[state.phase](self, state, seen)

    @property
    def tips(self) -> Floats:
        """Of the open hand (3, 3) in the hand frame."""
        return self._tips((TIP_PREHENSION.opened,) * 3)

    def _tips(self, curls: tuple[float, float, float]) -> Floats:
        joints = TIP_PREHENSION.joints(np.array(curls))
        return np.stack([tip_in_hand(self.hand, k, joints[k]) for k in range(3)])

    @property
    def over(self) -> float:
        """Height (m) of the palm from which the hand is lowered."""
        return self.top + float(self.tips[:, 2].max()) + self.hand.tip_radius + CLEARANCE

    def hand_order(self, state: Picking) -> HandOrder:
        """Open, or closing from the moment the palm was felt."""
        open_curls = (TIP_PREHENSION.opened,) * 3
        if state.phase in (Phase.CLOSE, Phase.LIFT, Phase.HOLD):
            return HandOrder(HandMode.CLOSE, open_curls)
        return HandOrder(HandMode.SHAPE, open_curls, close_on_palm=state.phase is Phase.DESCEND)

    def _look(self, state: Picking, seen: CellSeen) -> Picking:
        if any(seen.palm):
            return replace(state, end=CellEnd.SENSOR_FAULT)
        if len(state.seen.kept) >= ENOUGH and state.seen.fresh(seen.time):
            error = self.error + 3.0 * state.seen.sigma / len(state.seen.kept) ** 0.5
            belief = around(state.seen.place, error)
            return replace(state, phase=Phase.OVER, since=seen.time, belief=belief, approaches=1)
        late = seen.time - state.since > 2.0 * PATIENCE
        return replace(state, end=CellEnd.NO_FRESH_SIGHTING) if late else state

    def _goal(self, state: Picking, height: float) -> Floats:
        assert state.belief is not None
        return np.array([*state.belief.middle, height])

    def _over(self, state: Picking, seen: CellSeen) -> Picking:
        waiting = self.blind(state, seen)
        if waiting is not None:
            return waiting
        if any(seen.palm):
            return replace(state, end=CellEnd.SENSOR_FAULT)
        goal = self._goal(state, self.over)
        if state.path.there(goal):
            return replace(state, phase=Phase.DESCEND, since=seen.time)
        return replace(state, path=toward(state.path, goal, self.fast))

    def _descend(self, state: Picking, seen: CellSeen) -> Picking:
        if any(seen.palm):
            return replace(
                state, phase=Phase.CLOSE, since=seen.time, path=halt(state.path), contact=state.path.place[2]
            )
        if any(seen.touched):
            return self._felt_fingers(state, seen)
        waiting = self.blind(state, seen)
        if waiting is not None:
            return waiting
        goal = self._goal(state, self.top - PAST_TOP)
        if state.path.there(goal) and seen.time - state.since > PATIENCE:
            return replace(state, end=CellEnd.NOTHING_FELT)
        return replace(state, path=toward(state.path, goal, self.slow))

    def _felt_fingers(self, state: Picking, seen: CellSeen) -> Picking:
        assert state.belief is not None
        tips = (seen.palm_pose[:3, :3] @ self.tips.T).T + seen.palm_pose[:3, 3]
        belief = after_touch(state.belief, tips[:, :2], seen.touched, state.seen.radius, self.hand.tip_radius)
        return replace(state, phase=Phase.RETREAT, since=seen.time, path=halt(state.path), belief=belief)

    def _retreat(self, state: Picking, seen: CellSeen) -> Picking:
        if state.approaches >= self.approaches_most:
            return replace(state, end=CellEnd.OUT_OF_APPROACHES)
        goal = np.array([*state.path.place[:2], self.over])
        if state.path.there(goal):
            return replace(state, phase=Phase.OVER, since=seen.time, approaches=state.approaches + 1)
        return replace(state, path=toward(state.path, goal, self.fast))

    def _close(self, state: Picking, seen: CellSeen) -> Picking:
        goal = np.array([*state.path.place[:2], state.contact + BACK_OFF])
        state = replace(state, path=toward(state.path, goal, self.slow))
        if any(seen.palm) and not any(seen.touched) and seen.time - state.since > DRAWN_BACK:
            return replace(state, end=CellEnd.SENSOR_FAULT)
        if seen.gripped:
            return self._gripped(state, seen)
        if seen.at_end or seen.time - state.since > 3.0 * PATIENCE:
            return self._again(state, seen)
        return self._felt_pair(state, seen)

    def _gripped(self, state: Picking, seen: CellSeen) -> Picking:
        """Lift, unless the tips say that the axis is off the palm's middle: then it would tilt out of the grip."""
        centre = circumcentre(self._tips_now(seen)[:, :2])
        if state.approaches < self.approaches_most and np.linalg.norm(centre - seen.palm_pose[:2, 3]) > OFF:
            return self._to_centre(state, seen, centre)
        return replace(state, phase=Phase.LIFT, since=seen.time, gripped_at=seen.curls)

    def _to_centre(self, state: Picking, seen: CellSeen, centre: Floats) -> Picking:
        place, more = (float(centre[0]), float(centre[1])), state.approaches + 1
        return replace(state, phase=Phase.CENTRE, since=seen.time, pair=None, centre=place, approaches=more)

    def _tips_now(self, seen: CellSeen) -> Floats:
        tips: Floats = (seen.palm_pose[:3, :3] @ self._tips(seen.curls).T).T + seen.palm_pose[:3, 3]
        return tips

    def _again(self, state: Picking, seen: CellSeen) -> Picking:
        """Closed on nothing: it is not where the hand would have caught it."""
        assert state.belief is not None
        if state.approaches >= self.approaches_most or not state.seen.fresh(seen.time):
            return replace(state, end=CellEnd.NOTHING_GRIPPED)
        places = around(state.seen.place, self.error + state.seen.sigma).places
        left = places[np.linalg.norm(places - state.path.place[:2], axis=1) > CAUGHT]
        return replace(state, phase=Phase.RETREAT, since=seen.time, belief=Belief(left if len(left) else places))

    def _felt_pair(self, state: Picking, seen: CellSeen) -> Picking:
        if sum(seen.touched) != 2 or state.approaches >= self.approaches_most:
            return replace(state, pair=None)
        pair = seen.time if state.pair is None else state.pair
        one, two = self._tips_now(seen)[np.array(seen.touched), :2]
        middle = seen.palm_pose[:2, 3]
        centre = through(one, two, state.seen.radius + self.hand.tip_radius, middle)
        if seen.time - pair < ALONE or float(np.linalg.norm(centre - middle)) < OFF:
            return replace(state, pair=pair)
        return self._to_centre(state, seen, centre)

    def _centre(self, state: Picking, seen: CellSeen) -> Picking:
        goal = np.array([*state.centre, state.contact + BACK_OFF])
        if state.path.there(goal) and seen.at_end:
            if any(seen.palm):
                return replace(state, end=CellEnd.SENSOR_FAULT)
            return replace(state, phase=Phase.CLOSE, since=seen.time)
        opened = max(seen.curls) < 0.5 * TIP_PREHENSION.opened
        return replace(state, path=toward(state.path, goal, self.slow)) if opened else state

    def _lift(self, state: Picking, seen: CellSeen) -> Picking:
        if lost(state.gripped_at, seen):
            return replace(state, end=CellEnd.LOST_GRIP)
        goal = np.array([*state.path.place[:2], state.contact + LIFT])
        if state.path.there(goal):
            return replace(state, phase=Phase.HOLD, since=seen.time)
        return replace(state, path=toward(state.path, goal, self.fast))

    def _hold(self, state: Picking, seen: CellSeen) -> Picking:
        if lost(state.gripped_at, seen):
            return replace(state, end=CellEnd.LOST_GRIP)
        return state if seen.time - state.since < HOLD else replace(state, end=CellEnd.HOLDS)


def through(one: Floats, two: Floats, radius: float, near: Floats) -> Floats:
    """Centre (2,) of the circle of a radius (m) through two points (2,), of both the one nearer to a third point."""
    half = 0.5 * (two - one)
    length = float(np.linalg.norm(half))
    side = np.array([-half[1], half[0]]) / length * max(radius**2 - length**2, 0.0) ** 0.5
    centres = np.stack([one + half + side, one + half - side])
    nearest: Floats = centres[np.linalg.norm(centres - near, axis=1).argmin()]
    return nearest


def circumcentre(tips: Floats) -> Floats:
    """Centre (2,) of the circle through three points (3, 2)."""
    sides = 2.0 * (tips[1:] - tips[0])
    squares = (tips**2).sum(axis=1)
    centre: Floats = np.linalg.solve(sides, squares[1:] - squares[0])
    return centre


_STEPS: dict[Enum, Callable[[TablePick, Picking, CellSeen], Picking]] = {
    Phase.LOOK: TablePick._look,
    Phase.OVER: TablePick._over,
    Phase.DESCEND: TablePick._descend,
    Phase.RETREAT: TablePick._retreat,
    Phase.CLOSE: TablePick._close,
    Phase.CENTRE: TablePick._centre,
    Phase.LIFT: TablePick._lift,
    Phase.HOLD: TablePick._hold,
}
