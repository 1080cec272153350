"""Options that commands about behaviours share."""

from __future__ import annotations

import difflib
from typing import Annotated

from cyclopts import Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import number
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.case_file import with_layout

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
