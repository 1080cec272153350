"""Contact of finger or palm with the object."""

from __future__ import annotations

from math import atan
from typing import Annotated

from pydantic import Field

from palmar.models.quantity import Real, Unit, Value


class Contact(Value):
    """Coulomb friction coefficient (0 is valid), restitution and stiffness of finger and palm against the object."""

    friction: Annotated[Real, Field(ge=0.0, le=100.0)] = 0.7
    restitution: Annotated[Real, Field(ge=0.0, le=1.0)] = 1.0
    stiffness: Annotated[Real | None, Field(gt=0.0, le=1e9), Unit.NEWTON_PER_MILLIMETRE] = None
    """Of the whole contact, pad included; absent = rigid."""

    @property
    def friction_angle(self) -> float:
        """Half angle of the friction cone, alpha = arctan(mu) (rad)."""
        return atan(self.friction)
