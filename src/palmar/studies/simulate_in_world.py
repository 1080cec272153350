"""A closing motion carried out tick by tick in any world, told as ``studies.simulate`` tells it."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.behaviours.build import reflex_of
from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.closing import Ends
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.jointed_motion import JOINTED_CLOSING
from palmar.models.outcome import Outcome
from palmar.models.sensors import Sensors, Stretch
from palmar.models.support import SupportKind
from palmar.studies.simulate import Simulation
from palmar.worlds.planar import table
from palmar.worlds.planar.bits import Sensing
from palmar.worlds.planar.events import Event
from palmar.worlds.run import Ended, Trace, run
from palmar.worlds.world import WorldMaker

Floats = NDArray[np.float64]
TICK = 0.01
"""Time (s) between two observations, to which events are known."""
_KINDS = {"fires": "touch", "quiet": "leave", "held_up": "stall"}


def simulate_start_in(case: Case, start: ArrayLike, make: WorldMaker) -> Simulation:
    """Simulate one start (x, y[, theta[, vx, vy]]) in SI; raises NotCoveredError for what the world does not have."""
    trace = _close(case, _rows(case, np.asarray(start, dtype=float))[0], make)
    last = trace.rows[-1]
    happened = _events(case, trace) if trace.outcome is not Outcome.INVALID else ()
    return Simulation(trace.outcome, last.pose, last.seen.left, last.seen.right, tuple(happened))


def simulate_starts_in(case: Case, starts: ArrayLike, make: WorldMaker) -> Ends:
    """Simulate starts (N, 2 to 5) in SI: x, y[, theta[, vx, vy]]; one after the other."""
    traces = [_close(case, row, make) for row in _rows(case, starts)]
    return Ends(
        np.array([each.outcome.code for each in traces], np.int8),
        np.array([each.rows[-1].pose for each in traces]).reshape(-1, 3),
        np.array([[each.rows[-1].seen.right[0], each.rows[-1].seen.left[0]] for each in traces]).reshape(-1, 2),
    )


def film_in(case: Case, start: ArrayLike, make: WorldMaker) -> table.Trace:
    """The poses and the angles of all joints from observation to observation."""
    rows = _close(case, _rows(case, np.asarray(start, dtype=float))[0], make).rows
    times = np.array([each.seen.time for each in rows])
    kept = np.append(np.diff(times) > 0.0, True)
    joints = np.array([(*each.seen.right, *each.seen.left) for each in rows])
    psi = case.hand.open + case.hand.finger_rate * times
    return table.Trace(psi[kept], np.array([each.pose for each in rows])[kept], joints[kept])


def _close(case: Case, row: Floats, make: WorldMaker) -> Trace:
    """Close from one start, with a sensor on every part of the hand that tells of touches."""
    parts = tuple(Stretch(body=each) for each in _parts(case))
    x, y, theta, vx, vy = (float(each) for each in row)
    start = case.start.model_copy(update={"velocity": (vx, vy)})
    felt = case.model_copy(update={"sensors": Sensors(layout=parts), "start": start})
    world = make(felt, (x, y, theta), tick=TICK, sensing=Sensing(), massive=False)
    return run(world, reflex_of(case), tuple(each.body for each in parts))


def _rows(case: Case, starts: ArrayLike) -> Floats:
    """Starts as (N, 5); what is not given is the case's."""
    if case.behaviour.name is not BehaviourName.CLOSE and case.behaviour.name not in JOINTED_CLOSING:
        name = case.behaviour.name.value
        raise NotCoveredError(
            f'behaviour.name = "{name}": simulate is for closing, palmar behaviours run for the others'
        )
    rows = np.atleast_2d(np.asarray(starts, dtype=float))
    theta = case.start.theta if case.support.kind is SupportKind.FREE else 0.0
    wide = np.tile([0.0, 0.0, theta, *case.start.velocity], (len(rows), 1))
    wide[:, : rows.shape[1]] = rows
    return wide


def _parts(case: Case) -> list[str]:
    count = len(case.hand.finger_links)
    return ["palm", *(f"{side}_{k + 1}" for side in ("right", "left") for k in range(count))]


def _events(case: Case, trace: Trace) -> Iterable[tuple[float, Event]]:
    """Touches, stalls and the end; in free space, and where nothing is caught, fingers end without a stall."""
    last = trace.rows[-1].seen.time
    alone = case.support.kind is SupportKind.FREE or not trace.outcome.caught
    for each in trace.happenings:
        if each.kind in _KINDS and not (alone and each.kind == "held_up" and each.time >= last):
            yield each.time, Event(_angle(case, each.time), _KINDS[each.kind], _name(case, each.what))
    ended = trace.outcome.value if trace.ended is Ended.STOPPED else trace.ended.value
    yield last, Event(_angle(case, last), "end", ended)


def _angle(case: Case, time: float) -> float:
    return case.hand.open + case.hand.finger_rate * time


def _name(case: Case, what: str) -> str:
    """A part of the hand as the planar world calls it."""
    side, _, number = what.partition("_")
    if not number.isdigit():
        return what
    return f"{side}_link_{number}" if len(case.hand.finger_links) > 1 else f"{side}_link"
