"""The closure map of the 4-jointed hand, and the hand at one of its points."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from palmar.faces.jointed_record import map_record
from palmar.faces.plots.closure_map_picture import posture
from palmar.faces.records import finite
from palmar.faces.studio.answers.drawing import MM, drawing, finger_lines, millimetres
from palmar.faces.studio.answers.library import case_value
from palmar.faces.studio.answers.part import Part, Question
from palmar.mechanics.closure.chain import Chain, largest_hold
from palmar.models.case import Case, Start
from palmar.models.contact import Contact
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.models.quantity import LARGEST_LENGTH, Real, Value
from palmar.studies.closure_map import closure_map, grid_map

LEAST_SHARE = 1e-3
"""Of half the hand, of palm and links of a hand that is drawn."""


class Grid(Value):
    """So many points along each link."""

    grid: Annotated[int, Field(ge=2, le=201, strict=True)] = 61


class At(Value):
    """Both links as shares of half the hand, and that half's length."""

    distal: Annotated[Real, Field(ge=0.0, le=1.0)]
    proximal: Annotated[Real, Field(ge=0.0, le=1.0)]
    half_mm: Annotated[Real, Field(ge=1e-3, le=MM * LARGEST_LENGTH)] = 250.0


def whole_map(asked: Question) -> Iterator[Part]:
    """``palmar closure map``."""
    result = grid_map(asked.parameters(Grid).grid)
    yield Part("map", map_record(result), guarantee=Guarantee.CLOSED_FORM)


def hand_at(asked: Question) -> Iterator[Part]:
    """What the hand at one point holds, the hand drawn, and how it holds its largest disk."""
    at = asked.parameters(At)
    record = finite(map_record(closure_map(np.array([at.distal]), np.array([at.proximal]))))
    radii = {side: {name: each[0] for name, each in record[side].items()} for side in ("radius_min", "radius_max")}
    low, high = radii["radius_min"]["overall"], radii["radius_max"]["overall"]
    palm = 1.0 - at.distal - at.proximal
    held = low is not None and high is not None and isfinite(high)
    case = _case(at, palm, high if held else None)
    value: dict[str, Any] = {
        "distal": at.distal,
        "proximal": at.proximal,
        "palm": palm,
        **radii,
        "radius_mm": [at.half_mm * low, at.half_mm * high] if held else None,
        "drawing": None if case is None else drawing(case),
        "case": None if case is None else case_value(case)["case"],
        "hold": None if case is None or not held else _hold(case),
    }
    yield Part("hand", value, guarantee=Guarantee.CLOSED_FORM)


def _case(at: At, palm: float, largest: float | None) -> Case | None:
    """The hand with the largest disk it holds, a little less; None where there is no such hand."""
    if min(palm, at.distal, at.proximal) < LEAST_SHARE:
        return None
    half = 1e-3 * at.half_mm
    radius = half * (0.95 * largest if largest else 0.1)
    return Case(
        hand=Hand(palm_width=2.0 * half * palm, finger_links=(half * at.proximal, half * at.distal)),
        object=Disk(radius=radius),
        contact=Contact(friction=0.0),
        start=Start(at=(0.0, 1.2 * radius)),
    )


def _hold(case: Case) -> dict[str, Any] | None:
    """The pose that holds the largest disk."""
    links = case.hand.finger_links
    hold = largest_hold(Chain(case.hand.half_palm, links))
    if hold is None:
        return None
    joints = posture(hold.joints, links, hold.radius, hold.height, hold.elevation)
    right, left = finger_lines(case.hand, joints, joints)
    return {
        "radius_mm": MM * hold.radius,
        "centre_mm": [0.0, MM * hold.height],
        "right_mm": millimetres(right),
        "left_mm": millimetres(left),
    }
