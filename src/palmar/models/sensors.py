"""Where a hand feels: binary contact sensors, each a stretch of a link or of the palm."""

from __future__ import annotations

import re
from enum import Enum
from typing import Annotated, Any, Self

from pydantic import BeforeValidator, Field, ValidationError, model_serializer, model_validator

from palmar.models.hand import Hand
from palmar.models.quantity import LARGEST_LENGTH, Real, Unit, Value

MOST_STRETCHES = 200
THIRDS, FINE = 3, 10
_TEXT = re.compile(r"(palm|(?:right|left)_\d{1,2})(?:\s+(\d+\.?\d*)\s*\.\.\s*(\d+\.?\d*))?")
_FORM = '"palm", "right_1", "left_2", or a part of one in mm from its near end: "right_2 20..107"'


class SensorLayout(Enum):
    """Presets."""

    NONE = "none"
    PALM = "palm"
    """The palm, one stretch."""
    TIPS = "tips"
    """The outer third of each distal link."""
    DISTRIBUTED = "distributed"
    """Each link in three equal stretches, the palm one stretch, no dead zones."""
    FULL = "full"
    """Each link and the palm in ten equal stretches, no dead zones: nearly as good as feeling where."""


class Stretch(Value):
    """One sensor: a stretch of ``body`` from ``begin`` to ``end`` (m), to its far end if None.

    ``body`` is "palm", counted from its left end, or "right_N" or "left_N", the N-th link from the palm. In a case file
    a text, with millimetres.
    """

    body: Annotated[str, Field(pattern=r"^(palm|(right|left)_\d{1,2})$")]
    begin: Annotated[Real, Field(ge=0.0, le=LARGEST_LENGTH)] = 0.0
    end: Annotated[Real, Field(gt=0.0, le=LARGEST_LENGTH)] | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, given: Any) -> Any:
        if not isinstance(given, str):
            return given
        match = _TEXT.fullmatch(given.strip())
        if match is None:
            raise ValueError(f"a stretch is {_FORM}")
        body, begin, end = match.groups()
        if begin is None:
            return {"body": body}
        return {"body": body, "begin": Unit.MILLIMETRE.to_si(float(begin)), "end": Unit.MILLIMETRE.to_si(float(end))}

    @model_serializer
    def _to_text(self) -> str:
        return self.name

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.end is not None and not self.begin < self.end:
            raise ValueError("the begin of a stretch comes before its end")
        return self

    @property
    def name(self) -> str:
        """As in a case file."""
        if self.begin == 0.0 and self.end is None:
            return self.body
        begin, end = (Unit.MILLIMETRE.from_si(each) for each in (self.begin, self.end or LARGEST_LENGTH))
        return f"{self.body} {begin:.10g}..{end:.10g}"


def _each_a_stretch(given: Any) -> Any:
    """A list's entries as stretches, so that a complaint names the entry and not the presets."""
    if not isinstance(given, list | tuple):
        return given
    try:
        return tuple(Stretch.model_validate(each) for each in given)
    except ValidationError as error:
        raise ValueError(error.errors()[0]["msg"].removeprefix("Value error, ")) from None


Layout = SensorLayout | Annotated[tuple[Stretch, ...], Field(min_length=1, max_length=MOST_STRETCHES)]


class Sensors(Value):
    """The layout, the displacement the object suffers before a bit is seen, and the pose error of the hand.

    ``displacement`` 0 stands for proximity. ``pose_error`` bounds the distance between commanded and true position.
    """

    layout: Annotated[Layout, BeforeValidator(_each_a_stretch)] = SensorLayout.NONE
    displacement: Annotated[Real, Field(ge=0.0, le=1.0), Unit.MILLIMETRE] = 0.0
    pose_error: Annotated[Real, Field(ge=0.0, le=1.0), Unit.MILLIMETRE] = 0.0

    def stretches(self, hand: Hand) -> tuple[Stretch, ...]:
        """Every sensor of this layout on a hand; raises ValueError for one that is not on it."""
        if isinstance(self.layout, SensorLayout):
            return _preset(self.layout, hand)
        lengths = _bodies(hand)
        for each in self.layout:
            if each.body not in lengths:
                raise ValueError(f"sensors.layout: the hand has no {each.body}, only {', '.join(lengths)}")
            if (each.end or 0.0) > lengths[each.body] * (1.0 + 1e-9):
                longest = Unit.MILLIMETRE.from_si(lengths[each.body])
                raise ValueError(f"sensors.layout: {each.name} ends beyond {each.body}, {longest:g} mm long")
        return self.layout


def _bodies(hand: Hand) -> dict[str, float]:
    """Length (m) of the palm and of every link."""
    links = {f"{side}_{k + 1}": length for side in ("right", "left") for k, length in enumerate(hand.finger_links)}
    return {"palm": hand.palm_width, **links}


def _preset(layout: SensorLayout, hand: Hand) -> tuple[Stretch, ...]:
    lengths = _bodies(hand)
    palm = (Stretch(body="palm"),)
    links = [name for name in lengths if name != "palm"]
    if layout is SensorLayout.NONE:
        return ()
    if layout is SensorLayout.PALM:
        return palm
    if layout is SensorLayout.TIPS:
        last = len(hand.finger_links)
        return tuple(_parts(f"{side}_{last}", lengths, THIRDS)[-1] for side in ("right", "left"))
    if layout is SensorLayout.DISTRIBUTED:
        return (*palm, *(each for name in links for each in _parts(name, lengths, THIRDS)))
    return tuple(each for name in lengths for each in _parts(name, lengths, FINE))


def _parts(body: str, lengths: dict[str, float], number: int) -> list[Stretch]:
    step = lengths[body] / number
    return [Stretch(body=body, begin=k * step, end=(k + 1) * step) for k in range(number)]
