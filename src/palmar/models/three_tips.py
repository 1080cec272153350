"""Three round fingertips at 120 degrees that close on a cylinder from all sides, seen along its axis."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, Self

from pydantic import Field, model_validator

from palmar.models.quantity import LARGEST_LENGTH, Length, Real, Unit, Value


class ThreeTips(Value):
    """Fingertips of one radius on a circle that shrinks from ``open_radius`` to ``closed_radius`` (m, of their centres).

    They stand at 90, 210 and 330 degrees, move radially at one rate, in a plane parallel to the table, and do not give way.
    ``palm_radius`` (m) is that of a round palm in the middle that feels what touches it; None: there is none.
    """

    tip_radius: Annotated[Length, Unit.MILLIMETRE]
    open_radius: Annotated[Length, Unit.MILLIMETRE]
    closed_radius: Annotated[Length, Unit.MILLIMETRE]
    palm_radius: Annotated[Real | None, Field(gt=0.0, le=LARGEST_LENGTH), Unit.MILLIMETRE] = None

    @model_validator(mode="after")
    def _possible(self) -> Self:
        if not self.closed_radius < self.open_radius:
            raise ValueError("the closed circle must be smaller than the open one")
        if self.closed_radius < self.touching * (1.0 - 1e-12):
            least = Unit.MILLIMETRE.from_si(self.touching)
            raise ValueError(
                f"closed so far the tips would overlap: their circle has a radius of at least {least:.4g} mm"
            )
        return self

    @property
    def touching(self) -> float:
        """Radius (m) of the circle on which the tips touch each other: 2 r_t / sqrt 3."""
        return 2.0 * self.tip_radius / sqrt(3.0)
