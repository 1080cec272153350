"""Units of the case file, and the base of all frozen inputs.

A field is stated once, in SI, and carries its file unit: ``palm_width`` with ``Unit.MILLIMETRE`` is written
``palm_width_mm`` in a case file. Inside Python everything is SI and radians.
"""

from __future__ import annotations

import math
from enum import Enum
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, Strict
from pydantic.fields import FieldInfo

SMALLEST_LENGTH, LARGEST_LENGTH = 1e-9, 1000.0
"""Bounds of every length (m): beyond them an input is a slip of units, not a hand."""


class Unit(Enum):
    """A unit of the case file: its key suffix, its printed name, and SI = value * factor / divisor."""

    MILLIMETRE = ("mm", "mm", 1.0, 1000.0)
    MILLIMETRE_PER_SECOND = ("mm_s", "mm/s", 1.0, 1000.0)
    MILLIMETRE_PER_SECOND_SQUARED = ("mm_s2", "mm/s^2", 1.0, 1000.0)
    DEGREE = ("deg", "deg", math.pi, 180.0)
    DEGREE_PER_SECOND = ("deg_s", "deg/s", math.pi, 180.0)
    DEGREE_PER_SECOND_SQUARED = ("deg_s2", "deg/s^2", math.pi, 180.0)
    KILOGRAM = ("kg", "kg", 1.0, 1.0)
    NEWTON_METRE = ("N_m", "N m", 1.0, 1.0)
    NEWTON = ("N", "N", 1.0, 1.0)
    NEWTON_PER_MILLIMETRE = ("N_mm", "N/mm", 1000.0, 1.0)
    SECOND = ("s", "s", 1.0, 1.0)
    KILOGRAM_SQUARE_METRE = ("kg_m2", "kg m^2", 1.0, 1.0)
    NEWTON_SECOND_PER_METRE = ("N_s_m", "N s/m", 1.0, 1.0)

    def __init__(self, suffix: str, printed: str, factor: float, divisor: float) -> None:
        self.suffix, self.printed, self._factor, self._divisor = suffix, printed, factor, divisor

    def to_si(self, value: float) -> float:
        """Value in this unit -> SI."""
        return value * self._factor / self._divisor

    def from_si(self, value: float) -> float:
        """SI -> the shortest decimal in this unit that reads back as the same SI number, where one exists."""
        plain = value * self._divisor / self._factor
        candidates = (float(f"{plain:.{digits}g}") for digits in range(6, 18))
        return next((short for short in candidates if self.to_si(short) == value), plain)


def unit_of(field: FieldInfo) -> Unit | None:
    """The file unit a model's field carries."""
    return next((each for each in field.metadata if isinstance(each, Unit)), None)


def file_key(name: str, field: FieldInfo) -> str:
    """The key of a model's field in a case file: its name and the suffix of its unit."""
    unit = unit_of(field)
    return name if unit is None else f"{name}_{unit.suffix}"


Real = Annotated[float, Strict()]
"""A finite real number; text and booleans are not numbers."""
Length = Annotated[Real, Field(ge=SMALLEST_LENGTH, le=LARGEST_LENGTH)]
Coordinate = Annotated[Real, Field(ge=-LARGEST_LENGTH, le=LARGEST_LENGTH)]
Point = tuple[Coordinate, Coordinate]


class Value(BaseModel):
    """A frozen input, validated once, at its constructor; change one with ``model_copy`` or a new constructor call."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
