"""What the object rests on."""

from __future__ import annotations

from enum import Enum
from typing import Annotated

from pydantic import Field

from palmar.models.quantity import LARGEST_LENGTH, Point, Real, Unit, Value


class SupportKind(Enum):
    """Which mechanics govern the object between contacts."""

    TABLE = "table"
    """Quasi-static sliding: friction with the table dominates, inertia is negligible (chapter 3)."""
    FREE = "free"
    """Zero gravity: the object flies freely between contacts (chapter 4)."""


class Pressure(Enum):
    """How the object's weight is spread over its base."""

    UNIFORM = "uniform"
    RIM = "rim"
    CENTRE = "centre"


class Support(Value):
    """The support: its kind, and for a table the friction and pressure under the object."""

    kind: SupportKind = SupportKind.TABLE
    friction: Annotated[Real, Field(ge=0.0, le=100.0)] = 0.3
    pressure: Pressure = Pressure.UNIFORM
    pressure_centre: Annotated[Point, Unit.MILLIMETRE] = (0.0, 0.0)
    """Offset of the centre of pressure from the object's centroid, in the object's frame."""
    wall: Annotated[Real | None, Field(gt=0.0, le=LARGEST_LENGTH), Unit.MILLIMETRE] = None
    """A wall ahead, parallel to the palm, at this distance from it at the start; it stays where it is. Absent = none."""
