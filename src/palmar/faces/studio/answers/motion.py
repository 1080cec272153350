"""One closing motion to play: poses over time, contacts, and events; and MuJoCo's run beside it."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, radians
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from palmar.faces.cli.world_option import maker_of
from palmar.faces.plots.film_scene import Scene, scene, split
from palmar.faces.records import simulation_record
from palmar.faces.studio.answers.behaviour import is_simulated, motion_of, performed
from palmar.faces.studio.answers.drawing import MM, finger_lines, millimetres
from palmar.faces.studio.answers.part import Part, Question
from palmar.faces.trace_record import run_record
from palmar.models.case import Case
from palmar.models.outcome import Outcome
from palmar.models.quantity import LARGEST_LENGTH, Real, Value
from palmar.studies.simulate import Simulation, simulate_start
from palmar.studies.simulate_in_world import film_in, simulate_start_in
from palmar.worlds.world import WorldMaker

Millimetres = Annotated[Real, Field(ge=-MM * LARGEST_LENGTH, le=MM * LARGEST_LENGTH)]
Pair = tuple[Millimetres, Millimetres]
World = Literal["planar", "soft", "mujoco", "bed"]


class Begin(Value):
    """Where the object starts; what is not given is the case's."""

    start_mm: Pair | None = None
    theta_deg: Annotated[Real, Field(ge=-5730.0, le=5730.0)] | None = None
    velocity_mm_s: Pair | None = None
    world: World = "planar"


def simulate(asked: Question) -> Iterator[Part]:
    """The command line's record, then the motion: of closing, or of the case's behaviour under feedback."""
    case, given = asked.required_case, asked.parameters(Begin)
    value = _played(case, begin_of(case, given), maker_of(given.world))
    yield Part("record", value["record"])
    yield Part("motion", value["motion"])


def prediction(asked: Question) -> Iterator[Part]:
    """What the planar kernels say."""
    case, given = asked.required_case, asked.parameters(Begin)
    maker_of("bed")
    yield Part("prediction", _played(case, begin_of(case, given), None))


def bed(asked: Question) -> Iterator[Part]:
    """What happens in MuJoCo, with the test bed's servos."""
    case, given = asked.required_case, asked.parameters(Begin)
    yield Part("run", _played(case, begin_of(case, given), maker_of("bed")))


def begin_of(case: Case, given: Begin) -> tuple[float, ...]:
    """The start (x, y, theta, vx, vy) in SI."""
    x, y = case.start.at if given.start_mm is None else (1e-3 * each for each in given.start_mm)
    theta = case.start.theta if given.theta_deg is None else radians(given.theta_deg)
    vx, vy = case.start.velocity if given.velocity_mm_s is None else (1e-3 * each for each in given.velocity_mm_s)
    return x, y, theta, vx, vy


def simulated(case: Case, begin: tuple[float, ...], make: WorldMaker | None) -> Simulation:
    """As ``palmar simulate --start`` does."""
    return simulate_start(case, begin) if make is None else simulate_start_in(case, begin, make)


def record_of(case: Case, begin: tuple[float, ...], make: WorldMaker | None) -> dict[str, Any]:
    """`palmar simulate --json`, or `palmar behaviours run --json` where the case names another behaviour."""
    if is_simulated(case):
        return simulation_record(simulated(case, begin, make))
    return run_record(performed(case, begin, make))


def _played(case: Case, begin: tuple[float, ...], make: WorldMaker | None) -> dict[str, Any]:
    if not is_simulated(case):
        done = performed(case, begin, make)
        return {"record": run_record(done), "motion": motion_of(done)}
    result = simulated(case, begin, make)
    film = scene(case, begin, result, None if make is None else film_in(case, begin, make))
    return {"record": simulation_record(result), "motion": motion_value(film, result)}


def motion_value(film: Scene, result: Simulation) -> dict[str, Any]:
    """Everything that moves, at every moment of the film."""
    heights = [film.palm_at(time) for time in film.times]
    sides = [finger_lines(film.case.hand, *split(row)) for row in film.fingers.tolist()]
    risen = [np.array([0.0, height]) for height in heights]
    extent = film.extent
    return {
        "outcome": film.outcome.value,
        "caught": film.outcome.caught,
        "verdict": film.verdict,
        "duration_s": film.duration,
        "pace": film.pace,
        "times_s": film.times.tolist(),
        "poses": [[MM * x, MM * y, degrees(theta)] for x, y, theta in film.poses.tolist()],
        "right_mm": [millimetres(side[0] + up) for side, up in zip(sides, risen, strict=True)],
        "left_mm": [millimetres(side[1] + up) for side, up in zip(sides, risen, strict=True)],
        "fingers_deg": np.degrees(film.fingers).tolist(),
        "palm_mm": [MM * height for height in heights],
        "contacts_mm": [millimetres(each) if each else [] for each in film.contacts],
        "events": _events(film, result),
        "bounds_mm": [MM * each for each in (extent.left, extent.bottom, extent.right, extent.top)],
    }


def _events(film: Scene, result: Simulation) -> list[dict[str, Any]]:
    return [
        {"t_s": time, "words": words, "kind": event.kind, "body": event.body}
        for (time, words), (_, event) in zip(film.events, result.events, strict=True)
    ]


def outcomes() -> tuple[list[str], list[bool]]:
    """Names of the outcomes in the order of their codes, and whether each is a catch."""
    known = sorted(Outcome, key=lambda each: each.code)
    return [each.value for each in known], [each.caught for each in known]
