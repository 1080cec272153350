"""Options that commands about behaviours share."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import number, numbers
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.case_file import with_layout
from palmar.models.support import SupportKind

if TYPE_CHECKING:
    from palmar.worlds.planar.tracker import Tracker

NAMES = tuple(each.value for each in BehaviourName)
Number = Annotated[str, Parameter(allow_leading_hyphen=True)]
Named = Annotated[str | None, Parameter(help="Instead of the case's, with its parameters.")]
Layout = Annotated[
    str | None, Parameter(help="Instead of the case's: none, palm, tips, distributed, full, or PART[,PART...].")
]
Massive = Annotated[
    bool | None,
    Parameter(help="While only the arm moves, touch does not move the object but stops the arm; else as usual."),
]
Velocity = Annotated[
    str | None,
    Parameter(help="VX,VY in mm/s of a free object; else the case's start velocity.", allow_leading_hyphen=True),
]
Track = Annotated[
    str | None,
    Parameter(
        help="DELAY_MS,POSITION_MM,VELOCITY_MM_S: a tracker of a free object, how late, and its standard deviations."
    ),
]


def with_velocity(case: Case, velocity: str | None) -> Case:
    """The case with the start velocity of the option, where it is given."""
    if velocity is None:
        return case
    vx, vy = (1e-3 * each for each in numbers(velocity, "--velocity", (2,), "VX,VY"))
    if case.support.kind is not SupportKind.FREE:
        raise InputError("--velocity", velocity[:60], 'an object on a table starts at rest: support.kind = "free"')
    return case.model_copy(update={"start": case.start.model_copy(update={"velocity": (vx, vy)})})


def placed(case: Case, start: str | None) -> Case:
    """The case with the start place of the option, where it is given."""
    if start is None:
        return case
    x, y = (1e-3 * each for each in numbers(start, "--start", (2,), "X_MM,Y_MM"))
    return case.model_copy(update={"start": case.start.model_copy(update={"at": (x, y)})})


def tracker_of(track: str | None, seed: int) -> Tracker | None:
    """The tracker of the option; None without it."""
    from palmar.worlds.planar.tracker import Tracker

    if track is None:
        return None
    form = "DELAY_MS,POSITION_MM,VELOCITY_MM_S"
    values = numbers(track, "--track", (3,), form)
    if min(values) < 0.0:
        raise InputError("--track", track[:60], f"{form} must not be negative")
    delay, position, velocity = (1e-3 * each for each in values)
    return Tracker(delay, position, velocity, seed)


def with_behaviour(case: Case, behaviour: str | None, sensors: str | None) -> Case:
    """The case with the behaviour and the sensors of the options, where they are given."""
    case = case if sensors is None else with_layout(case, sensors, "--sensors")
    if behaviour is None:
        return case
    chosen = named(behaviour, "--behaviour")
    return case.model_copy(update={"behaviour": case.behaviour.model_copy(update={"name": chosen})})


def named(text: str, option: str) -> BehaviourName:
    """A behaviour by its name; raises InputError with a hint."""
    if text not in NAMES:
        close = difflib.get_close_matches(text, NAMES, n=1)
        hint = f"did you mean {close[0]}?" if close else f"must be one of {', '.join(NAMES)}"
        raise InputError(option, repr(text[:60]), hint)
    return BehaviourName(text)


def within(option: str, text: str, low: float, high: float) -> float:
    """A number between two others; raises InputError."""
    value = number(text, option)
    if not low <= value <= high:
        raise InputError(option, text[:60], f"must be from {low:g} to {high:g}")
    return value
