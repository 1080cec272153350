"""What the processes of the cell send each other, as JSON: whatever does not fit these models is refused on receipt.

Times are in seconds of the trial; ``epoch_s`` says where its zero lies on the machine's monotonic clock, which all
processes read. None: the trial has not begun.
"""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, NonNegativeInt, model_validator

from palmar.models.cell_messages import FARTHEST, CellOrder, CellSeen, Sighting

LARGEST = 16_384
"""No message is longer (bytes)."""
CURL_MOST, RATE_MOST, GRIP_MOST = 3.0, 20.0, 5.0
"""No order asks for more: rad, rad/s, N m."""


class Message(BaseModel):
    """Of the cell."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True)


class Light(Message):
    """From the plant, for the eyes of vision only: where everything is (MuJoCo's qpos)."""

    stamp_s: float
    epoch_s: float | None
    qpos: Annotated[tuple[float, ...], Field(min_length=22, max_length=64)]


class Frame(Message):
    """From vision: a sighting; frames are numbered, also those in which nothing was seen or that were dropped."""

    number: NonNegativeInt
    sighting: Sighting

    @model_validator(mode="after")
    def _is_plausible(self) -> Self:
        seen = self.sighting
        if max(abs(seen.x_m), abs(seen.y_m)) > FARTHEST or not 0.0 < seen.radius_m < 1.0 or seen.sigma_m < 0.0:
            raise ValueError("a sighting lies within the cell, its radius is between 0 and 1 m")
        return self


class Request(Message):
    """From the arm's controller in the plant, every 28 ms: what the sensors say; vision comes by its own way."""

    number: NonNegativeInt
    seen: CellSeen


class Sightings(Message):
    """Counts of the controller: frames that arrived, those too old to be used, numbers that never came, and refused."""

    received: NonNegativeInt = 0
    stale: NonNegativeInt = 0
    dropped: NonNegativeInt = 0
    malformed: NonNegativeInt = 0


class Reply(Message):
    """From the behaviours, to the request of that number."""

    number: NonNegativeInt
    order: CellOrder
    approaches: NonNegativeInt
    sightings: Sightings

    @model_validator(mode="after")
    def _is_moderate(self) -> Self:
        hand = self.order.hand
        most = max(abs(each) for each in hand.target)
        slow, fast = min(hand.rate, hand.soft_rate), max(hand.rate, hand.soft_rate)
        if most > CURL_MOST or slow <= 0.0 or fast > RATE_MOST or not 0.0 <= hand.grip <= GRIP_MOST:
            raise ValueError("an order's curls, rate or grip are beyond what the hand can do")
        return self


class Ready(Message):
    """From vision and the controller until the trial begins: whoever says so hears the others."""

    who: Literal["vision", "controller"]
