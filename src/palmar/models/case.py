"""One question put to palmar: a hand, an object, and everything between them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from math import degrees
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from palmar.geometry.finger_reach import finger_reach
from palmar.models.bed import Bed
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.contact import Contact
from palmar.models.hand import Hand
from palmar.models.objects import Object
from palmar.models.quantity import Coordinate, Point, Real, Unit, Value
from palmar.models.sensors import Sensors
from palmar.models.support import Support, SupportKind


class Start(Value):
    """The nominal start of the object in the hand frame, where a command needs one."""

    at: Annotated[Point, Unit.MILLIMETRE] = (0.0, 0.12)
    theta: Annotated[Real, Field(ge=-100.0, le=100.0), Unit.DEGREE] = 0.0
    velocity: Annotated[tuple[Coordinate, Coordinate], Unit.MILLIMETRE_PER_SECOND] = (0.0, 0.0)


class Range(Value):
    """A number known only within limits: its place as (section, field[, index, ...]), and the limits in SI."""

    place: tuple[str | int, ...]
    low: Real
    high: Real


class Case(Value):
    """Hand, object and circumstances. Numbers with a range hold its middle; ``corners`` runs over the extremes."""

    hand: Hand
    object: Object
    contact: Contact = Contact()
    support: Support = Support()
    start: Start = Start()
    sensors: Sensors = Sensors()
    behaviour: Behaviour = Behaviour()
    bed: Bed = Bed()
    ranges: tuple[Range, ...] = ()

    @model_validator(mode="after")
    def _sensors_on_the_hand(self) -> Self:
        self.sensors.stretches(self.hand)
        return self

    @model_validator(mode="after")
    def _torque_in_free_space(self) -> Self:
        if self.hand.finger_torque is not None and self.support.kind is SupportKind.TABLE:
            raise ValueError(
                'hand.finger_torque_N_m is for support.kind = "free": on a table fingers are slow, and strong enough'
            )
        return self

    @model_validator(mode="after")
    def _fingers_before_the_wall(self) -> Self:
        wall, hand = self.support.wall, self.hand
        if wall is not None:
            reach = finger_reach(hand.finger_links, self.open_joints, hand.half_thickness)
            if wall < reach * (1.0 - 1e-12):
                raise ValueError(
                    f"support.wall_mm must be at least {1e3 * reach:.6g}, as far as the open fingers reach"
                )
        return self

    @model_validator(mode="after")
    def _bend_within_limits(self) -> Self:
        limits = self.hand.joint_limits
        if limits is not None and len(limits) == 2 and self.behaviour.name is BehaviourName.CLOSE_COUPLED:
            low, high = limits[1]
            if not low <= self.behaviour.bend <= high:
                span = f"{degrees(low):.6g} to {degrees(high):.6g}"
                raise ValueError(f"behaviour.bend_deg must lie within the distal joint's limits, {span}")
        return self

    @property
    def open_joints(self) -> tuple[float, ...]:
        """Joint angles (rad) of each finger at the start: straight, but for coupled joints that begin bent."""
        rest = len(self.hand.finger_links) - 1
        if self.behaviour.name is BehaviourName.CLOSE_COUPLED and rest == 1:
            return self.hand.open, self.behaviour.bend
        return self.hand.open, *(0.0,) * rest

    def palm_ahead(self, right: Sequence[float], left: Sequence[float], told: float = 0.0) -> float:
        """Where along y (m) the palm is: where the arm is ``told`` to be, or as far back as a wall keeps the fingers.

        ``right``, ``left``: joint angles (rad). The wrist gives way to the wall (assumption 7 of section 2.1).
        """
        if self.support.wall is None:
            return told
        hand = self.hand
        reach = max(finger_reach(hand.finger_links, each, hand.half_thickness) for each in (right, left))
        return min(told, self.support.wall - reach)

    def corners(self) -> Iterator[Case]:
        """Every combination of the ranges' ends, as cases without ranges (just this case if it has none)."""
        for ends in product(*((each.low, each.high) for each in self.ranges)):
            yield self.settled(ends)

    def settled(self, values: Sequence[float]) -> Case:
        """The case without ranges, its numbers that have one set to these values (SI, in the order of ``ranges``)."""
        data: Any = self.model_dump(exclude={"ranges"})
        for each, value in zip(self.ranges, values, strict=True):
            data = _with(data, each.place, value)
        return Case.model_validate(data)


def _with(data: Any, place: tuple[str | int, ...], value: float) -> Any:
    """A copy of nested dicts and tuples with the number at ``place`` replaced."""
    if not place:
        return value
    head, *rest = place
    if isinstance(data, dict):
        return {**data, head: _with(data[head], tuple(rest), value)}
    return tuple(_with(item, tuple(rest), value) if index == head else item for index, item in enumerate(data))
