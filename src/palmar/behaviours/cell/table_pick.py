"""Task A (section 7.3.1): pick up a cylinder that stands on a table, from above along its axis, with three fingertips.

Vision says where the axis is, up to an error: a set (``belief``). The hand comes down to close only where the region of its
three closing tips holds that whole set, and closes as soon as the palm touches; the tips push no higher than where the
cylinder slides for certain (``grasp_height``). Where the set is too large, it first comes down with narrow fingers: which
of them land on the top cuts the set, the arm rises, moves, and comes down again. When two fingers touch long before the
third, or the grip is off the palm's middle, the tips say where the axis is: the hand opens, the arm moves there, and it
closes again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from palmar.behaviours.cell.arm_path import ArmPath, halt, toward, turned
from palmar.behaviours.cell.belief import Move, Reasoning, around, standing_turn
from palmar.behaviours.cell.grasp_height import BACK_OFF, GraspHeights, grasp_heights
from palmar.behaviours.cell.phased import PATIENCE, Phased, PhaseState, lost
from palmar.behaviours.cell.tip_circle import alike, circumcentre, curl_for, through, tips_at
from palmar.behaviours.descent import Closing
from palmar.models.cell_messages import CellEnd, CellSeen, HandMode, HandOrder
from palmar.models.cell_task import Cylinder
from palmar.models.salisbury_hand import TIP_PREHENSION, SalisburyHand

Floats = NDArray[np.float64]
ENOUGH = 10
"""Sightings before the first move."""
SPREAD = 0.0015
"""What the mean of so many sightings is off by (m), unless they say that it is more."""
CLEARANCE, BELOW, PAST_TOP = 0.025, 0.003, 0.0015
"""Of the tips over the top; how far below it they feel beside it; how far below it the palm feels for it (m)."""
LIFT, HOLD = 0.115, 2.3
"""How far (m) and how long (s)."""
DRAWN_BACK = 0.25
"""So long (s) after the touch the palm is clear of the top again."""
ALONE, OFF = 0.12, 0.005
"""So long (s) two fingers touch without the third before the arm moves, if that is further than this (m)."""


class Phase(Enum):
    """Of the pick."""

    LOOK = "look"
    OVER = "move over the cylinder"
    DESCEND = "lower the open hand"
    FEEL = "lower narrow fingers to feel"
    RETREAT = "rise from what the fingers touched"
    CLOSE = "close"
    CENTRE = "move where two fingers felt it"
    LIFT = "lift"
    HOLD = "hold"


@dataclass(frozen=True)
class Picking(PhaseState):
    """``move``: the next, in a frame with the hand's x and y of the start and its origin at ``origin`` (m, base); ``turn``:
    of the hand since then (rad); ``curl``: of the fingers on the way down; ``contact``: height (m) at which the palm
    touched; ``pair``: since when (s) two fingers touch without the third; ``centre``: where (m) they say the axis is.
    """

    move: Move | None = None
    origin: tuple[float, float] = (0.0, 0.0)
    turn: float = 0.0
    curl: float = 0.0
    contact: float = 0.0
    pair: float | None = None
    centre: tuple[float, float] = (0.0, 0.0)

    @property
    def planned(self) -> Move:
        """The next move, once there is one."""
        assert self.move is not None
        return self.move


@dataclass(frozen=True)
class TablePick(Phased[Picking]):
    """What is known beforehand: the hand, the cylinder, its top (m), a bound (m) on vision's systematic error."""

    hand: SalisburyHand
    cylinder: Cylinder
    top: float
    error: float
    approaches_most: int = 4
    fast: float = 0.15
    slow: float = 0.04
    guided = frozenset({Phase.OVER, Phase.DESCEND, Phase.FEEL})

    def begin(self, pose: Floats, time: float) -> Picking:
        """At the arm's present set-point of the hand frame (4, 4); the first move is found beforehand."""
        self.reasoning.first(self.error + SPREAD, self.approaches_most)
        return Picking(Phase.LOOK, time, ArmPath(pose), curl=TIP_PREHENSION.opened)

    def in_phase(self, state: Picking, seen: CellSeen) -> Picking:
        """What the present phase does at one request."""
        return _STEPS[state.phase](self, state, seen)

    @property
    def heights(self) -> GraspHeights:
        """At which it may close."""
        return grasp_heights(self.hand, self.cylinder)

    @property
    def reasoning(self) -> Reasoning:
        """About where the cylinder stands."""
        return Reasoning(self.hand, self.cylinder, self.heights.may_feel)

    @property
    def over(self) -> float:
        """Height (m) of the palm from which the hand is lowered."""
        return self.top + self._deep(TIP_PREHENSION.opened) + self.hand.tip_radius + CLEARANCE

    @property
    def down(self) -> float:
        """Height (m) of the palm down to which the open hand is lowered: it touches the top, unless the table is near."""
        heights = self.heights
        return self.top + (-PAST_TOP if heights.by_palm else heights.lowest - self.cylinder.height)

    def _deep(self, curl: float) -> float:
        return float(tips_at(self.hand, np.array(alike(curl)))[0, 2])

    def hand_order(self, state: Picking) -> HandOrder:
        """In the shape of the next move, or closing from the moment the palm was felt."""
        if state.phase in (Phase.CLOSE, Phase.LIFT, Phase.HOLD):
            return HandOrder(HandMode.CLOSE, alike(TIP_PREHENSION.opened))
        return HandOrder(HandMode.SHAPE, alike(state.curl), close_on_palm=state.phase is Phase.DESCEND)

    def _look(self, state: Picking, seen: CellSeen) -> Picking:
        if any(seen.palm):
            return replace(state, end=CellEnd.SENSOR_FAULT)
        if len(state.seen.kept) >= ENOUGH and state.seen.fresh(seen.time):
            error = self.error + max(SPREAD, 3.0 * state.seen.sigma / len(state.seen.kept) ** 0.5)
            move = None if self.heights.refusal else self.reasoning.first(error, self.approaches_most)
            return self._go(replace(state, origin=state.seen.place, approaches=1), seen, move)
        late = seen.time - state.since > 2.0 * PATIENCE
        return replace(state, end=CellEnd.NO_FRESH_SIGHTING) if late else state

    def _go(self, state: Picking, seen: CellSeen, move: Move | None) -> Picking:
        """Over the place of a move, with the fingers on its circle."""
        if move is None:
            return replace(state, end=CellEnd.WOULD_TOPPLE)
        curl = curl_for(self.hand, move.stand.opening)
        return replace(state, phase=Phase.OVER, since=seen.time, move=move, curl=curl)

    def _goal(self, state: Picking, height: float) -> Floats:
        stand = state.planned.stand
        x, y = state.origin + self._frame(state) @ (stand.x, stand.y)
        return np.array([x, y, height])

    def _frame(self, state: Picking) -> Floats:
        """Columns (2, 2): x and y of the hand at the start, in the base."""
        c, s = cos(state.turn), sin(state.turn)
        frame: Floats = state.path.pose[:2, :2] @ np.array([[c, s], [-s, c]])
        return frame

    def _over(self, state: Picking, seen: CellSeen) -> Picking:
        waiting = self.blind(state, seen)
        if waiting is not None:
            return waiting
        if any(seen.palm):
            return replace(state, end=CellEnd.SENSOR_FAULT)
        goal, left = self._goal(state, self.over), standing_turn(state.planned.stand.turn)[0] - state.turn
        if state.path.there(goal) and left == 0.0 and seen.at_end:
            closing = isinstance(state.move, Closing)
            return replace(state, phase=Phase.DESCEND if closing else Phase.FEEL, since=seen.time)
        path, step = turned(toward(state.path, goal, self.fast), left)
        return replace(state, path=path, turn=state.turn + step)

    def _descend(self, state: Picking, seen: CellSeen) -> Picking:
        """Open, where the region holds the belief, until the palm touches or the table is near."""
        goal = self._goal(state, self.down)
        if any(seen.palm) or (state.path.there(goal) and not self.heights.by_palm):
            contact = max(state.path.place[2], self.down)
            return replace(state, phase=Phase.CLOSE, since=seen.time, path=halt(state.path), contact=contact)
        if any(seen.touched):
            return self._felt(state, seen)
        waiting = self.blind(state, seen)
        if waiting is not None:
            return waiting
        if state.path.there(goal) and seen.time - state.since > PATIENCE:
            return replace(state, end=CellEnd.NOTHING_FELT)
        return replace(state, path=toward(state.path, goal, self.slow))

    def _feel(self, state: Picking, seen: CellSeen) -> Picking:
        """With the fingers on a circle, until some land on the top or all are beside it."""
        if any(seen.palm):
            return replace(state, end=CellEnd.SENSOR_FAULT)
        goal = self._goal(state, self.top - BELOW + self._deep(state.curl))
        if any(seen.touched) or state.path.there(goal):
            return self._felt(state, seen)
        waiting = self.blind(state, seen)
        return waiting or replace(state, path=toward(state.path, goal, self.slow))

    def _felt(self, state: Picking, seen: CellSeen) -> Picking:
        """What touched, and what did not, cuts the belief; the hand closes where it is, or rises to its next move."""
        return self._rise(state, seen, self.reasoning.after_touch(state.planned, seen.touched, self.error + SPREAD))

    def _rise(self, state: Picking, seen: CellSeen, move: Move | None) -> Picking:
        if move is None:
            return replace(state, end=CellEnd.WOULD_TOPPLE)
        stays = isinstance(move, Closing) and move.there
        phase = Phase.DESCEND if stays else Phase.RETREAT
        return replace(state, phase=phase, since=seen.time, path=halt(state.path), move=move)

    def _retreat(self, state: Picking, seen: CellSeen) -> Picking:
        if state.approaches >= self.approaches_most:
            return replace(state, end=CellEnd.OUT_OF_APPROACHES)
        goal = np.array([*state.path.place[:2], self.over])
        if state.path.there(goal):
            return self._go(replace(state, approaches=state.approaches + 1), seen, state.move)
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
        tips: Floats = (seen.palm_pose[:3, :3] @ tips_at(self.hand, np.array(seen.curls)).T).T + seen.palm_pose[:3, 3]
        return tips

    def _again(self, state: Picking, seen: CellSeen) -> Picking:
        """Closed on nothing: it is not where the hand would have caught it."""
        if state.approaches >= self.approaches_most or not state.seen.fresh(seen.time):
            return replace(state, end=CellEnd.NOTHING_GRIPPED)
        x, y = self._frame(state).T @ (np.array(state.seen.place) - state.origin)
        belief = around((float(x), float(y)), self.error + SPREAD)
        return self._rise(state, seen, self.reasoning.after_nothing(state.planned, belief))

    def _felt_pair(self, state: Picking, seen: CellSeen) -> Picking:
        if sum(seen.touched) != 2 or state.approaches >= self.approaches_most:
            return replace(state, pair=None)
        pair = seen.time if state.pair is None else state.pair
        one, two = self._tips_now(seen)[np.array(seen.touched), :2]
        middle = seen.palm_pose[:2, 3]
        centre = through(one, two, self.cylinder.radius + self.hand.tip_radius, middle)
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


_STEPS: dict[Enum, Callable[[TablePick, Picking, CellSeen], Picking]] = {
    Phase.LOOK: TablePick._look,
    Phase.OVER: TablePick._over,
    Phase.DESCEND: TablePick._descend,
    Phase.FEEL: TablePick._feel,
    Phase.RETREAT: TablePick._retreat,
    Phase.CLOSE: TablePick._close,
    Phase.CENTRE: TablePick._centre,
    Phase.LIFT: TablePick._lift,
    Phase.HOLD: TablePick._hold,
}
