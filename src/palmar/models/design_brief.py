"""What a hand is to be designed for: targets that it must meet, and limits within which it may be built."""

from __future__ import annotations

from math import atan
from typing import Annotated, Self

from pydantic import Field, field_validator, model_validator

from palmar.geometry.polygon import checked_convex
from palmar.models.contact import Contact
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import MOST_VERTICES
from palmar.models.quantity import SMALLEST_LENGTH, Length, Point, Real, Unit, Value
from palmar.models.sensors import Sensors
from palmar.models.support import SupportKind

MOST_LINKS = 6
"""Links a finger that a brief may ask about."""
LONGEST = 1000.0
"""Length (m) that stands for no limit."""
Friction = Annotated[Real, Field(ge=0.0, le=100.0)]
Share = Annotated[Real, Field(ge=0.0, le=1.0)]


class Targets(Value):
    """What is to be held, and from where; a pair is (lowest, highest), and every value between them counts."""

    radii: Annotated[tuple[Length, Length] | None, Unit.MILLIMETRE] = None
    """Radii (m) of the disks; absent for a polygon."""
    vertices: Annotated[tuple[Point, ...] | None, Field(min_length=3, max_length=MOST_VERTICES), Unit.MILLIMETRE] = None
    """Vertices (m) of a convex polygon that may lie at any orientation; absent for disks."""
    friction: tuple[Friction, Friction] = (0.0, 0.0)
    """Of the contacts; 0 asks for what holds without friction."""
    restitution: tuple[Share, Share] = (0.0, 1.0)
    """Matters in free space only."""
    error: Annotated[Real, Field(ge=0.0, le=100.0), Unit.MILLIMETRE] = 0.0
    """Placement error (m) to tolerate: the centre is anywhere in a circle of this radius. 0: only the hold counts."""
    support: SupportKind = SupportKind.TABLE
    sensors: Sensors | None = None
    """With sensors the hand may approach by touch before it closes."""
    approaches_max: Annotated[int, Field(ge=1, le=6)] = 1

    @field_validator("radii", "friction", "restitution")
    @classmethod
    def _in_order(cls, pair: tuple[float, float] | None) -> tuple[float, float] | None:
        return _ordered(pair)

    @field_validator("vertices")
    @classmethod
    def _convex(cls, vertices: tuple[Point, ...] | None) -> tuple[Point, ...] | None:
        return None if vertices is None else checked_convex(vertices)

    @model_validator(mode="after")
    def _one_kind_of_object(self) -> Self:
        if (self.radii is None) == (self.vertices is None):
            raise ValueError("give exactly one of radii_mm and vertices_mm")
        if self.vertices is not None and self.support is SupportKind.FREE:
            raise ValueError('vertices_mm is for support = "table": free objects are disks')
        if self.sensors is not None:
            if self.radii is None or self.support is SupportKind.FREE:
                raise ValueError('sensors take radii_mm and support = "table": plans by touch are for disks that stay')
            if self.error == 0.0:
                raise ValueError("sensors need an error_mm above 0: there is nothing to find")
        return self

    @property
    def friction_angle(self) -> float:
        """Half angle (rad) of the narrowest friction cone, which decides what is held."""
        return atan(self.friction[0])


class Limits(Value):
    """Within which the hand may be built; a pair is (least, greatest)."""

    palm_width: Annotated[tuple[Real, Real], Unit.MILLIMETRE] = (0.0, LONGEST)
    finger_length: Annotated[tuple[Real, Real], Unit.MILLIMETRE] = (0.0, LONGEST)
    """Of the straight finger (m)."""
    hand_length: Annotated[Length, Unit.MILLIMETRE] = LONGEST
    """The most that palm and both fingers may measure together (m)."""
    links: Annotated[tuple[Annotated[int, Field(ge=1, le=MOST_LINKS)], ...], Field(min_length=1, max_length=MOST_LINKS)] = (
        1, 2, 3,
    )  # fmt: skip
    """Numbers of links a finger that are allowed."""
    curl: bool = True
    """Whether fingers of two links may curl before they close."""
    finger_thickness: Annotated[Real, Field(ge=0.0, le=1000.0), Unit.MILLIMETRE] = 0.0
    fingers: Fingers = Fingers.CROSSING
    margin: Annotated[Real, Field(ge=0.0, le=0.5)] = 0.01
    """Share by which radii, error and friction are to be met with room to spare."""

    @field_validator("palm_width", "finger_length")
    @classmethod
    def _in_order(cls, pair: tuple[float, float]) -> tuple[float, float]:
        found = _ordered(pair)
        if pair[0] < 0.0:
            raise ValueError("must be at least 0 mm")
        assert found is not None
        return found

    @property
    def half_thickness(self) -> float:
        """Distance (m) of a finger's surface from its joint line."""
        return 0.5 * self.finger_thickness

    def hand(self, half_palm: float, links: tuple[float, ...]) -> Hand:
        """The hand of half palm width (m) and links (m) that these limits leave no other choice for."""
        return Hand(
            palm_width=max(2.0 * half_palm, SMALLEST_LENGTH),
            finger_links=tuple(max(each, SMALLEST_LENGTH) for each in links),
            finger_thickness=self.finger_thickness,
            fingers=self.fingers,
        )


class DesignBrief(Value):
    """A whole brief."""

    targets: Targets
    limits: Limits = Limits()
    fineness: Annotated[int, Field(ge=1)] = 1
    """How many times as densely as usual the search samples orientations, radii, restitutions and directions."""

    @property
    def held(self) -> tuple[float, float]:
        """Radii (m) to hold, the margin included; raises for polygons."""
        assert self.targets.radii is not None
        low, high = self.targets.radii
        return low * (1.0 - self.limits.margin), high * (1.0 + self.limits.margin)

    @property
    def error(self) -> float:
        """Placement error (m) to tolerate, the margin included."""
        return self.targets.error * (1.0 + self.limits.margin)

    @property
    def least_friction(self) -> Contact:
        """The contact of the least friction, less the margin."""
        return Contact(friction=self.targets.friction[0] * (1.0 - self.limits.margin))


def _ordered(pair: tuple[float, float] | None) -> tuple[float, float] | None:
    if pair is not None and pair[0] > pair[1]:
        raise ValueError("the lower end comes first")
    return pair
