"""What is to be held: a disk or a convex polygon, seen along the cylinder's or prism's axis."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, field_validator

from palmar.geometry.polygon import checked_convex
from palmar.models.quantity import Length, Point, Real, Unit, Value

MOST_VERTICES = 2_000
"""A simulation of so many takes some seconds; the time grows with the square of their number."""

Mass = Annotated[Real, Field(gt=0.0, le=1e9), Unit.KILOGRAM]


class Disk(Value):
    """A disk: radius R (m), mass (kg) with its centre of mass in the middle."""

    shape: Literal["disk"] = "disk"
    radius: Annotated[Length, Unit.MILLIMETRE]
    mass: Mass = 1.0


class ConvexPolygon(Value):
    """A convex polygon in its own frame: vertices (m), kept counter-clockwise without repeated or collinear points."""

    shape: Literal["polygon"]
    vertices: Annotated[tuple[Point, ...], Field(min_length=3, max_length=MOST_VERTICES), Unit.MILLIMETRE]
    mass: Mass = 1.0

    @field_validator("vertices")
    @classmethod
    def _convex(cls, vertices: tuple[Point, ...]) -> tuple[Point, ...]:
        return checked_convex(vertices)


Object = Annotated[Disk | ConvexPolygon, Field(discriminator="shape")]
