"""The hand: a straight palm and two mirrored fingers of one or more links."""

from __future__ import annotations

from enum import Enum
from math import pi
from typing import Annotated, Self

from pydantic import Field, field_validator, model_validator

from palmar.models.quantity import LARGEST_LENGTH, Length, Real, Unit, Value

MOST_LINKS = 64


class Fingers(Enum):
    """How the two fingers pass one another."""

    CROSSING = "crossing"
    """They move in parallel planes and may cross (assumption 3 of section 2.1)."""
    COLLIDING = "colliding"
    """They move in one plane and stop where they meet: on the axis of symmetry, or past it if one has stalled before."""


Angle = Annotated[Real, Field(ge=-2.0 * pi, le=2.0 * pi)]


class Hand(Value):
    """A planar hand, symmetric about the y axis of its frame (x along the palm, y away from it), lengths in m.

    The palm is the segment (-D, 0)-(D, 0); the right finger's base joint is at (D, 0), its angle psi counts from
    the outward palm line (0 = fully open) towards closing; further joints count from straight.
    """

    palm_width: Annotated[Length, Unit.MILLIMETRE]
    """Full palm width 2D, between the two base joints."""
    finger_links: Annotated[tuple[Length, ...], Field(min_length=1, max_length=MOST_LINKS), Unit.MILLIMETRE]
    """Link lengths from proximal to distal; one entry is the 2-jointed hand."""
    finger_thickness: Annotated[Real, Field(ge=0.0, le=LARGEST_LENGTH), Unit.MILLIMETRE] = 0.0
    """Diameter of the capsules about the joint lines; 0 = lines. The palm stays a line."""
    fingers: Fingers = Fingers.CROSSING
    open: Annotated[Real, Field(ge=0.0, lt=pi), Unit.DEGREE] = 0.0
    """Base joint angle at the start."""
    finger_rate: Annotated[Real, Field(gt=0.0, le=1000.0), Unit.DEGREE_PER_SECOND] = Unit.DEGREE_PER_SECOND.to_si(30.0)
    finger_mass: Annotated[Real | None, Field(gt=0.0, le=1e6), Unit.KILOGRAM] = None
    """Mass of one finger; absent = heavy fingers that are not slowed."""
    finger_torque: Annotated[Real | None, Field(gt=0.0, le=1e6), Unit.NEWTON_METRE] = None
    """Largest torque of the motor that brings a finger back to its rate after an impact; absent = it is back at once."""
    drive_lag: Annotated[Real, Field(ge=0.0, le=100.0), Unit.SECOND] = 0.0
    """Time constant with which a motor's torque follows what it is told, where forces are simulated."""
    joint_limits: Annotated[tuple[tuple[Angle, Angle], ...] | None, Unit.DEGREE] = None
    """(lowest, highest) angle of each joint, base joint first; absent = no limits."""

    @property
    def half_palm(self) -> float:
        """D (m)."""
        return 0.5 * self.palm_width

    @property
    def finger_length(self) -> float:
        """L (m), of the straight finger."""
        return sum(self.finger_links)

    @property
    def half_thickness(self) -> float:
        """Distance h (m) of a finger's surface from its joint line."""
        return 0.5 * self.finger_thickness

    @property
    def base_limits(self) -> tuple[float, float]:
        """(lowest, highest) base joint angle (rad) within the half turn from open to folded."""
        if self.joint_limits is None:
            return 0.0, pi
        low, high = self.joint_limits[0]
        return max(low, 0.0), min(high, pi)

    @field_validator("joint_limits")
    @classmethod
    def _limits_in_order(cls, limits: tuple[tuple[float, float], ...] | None) -> tuple[tuple[float, float], ...] | None:
        for low, high in limits or ():
            if low >= high:
                raise ValueError("each pair must be [lowest, highest] with lowest below highest")
        return limits

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        if self.half_thickness >= self.finger_length:
            raise ValueError("finger_thickness_mm must be less than twice the finger's length")
        if self.finger_torque is not None and self.finger_mass is None:
            raise ValueError("finger_torque_N_m needs finger_mass_kg: a heavy finger is not slowed")
        if self.joint_limits is not None:
            if len(self.joint_limits) != len(self.finger_links):
                raise ValueError(
                    f"joint_limits_deg needs {len(self.finger_links)} pairs, one for each joint of a finger"
                )
            low, high = self.base_limits
            if not low < high or not low <= self.open <= high:
                raise ValueError("open_deg must lie within the base joint's limits, and these within 0 to 180")
            if low > 0.5 * pi:
                raise ValueError("joint_limits_deg must let the base joint open to 90 or less")
            if any(low > 0.0 or high < 0.0 for low, high in self.joint_limits[1:]):
                raise ValueError("joint_limits_deg of the joints beyond the base must contain 0, the straight finger")
        return self
