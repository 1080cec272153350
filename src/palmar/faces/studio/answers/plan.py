"""A plan by touch, and the way of an object that takes the most approaches."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, pi
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from palmar.errors import InputError
from palmar.faces.cli.uncertainty import parse_uncertainty
from palmar.faces.plan_record import plan_record
from palmar.faces.plots.hand import finger_points
from palmar.faces.studio.answers.drawing import MM, bounds, millimetres, shown
from palmar.faces.studio.answers.motion import Pair
from palmar.faces.studio.answers.part import Part, Question
from palmar.geometry.planar_set import areal
from palmar.geometry.polygon import turned
from palmar.models.case import Case
from palmar.models.case_file import with_layout
from palmar.models.closure import Closure
from palmar.models.quantity import LARGEST_LENGTH, Real, Value
from palmar.studies.plan import Plan, Rule
from palmar.studies.plan import plan as planned
from palmar.studies.plan_walk import Moment, longest_way, walk

LEAST = 2e-3
"""A belief that has shrunk to a point or line is drawn this share of the finger's length wide."""
Size = Annotated[Real, Field(gt=0.0, le=MM * LARGEST_LENGTH)]
Floats = NDArray[np.float64]


class Uncertainty(Value):
    """Where the object may be about its place: a disk's radius, or a box's width and height; exactly one."""

    disk_mm: Size | None = None
    box_mm: tuple[Size, Size] | None = None


class Planning(Value):
    """The command line's options; what is not given is the case's."""

    uncertainty: Uncertainty = Uncertainty(disk_mm=20.0)
    at_mm: Pair | None = None
    approaches_max: Annotated[int, Field(ge=0, le=6, strict=True)] = 3
    rule: Rule = Rule.FEWEST
    directions: Annotated[int, Field(ge=1, le=24, strict=True)] = 1
    sensors: Annotated[str, Field(max_length=2000)] | None = None
    closure: Closure = Closure.FRICTIONAL


def plan(asked: Question) -> Iterator[Part]:
    """The plan's record, then its moments."""
    given = asked.parameters(Planning)
    case, found = made(asked.required_case, given)
    yield Part("record", plan_record(found, given.approaches_max, None), guarantee=found.guarantee)
    yield Part("moments", _moments(case, list(walk(case, found, longest_way(case, found)))))


def made(case: Case, given: Planning) -> tuple[Case, Plan]:
    """The case with the sensors asked for, and the plan as ``palmar plan`` makes it."""
    if given.sensors is not None:
        case = with_layout(case, given.sensors, "parameters.sensors")
    if given.directions > 1 and given.rule is not Rule.FEWEST:
        raise InputError("parameters.directions", str(given.directions), f'only with the rule "{Rule.FEWEST.value}"')
    place = case.start.at if given.at_mm is None else (1e-3 * given.at_mm[0], 1e-3 * given.at_mm[1])
    facing = tuple(2.0 * pi * k / given.directions for k in range(given.directions))
    errors = parse_uncertainty(_words(given.uncertainty), "parameters.uncertainty")
    return case, planned(case, errors, place, given.approaches_max, given.closure, given.rule, facing)


def _words(given: Uncertainty) -> str:
    """As on the command line; never the name of a file."""
    if (given.disk_mm is None) == (given.box_mm is None):
        raise InputError("parameters.uncertainty", None, "give exactly one of disk_mm and box_mm")
    if given.disk_mm is not None:
        return f"disk:{given.disk_mm!r}"
    wide, high = given.box_mm or (0.0, 0.0)
    return f"box:{wide!r},{high!r}"


def _moments(case: Case, moments: list[Moment]) -> dict[str, Any]:
    hands = [_hand(case, each) for each in moments]
    length = case.hand.finger_length
    beliefs = [areal(each.belief.buffer(LEAST * length)) for each in moments]
    corners = [np.array(each.bounds).reshape(2, 2) for each in beliefs if not each.is_empty]
    return {
        "moments": [
            {
                "palm_mm": millimetres(palm),
                "right_mm": millimetres(right),
                "left_mm": millimetres(left),
                "hand": [MM * each.hand[0], MM * each.hand[1], degrees(each.hand[2])],
                "object_mm": millimetres(each.thing),
                "belief_mm": shown(belief, length),
                "doing": each.doing,
            }
            for each, belief, (palm, right, left) in zip(moments, beliefs, hands, strict=True)
        ],
        "bounds_mm": bounds([*(line for lines in hands for line in lines), *corners]),
    }


def _hand(case: Case, moment: Moment) -> tuple[Floats, Floats, Floats]:
    """Palm, right and left finger (m) in the frame of the start."""
    x, y, facing = moment.hand
    half = case.hand.half_palm
    palm = np.array([[-half, 0.0], [half, 0.0]])
    right, left = (finger_points(case.hand, (psi,), left=k == 1) for k, psi in enumerate(moment.fingers))
    palm, right, left = (turned(line, facing) + np.array([x, y]) for line in (palm, right, left))
    return palm, right, left
