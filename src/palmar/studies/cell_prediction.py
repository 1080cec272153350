"""What the cell's theory says before any trial: which position errors end in a grasp, and in how many approaches.

Table: the largest disk of places for which a plan of touches and closings is certain (``behaviours.cell.belief``).
Floating: the lateral errors with which the palm, the only sensor, meets the cylinder before any finger does: the source's
"width of the palm".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from shapely import LineString

from palmar.behaviours.cell.belief import GRAIN, MOST, Reasoning
from palmar.behaviours.cell.floating_catch import BEYOND, STAND_OFF
from palmar.behaviours.cell.grasp_height import grasp_heights
from palmar.behaviours.cell.table_pick import SPREAD, Phase
from palmar.behaviours.descent import descents, is_certain
from palmar.mechanics.arm.salisbury_finger import tip_in_hand
from palmar.models.cell_task import CellTask, Cylinder, TaskKind
from palmar.models.guarantee import Guarantee
from palmar.models.salisbury_hand import CYLINDRIC, SalisburyHand

if TYPE_CHECKING:
    from palmar.studies.cell_trials import CellReport

OFF_REST = 0.003
"""How far (m) a hanging cylinder that sways may be from where it was watched."""
LARGEST = 1.5
"""Radii looked at, over R + r_t, in steps of ``belief.GRAIN``."""
RESOLUTION, FAR = 1e-5, 0.3
"""Of the strip's half width; from where the cylinder comes (m)."""
ROUNDING = 1e-9


@dataclass(frozen=True)
class Predicted:
    """Vision may err by ``error`` (m), in any direction, and the hand comes down, or forward, no more than so often.

    ``along_across`` (m): of a drive, the errors that are allowed along and across it, where they differ.
    """

    approaches: int
    error: float
    why: str
    guarantee: Guarantee
    along_across: tuple[float, float] | None = None


def predict(hand: SalisburyHand, task: CellTask, most: int = MOST) -> tuple[Predicted, ...]:
    """For one approach, two, … ``most``; empty where nothing is certain. ``task`` is to pick from a table or to catch."""
    if task.kind is TaskKind.TABLE:
        return _picks(hand, task.cylinder, most)
    width = palm_first(hand, task.cylinder.radius) - SPREAD - OFF_REST
    ahead = min(BEYOND, STAND_OFF - task.cylinder.radius) - SPREAD - OFF_REST
    why = "the palm meets it before any finger does; what the fingers then do to it is not proved"
    return (Predicted(1, min(width, ahead), why, Guarantee.CONSTRUCTION, (ahead, width)),)


def _picks(hand: SalisburyHand, cylinder: Cylinder, approaches: int) -> tuple[Predicted, ...]:
    heights, found = grasp_heights(hand, cylinder), []
    if heights.refusal is not None:
        return ()
    reasoning = Reasoning(hand, cylinder, heights.may_feel)
    low = 0
    for most in range(1, approaches + 1 if heights.may_feel else 2):
        sure = _largest(reasoning, most, low)
        if sure > low:
            why = "the region of the closing tips holds every place that is left"
            found.append(Predicted(most, max(GRAIN * sure - SPREAD, 0.0), why, Guarantee.CLOSED_FORM))
        low = sure
    return tuple(found)


def _largest(reasoning: Reasoning, most: int, low: int) -> int:
    """The most steps of ``GRAIN`` for which a certain plan is found; it is taken that smaller sets have one, too."""
    high = round(LARGEST * reasoning.reach.rho / GRAIN)
    while high - low > 1:
        middle = (low + high) // 2
        move = reasoning.first(GRAIN * middle, most)
        if move is not None and is_certain(move) and descents(move) <= most:
            low = middle
        else:
            high = middle
    return low


def palm_first(hand: SalisburyHand, radius: float) -> float:
    """Largest distance (m) of the axis from the grasp line with which it meets the palm's sensors before a finger.

    The cylinder comes along the hand's z, its axis along x; the open fingers stand up on both sides: capsules, from which
    the axis keeps away by its radius and theirs.
    """
    fingers = [_outline(hand, k) for k in range(3)]
    low, high = 0.0, hand.pads[1]
    while high - low > RESOLUTION:
        middle = 0.5 * (low + high)
        ways = [LineString([(hand.grasp_line + y, radius), (hand.grasp_line + y, FAR)]) for y in (middle, -middle)]
        met = any(way.distance(each) < radius + hand.link_radius for way in ways for each in fingers)
        low, high = (low, middle) if met else (middle, high)
    return low


def _outline(hand: SalisburyHand, finger: int) -> LineString:
    """From base to tip of an open finger in the hand's y and z (m)."""
    joints = CYLINDRIC.joints(np.array(CYLINDRIC.opened))
    outward = np.array([np.cos(hand.bases[finger]), np.sin(hand.bases[finger]), 0.0])
    up = np.array([0.0, 0.0, 1.0])
    base = hand.base_circle * outward
    middle = base + hand.links[0] * (np.cos(joints[1]) * up - np.sin(joints[1]) * outward)
    return LineString(np.stack([base, middle, tip_in_hand(hand, finger, joints)])[:, 1:])


@dataclass(frozen=True)
class Against:
    """Trials beside their prediction: how many were inside and outside, and failed, or needed more approaches there.

    An approach is counted each time that the hand comes down or forward, not where it moves to the middle after a grip.
    """

    inside: int
    lost_inside: int
    more_inside: int
    outside: int
    caught_outside: int


def against(report: CellReport, predictions: tuple[Predicted, ...]) -> Against:
    """What came of the trials that the prediction promises, and of the others."""
    counts = [0] * 5
    for k, result in enumerate(report.results):
        promised = _promised(report, k, predictions)
        if promised is None:
            counts[3] += 1
            counts[4] += result.success
            continue
        counts[0] += 1
        counts[1] += not result.success
        counts[2] += result.success and sum(why == Phase.OVER.value for _, why in result.phases) > promised
    return Against(*counts)


def _promised(report: CellReport, k: int, predictions: tuple[Predicted, ...]) -> int | None:
    """In how many approaches trial ``k`` has to succeed; None: it need not. A pick is planned for the error it is told."""
    trials = report.trials
    along, across = trials.settings(k).camera.bias
    for each in predictions:
        if each.along_across is None:
            inside = trials.error <= each.error + ROUNDING
        else:
            inside = abs(along) <= each.along_across[0] and abs(across) <= each.along_across[1]
        if inside:
            return each.approaches
    return None
