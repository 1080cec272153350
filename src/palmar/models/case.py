"""One question put to palmar: a hand, an object, and everything between them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from palmar.models.behaviour import Behaviour
from palmar.models.contact import Contact
from palmar.models.hand import Hand
from palmar.models.objects import Object
from palmar.models.quantity import Coordinate, Point, Real, Unit, Value
from palmar.models.sensors import Sensors
from palmar.models.support import Support


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
    ranges: tuple[Range, ...] = ()

    @model_validator(mode="after")
    def _sensors_on_the_hand(self) -> Self:
        self.sensors.stretches(self.hand)
        return self

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
