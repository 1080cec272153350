"""Carry an object through a closing motion, of base joints or of both joints: one start in detail, or many."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.closing import Ends
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.device import Device
from palmar.models.jointed_motion import JOINTED_CLOSING
from palmar.models.outcome import Outcome
from palmar.models.support import SupportKind
from palmar.worlds.planar.events import Event, events
from palmar.worlds.planar.table import Trace, covered, table_world, trace


@dataclass(frozen=True)
class Simulation:
    """One start: how it ended, the final pose (m, rad), joint angles (rad) left and right, events with their times (s)."""

    outcome: Outcome
    pose: tuple[float, float, float]
    left: tuple[float, ...]
    right: tuple[float, ...]
    events: tuple[tuple[float, Event], ...]


def simulate_start(case: Case, start: ArrayLike) -> Simulation:
    """Simulate one start (x, y[, theta[, vx, vy]]) in SI.

    Raises NotCoveredError for cases that no kernel carries.
    """
    if case.support.kind is SupportKind.FREE:
        return _simulate_free(case, start)
    place = _places(case, np.atleast_2d(np.asarray(start, dtype=float)))
    if case.behaviour.name in JOINTED_CLOSING:
        return _simulate_jointed(case, place[0])
    ends = _ends(case, place)
    outcome = Outcome.from_code(int(ends.codes[0]))
    found = _events(case, place[0], outcome) if outcome is not Outcome.INVALID else ()
    x, y, theta = (float(each) for each in ends.poses[0])
    straight = (0.0,) * (len(case.hand.finger_links) - 1)
    right, left = (float(each) for each in ends.fingers[0])
    return Simulation(
        outcome,
        (x, y, theta),
        (left, *straight),
        (right, *straight),
        _timed(case, found),
    )


def simulate_starts(case: Case, starts: ArrayLike, device: Device = Device.CPU) -> Ends:
    """Simulate starts (N, 2 to 5) in SI: x, y[, theta[, vx, vy]].

    On a GPU, disks only: closed on by straight fingers on a table, or floating. What the event-to-event kernel leaves open
    is left to processors. Raises NotCoveredError for other cases, and where no GPU is.
    """
    if case.support.kind is SupportKind.FREE:
        from palmar.worlds.planar.free import free_world

        world, rows = free_world(_closing(case)), _moving(case, starts)
        if device is Device.CPU:
            return world.ends(rows)
        from palmar.worlds.planar.on_gpu import free_ends

        return free_ends(world, rows)
    places = _places(case, np.atleast_2d(np.asarray(starts, dtype=float)))
    if device is Device.GPU:
        _refuse_uncovered_by_gpu(case)
    return _ends(case, places, device)


def _simulate_free(case: Case, start: ArrayLike) -> Simulation:
    from palmar.worlds.planar.free import free_world

    world = free_world(_closing(case))
    outcome, pose, joints, found = world.start(_moving(case, start)[0])
    return Simulation(outcome, pose, *_fingers(case, joints), _timed(case, found))


def _simulate_jointed(case: Case, place: NDArray[np.float64]) -> Simulation:
    """By the stepping kernel, or by the behaviour's own program where a finger is held up before its last stretch."""
    from palmar.worlds.planar.jointed import jointed_world

    x, y, theta = (float(each) for each in place)
    found = jointed_world(case).carried((x, y, theta))
    if found.outcome is None:
        return _under_feedback(case, (x, y, theta))
    return Simulation(found.outcome, found.pose, *_fingers(case, found.joints), _timed(case, found.events))


def _under_feedback(case: Case, start: ArrayLike) -> Simulation:
    from palmar.studies.simulate_in_world import simulate_start_in
    from palmar.worlds.planar.feedback import feedback_world

    return simulate_start_in(case, start, feedback_world)


def _fingers(case: Case, joints: Sequence[float]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Left and right finger, from the right one's joints and the left one's; what is not there is straight."""
    count = len(joints) // 2
    straight = (0.0,) * (len(case.hand.finger_links) - count)
    return (*joints[count:], *straight), (*joints[:count], *straight)


def _timed(case: Case, found: Iterable[Event]) -> tuple[tuple[float, Event], ...]:
    return tuple(((each.psi - case.hand.open) / case.hand.finger_rate, each) for each in found)


def _moving(case: Case, starts: ArrayLike) -> NDArray[np.float64]:
    """Starts as (N, 5); velocities that are not given are the case's."""
    rows = np.atleast_2d(np.asarray(starts, dtype=float))
    wide = np.tile([0.0, 0.0, case.start.theta, *case.start.velocity], (len(rows), 1))
    wide[:, : rows.shape[1]] = rows
    return wide


def _ends(case: Case, places: NDArray[np.float64], device: Device = Device.CPU) -> Ends:
    """Event to event where that kernel covers the case, else in steps; jointed motions stretch by stretch."""
    if case.behaviour.name in JOINTED_CLOSING:
        return _jointed_ends(case, places)
    if not covered(case):
        from palmar.worlds.planar.stepping import stepping_world

        return stepping_world(case).ends(places)
    ends = _event_to_event(case, places[:, :2], device)
    codes, poses, fingers = ends.codes.copy(), ends.poses.copy(), ends.fingers.copy()
    poses[:, 2] += places[:, 2]
    left = np.flatnonzero(codes == Outcome.UNDECIDED.code)
    if len(left):
        from palmar.worlds.planar.stepping import stepping_world

        rest = stepping_world(case).ends(places[left])
        codes[left], poses[left], fingers[left] = rest.codes, rest.poses, rest.fingers
    return Ends(codes, poses, fingers)


def _event_to_event(case: Case, places: NDArray[np.float64], device: Device) -> Ends:
    if device is Device.CPU:
        return table_world(case).ends(places)
    from palmar.worlds.planar.on_gpu import table_ends

    return table_ends(table_world(case), places)


def _refuse_uncovered_by_gpu(case: Case) -> None:
    if case.behaviour.name in JOINTED_CLOSING or not covered(case):
        raise NotCoveredError(
            'device "gpu": on a table only straight fingers closing on a disk that is pressed about its centre, and no wall'
        )


def _jointed_ends(case: Case, places: NDArray[np.float64]) -> Ends:
    """Those at which a finger is held up too soon one after the other, under feedback."""
    from palmar.worlds.planar.jointed import jointed_world

    ends, held_up = jointed_world(case).ends(places)
    codes, poses, fingers = ends.codes.copy(), ends.poses.copy(), ends.fingers.copy()
    for k in np.flatnonzero(held_up):
        told = _under_feedback(case, places[k])
        codes[k], poses[k], fingers[k] = told.outcome.code, told.pose, (told.right[0], told.left[0])
    return Ends(codes, poses, fingers)


def _in_steps(case: Case, place: NDArray[np.float64]) -> bool:
    """Whether a start is for the stepping kernel: the case, or a start that the event-to-event kernel leaves open."""
    if not covered(case):
        return True
    return bool(table_world(case).ends(place[None, :2]).codes[0] == Outcome.UNDECIDED.code)


def _events(case: Case, place: NDArray[np.float64], outcome: Outcome) -> tuple[Event, ...]:
    x, y, theta = (float(each) for each in place)
    if _in_steps(case, place):
        from palmar.worlds.planar.stepping import stepping_world

        return stepping_world(case).events((x, y, theta), outcome.value)
    return events(table_world(case), (x, y), outcome.value)


def film(case: Case, start: tuple[float, ...], frames: int) -> Trace:
    """The poses of one valid start (3,) or (5,) at equal steps of the closing angle, in free space of time."""
    if case.support.kind is SupportKind.FREE:
        from palmar.worlds.planar.free import free_world

        return free_world(case).trace(_moving(case, [start])[0], frames)
    x, y, theta = start[:3]
    if case.behaviour.name in JOINTED_CLOSING:
        from palmar.worlds.planar.jointed import jointed_world

        world = jointed_world(case)
        found = world.carried((x, y, theta))
        return _film_under_feedback(case, (x, y, theta)) if found.outcome is None else world.trace(found, frames)
    if _in_steps(case, np.array([x, y, theta])):
        from palmar.worlds.planar.stepping import stepping_world

        return stepping_world(case).trace((x, y, theta), frames)
    whole = trace(table_world(case), (x, y), frames)
    return Trace(whole.psi, whole.poses + np.array([0.0, 0.0, theta]), whole.fingers)


def _film_under_feedback(case: Case, start: tuple[float, float, float]) -> Trace:
    from palmar.studies.simulate_in_world import film_in
    from palmar.worlds.planar.feedback import feedback_world

    return film_in(case, start, feedback_world)


def _places(case: Case, starts: NDArray[np.float64]) -> NDArray[np.float64]:
    """Starts as (N, 3): x, y, theta; a velocity is refused, sliding on a table has no memory of it."""
    case = _closing(case)
    wide = np.zeros((len(starts), 5))
    wide[:, : starts.shape[1]] = starts
    if np.any(wide[:, 3:]) or case.start.velocity != (0.0, 0.0):
        raise NotCoveredError("velocity: quasi-static sliding on a table has no initial velocity")
    return wide[:, :3]


def _closing(case: Case) -> Case:
    """The case, if closing is what its hand does: with the base joints, or with both."""
    if case.behaviour.name is not BehaviourName.CLOSE and case.behaviour.name not in JOINTED_CLOSING:
        name = case.behaviour.name.value
        raise NotCoveredError(
            f'behaviour.name = "{name}": simulate is for closing, palmar behaviours run for the others'
        )
    return case
