"""Hands for a task: sizes that suffice, preshapes, and closing strategies."""

from __future__ import annotations

from collections.abc import Iterator
from math import atan, isfinite
from typing import Annotated, Any, Literal

from pydantic import Field

from palmar.errors import InputError
from palmar.faces.closing_records import preshape_record, strategies_record
from palmar.faces.records import sizing_record
from palmar.faces.studio.answers.drawing import MM
from palmar.faces.studio.answers.library import case_value
from palmar.faces.studio.answers.part import Part, Question
from palmar.faces.words import sizing_line
from palmar.mechanics.closure.sizing import Dimension
from palmar.models.case import Case, Start
from palmar.models.contact import Contact
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import Disk
from palmar.models.quantity import LARGEST_LENGTH, Real, Value
from palmar.studies.preshape import preshapes
from palmar.studies.sizing import Sizing, size_hand
from palmar.studies.strategies import QUICK, strategies, winner

Size = Annotated[Real, Field(gt=0.0, le=MM * LARGEST_LENGTH)]


class Design(Value):
    """Which study; the rest is for sizes."""

    study: Literal["size", "preshape", "strategies"] = "size"
    radius_mm: tuple[Size, Size] | None = None
    palm_width_mm: Size | None = None
    finger_length_mm: Size | None = None
    friction: Annotated[Real, Field(ge=0.0, le=100.0)] = 0.0
    thickness_mm: Annotated[Real, Field(ge=0.0, le=MM * LARGEST_LENGTH)] = 0.0
    colliding: bool = False


def design(asked: Question) -> Iterator[Part]:
    """The study asked for."""
    given = asked.parameters(Design)
    if given.study == "size":
        yield _sized(given)
    elif given.study == "preshape":
        yield Part("preshape", preshape_record(preshapes(asked.required_case)))
    else:
        found = strategies(asked.required_case, effort=QUICK)
        yield Part("strategies", strategies_record(found, winner(found)), guarantee=Guarantee.SAMPLED)


def _sized(given: Design) -> Part:
    """``palmar closure size``, and the smallest hand that suffices."""
    if given.radius_mm is None or not given.radius_mm[0] <= given.radius_mm[1]:
        raise InputError("parameters.radius_mm", None, "needs the smallest and the largest radius, in this order")
    if (given.palm_width_mm is None) == (given.finger_length_mm is None):
        raise InputError("parameters", None, "give exactly one of palm_width_mm and finger_length_mm")
    smallest, largest = (1e-3 * each for each in given.radius_mm)
    palm, finger = (None if each is None else 1e-3 * each for each in (given.palm_width_mm, given.finger_length_mm))
    thickness = 1e-3 * given.thickness_mm
    found = size_hand(smallest, largest, palm, finger, atan(given.friction), thickness, crossing=not given.colliding)
    value: dict[str, Any] = {**sizing_record(found), "words": sizing_line(found), "case": _case(given, found)}
    return Part("sizing", value, guarantee=Guarantee.CLOSED_FORM)


def _case(given: Design, found: Sizing) -> dict[str, Any] | None:
    """The smallest hand that suffices, before the largest object; None where none does."""
    if not found.intervals or not isfinite(found.intervals[0][0]):
        return None
    sought = found.intervals[0][0]
    palm = sought if found.sought is Dimension.HALF_PALM else 1e-3 * (given.palm_width_mm or 0.0)
    finger = sought if found.sought is Dimension.FINGER_LENGTH else 1e-3 * (given.finger_length_mm or 0.0)
    fingers = Fingers.COLLIDING if given.colliding else Fingers.CROSSING
    thickness = 1e-3 * given.thickness_mm
    case = Case(
        hand=Hand(palm_width=palm, finger_links=(finger,), finger_thickness=thickness, fingers=fingers),
        object=Disk(radius=found.radius_max),
        contact=Contact(friction=given.friction),
        start=Start(at=(0.0, 1.5 * found.radius_max)),
    )
    tables: dict[str, Any] = case_value(case)["case"]
    return tables
