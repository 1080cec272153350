"""From where a behaviour under feedback catches the object: the region of its runs in the planar or another world.

A reflex decides by what it feels, so no closed form and no batch kernel has its region. Starts on a square grid are run one
by one, on every processor that the executor has, and the grid is halved where neighbours differ (``boundary_search``):
``sampled``. The object starts at the case's orientation and, in free space, velocity. Where a tracker errs, a start counts
as caught if it is with each of a number of draws of its errors, the same draws for every start.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from math import ceil, cos, log2, pi, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.behaviours.reflex import Reflex
from palmar.errors import InputError, NotCoveredError
from palmar.geometry.planar_set import EMPTY
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.objects import Disk
from palmar.models.sensors import Stretch
from palmar.regions.boundary_search import Box, all_near, any_near, nodes_inside
from palmar.regions.closing_sampled import COARSE, cells, corners_inside, corners_touching
from palmar.regions.region import Model, Region
from palmar.regions.simulated import covered_from, object_reach
from palmar.studies.run_behaviour import Circumstances, behaviour_of, run_behaviour
from palmar.worlds.planar.tracker import Tracker

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
TICK = 0.02
"""Time (s) between two observations."""
SPACING = 1.0 / 32.0
"""Default spacing of the starts, in finger lengths."""
FINEST = 1.0 / 512.0
CHUNK = 8
SURE = 0.95
"""Confidence in the least chance of a start that was caught with every draw."""
ADVANCING = {
    BehaviourName.MOVE_AND_GRAB,
    BehaviourName.MOVE_WHILE_CLOSING,
    BehaviourName.SCOOP,
    BehaviourName.PALM_REFLEX,
}
UNFELT = {BehaviourName.CLOSE, BehaviourName.MOVE_AND_GRAB, BehaviourName.MOVE_WHILE_CLOSING}
Report = Callable[[int], None]
EVERY_TICK = Circumstances(tick=TICK)


def behaviour_region(
    case: Case,
    executor: Executor,
    spacing: float | None = None,
    circumstances: Circumstances = EVERY_TICK,
    report: Report | None = None,
    draws: int = 1,
) -> Region:
    """The region of the case's behaviour; ``spacing`` (m) of the starts at its boundary; ``report`` hears how many are done.

    ``draws``: of the tracker's errors, from its seed on, with each of which a start has to be caught. Raises
    NotCoveredError where hand or object do not allow the behaviour, and for ranges; InputError for draws of no errors.
    """
    if case.ranges:
        raise NotCoveredError("regions of behaviours under feedback take plain numbers, not ranges")
    length = case.hand.finger_length
    wanted = max(spacing or SPACING * length, FINEST * length)
    trackers = _drawn(circumstances.tracker, draws)
    several = tuple(replace(circumstances, tracker=each) for each in trackers)
    asked = _Runs(case, behaviour_of(case), several, executor, report)
    box = _box(case)
    if circumstances.tracker is not None:
        box = replace(box, mirrored=False)  # its errors are the same on both sides
    nodes = nodes_inside(asked.caught, box, max(0, ceil(log2(box.width / box.cells / wanted))))
    origin = -0.5 * box.width, 0.0
    centre = cells(corners_inside(all_near(nodes.held)), origin, nodes.step)
    whole, flattening = (
        (EMPTY, 0.0) if centre.is_empty else covered_from(centre, case.object, np.array([case.start.theta]))
    )
    behaviour = case.behaviour.name.value
    return Region(
        model=Model.EXACT,
        closure=Closure.FRICTIONAL,
        guarantee=Guarantee.SAMPLED,
        centre=centre,
        contact=EMPTY,
        whole=whole,
        flattening=flattening,
        reason="no start on the grid is caught" if centre.is_empty else None,
        notes=(
            f"{asked.done} runs of {behaviour}, {1e3 * nodes.step:.3g} mm apart at the boundary, observed every"
            f" {1e3 * circumstances.tick:.3g} ms",
            *_tracked(trackers),
        ),
        outer=cells(corners_touching(any_near(nodes.held)), origin, nodes.step),
        orientations=None if isinstance(case.object, Disk) else (case.start.theta, case.start.theta),
        spacing=nodes.step,
    )


def _drawn(tracker: Tracker | None, draws: int) -> tuple[Tracker | None, ...]:
    """The tracker with so many draws of its errors."""
    if draws < 1:
        raise InputError("draws", str(draws), "must be at least 1")
    if draws > 1 and (tracker is None or tracker.position_sigma == tracker.velocity_sigma == 0.0):
        raise InputError("draws", str(draws), "more than one draw needs a tracker with errors")
    return (tracker,) if tracker is None else tuple(replace(tracker, seed=tracker.seed + k) for k in range(draws))


def _tracked(trackers: tuple[Tracker | None, ...]) -> tuple[str, ...]:
    """What the tracker of all runs was like, and what being caught with its draws says."""
    first = trackers[0]
    if first is None:
        return ()
    late = f"the object is tracked {1e3 * first.delay:.4g} ms late"
    if first.position_sigma == first.velocity_sigma == 0.0:
        return (f"{late}, without errors",)
    if len(trackers) == 1:
        x, y, vx, vy = (1e3 * each for each in first.errors())
        return (
            f"{late}, off by ({x:.3g}, {y:.3g}) mm and ({vx:.3g}, {vy:.3g}) mm/s: one draw of its errors (seed"
            f" {first.seed}), the same in all runs, so the region says nothing of the chance with others",
        )
    chance = (1.0 - SURE) ** (1.0 / len(trackers))
    return (
        f"{late}; its starts are caught with each of {len(trackers)} draws of its errors (seeds {first.seed} to"
        f" {first.seed + len(trackers) - 1}), so one chosen beforehand has a chance of at least {chance:.3f}"
        f" ({100.0 * SURE:g} % confidence)",
    )


@dataclass
class _Runs:
    """Runs a behaviour from any number of starts, and counts them."""

    case: Case
    reflex: Reflex[Any]
    circumstances: tuple[Circumstances, ...]
    executor: Executor
    report: Report | None
    done: int = 0

    def caught(self, x: Floats, y: Floats) -> Bools:
        """Which starts (N,), (N,), m, end caught in all circumstances."""
        places = [(float(a), float(b), self.case.start.theta) for a, b in zip(x, y, strict=True)]
        found: list[bool] = []
        for part, runs in self.executor.map(_run_some, self._parts(places)):
            found += part
            self.done += runs
            if self.report is not None:
                self.report(self.done)
        return np.array(found, dtype=bool)

    def _parts(self, places: Sequence[tuple[float, float, float]]) -> Iterator[_Part]:
        for k in range(0, len(places), CHUNK):
            yield _Part(self.case, self.reflex, self.circumstances, tuple(places[k : k + CHUNK]))


@dataclass(frozen=True)
class _Part:
    case: Case
    reflex: Reflex[Any]
    circumstances: tuple[Circumstances, ...]
    places: tuple[tuple[float, float, float], ...]


def _run_some(part: _Part) -> tuple[list[bool], int]:
    """Whether each start of a part is caught in all circumstances, and how many runs it took to know."""
    found, runs = [], 0
    for place in part.places:
        caught = True
        for each in part.circumstances:
            caught = run_behaviour(part.case, place, each, part.reflex).trace.outcome.caught
            runs += 1
            if not caught:
                break
        found.append(caught)
    return found, runs


def _box(case: Case) -> Box:
    """Where a caught object may have started: within reach of the hand anywhere on its way."""
    hand, does, size = case.hand, case.behaviour, object_reach(case.object)
    way = does.advance if does.name in ADVANCING else 0.0
    if does.name is BehaviourName.MATCH_VELOCITY:
        # From anywhere that the arm can bring the hand to, and from where the disk flies there.
        width = 2.0 * (
            hand.half_palm + hand.finger_length + size + does.reach + abs(case.start.velocity[0]) * does.patience
        )
        height = hand.finger_length + 2.0 * size + does.reach + max(-case.start.velocity[1], 0.0) * does.patience
        return Box(width, height, COARSE, False)
    time, (vx, vy) = _duration(case), case.start.velocity
    width = 2.0 * (hand.half_palm + hand.finger_length + size + abs(way * cos(does.direction)) + abs(vx) * time)
    height = hand.finger_length + 2.0 * size + max(way * sin(does.direction), 0.0) + max(-vy, 0.0) * time
    if does.name is BehaviourName.FOLLOW_POLICY:
        width = max(width, 2.0 * (abs(case.start.at[0]) + does.uncertainty + size))
        height = max(height, case.start.at[1] + does.uncertainty + size)
    return Box(width, height, COARSE, _mirrored(case))


def _duration(case: Case) -> float:
    """Time (s) until the fingers are closed at the latest."""
    does = case.behaviour
    waits = does.advance / does.speed if does.name in ADVANCING else 0.0
    if does.name is BehaviourName.MATCHED_RETURN:
        waits = does.patience
    if does.name is BehaviourName.PALM_REFLEX:
        waits = (waits if does.advance > 0.0 else does.patience) + does.delay
    if does.name is BehaviourName.TOUCH_DOWN:
        waits = (pi - case.hand.open) / min(does.touch_rate, case.hand.finger_rate)
    if does.name in (BehaviourName.LET_GO, BehaviourName.FORCE_FEEDBACK):
        waits = does.delay + does.limp + does.patience
    return waits + (pi - case.hand.open) / case.hand.finger_rate


def _mirrored(case: Case) -> bool:
    """Whether the region is its own mirror image, ties of Coulomb's law apart."""
    if case.start.velocity[0] != 0.0:
        return False
    if not isinstance(case.object, Disk) or case.support.pressure_centre != (0.0, 0.0):
        return False
    if case.behaviour.name is BehaviourName.FOLLOW_POLICY:
        return False
    if case.behaviour.name is BehaviourName.TOUCH_DOWN and case.start.at[0] != 0.0:
        return False
    straight = case.behaviour.name not in ADVANCING or abs(case.behaviour.direction - 0.5 * pi) < 1e-9
    stretches = case.sensors.stretches(case.hand)
    felt = case.behaviour.name in UNFELT or _same(stretches, (_mirror(each, case) for each in stretches))
    return straight and felt


def _same(some: Iterable[Stretch], others: Iterable[Stretch]) -> bool:
    return {_key(each) for each in some} == {_key(each) for each in others}


def _key(each: Stretch) -> tuple[str, float, float | None]:
    return each.body, round(each.begin, 12), None if each.end is None else round(each.end, 12)


def _mirror(each: Stretch, case: Case) -> Stretch:
    if each.body == "palm":
        width = case.hand.palm_width
        begin, end = width - (each.end or width), width - each.begin
        return each.model_copy(update={"begin": begin, "end": None if each.end is None and begin == 0.0 else end})
    side, _, number = each.body.partition("_")
    other = {"right": "left", "left": "right"}[side]
    return each.model_copy(update={"body": f"{other}_{number}"})
