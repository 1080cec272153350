"""Binary contact sensors: from where the object touches the hand to which bits are seen, with their faults."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import exp, hypot

import numpy as np

from palmar.models.hand import Hand
from palmar.models.sensors import Stretch
from palmar.worlds.planar.carriage import Touch

SLACK = 1e-9
"""A touch this near (m) to a stretch is on it."""

Place = tuple[float, float]


@dataclass(frozen=True)
class Sensing:
    """How sensors fall short.

    A bit is seen once the object has moved by ``displacement`` (m) since that stretch was touched; of the touches the
    share ``missed`` is never seen; an untouched sensor fires ``false_rate`` times a second, for one tick. ``seed`` is
    that of both draws.
    """

    displacement: float = 0.0
    missed: float = 0.0
    false_rate: float = 0.0
    seed: int = 0


@dataclass
class _Touched:
    """Where the object was when a stretch was touched, and whether this touch is one that is missed."""

    place: Place
    missed: bool
    seen: bool = False


@dataclass
class Bits:
    """The sensors of one hand, with the memory that displacement and missed touches need."""

    stretches: tuple[Stretch, ...]
    rows: tuple[tuple[int, float, float], ...]
    sensing: Sensing
    rng: np.random.Generator
    touched: dict[int, _Touched] = field(default_factory=dict)

    def read(self, touches: list[Touch], place: Place, seconds: float, displaces: bool) -> tuple[bool, ...]:
        """The bits ``seconds`` (s) after the last reading, the object being at ``place`` (m).

        Where touch does not move the object (``displaces`` false: it is massive, or gripped) it is felt at once.
        """
        bits = [self._bit(number, touches, place, displaces) for number in range(len(self.rows))]
        if self.sensing.false_rate > 0.0:
            chance = 1.0 - exp(-self.sensing.false_rate * seconds)
            drawn = self.rng.uniform(size=len(bits)) < chance
            bits = [bit or bool(false) for bit, false in zip(bits, drawn, strict=True)]
        return tuple(bits)

    def _bit(self, number: int, touches: list[Touch], place: Place, displaces: bool) -> bool:
        row, begin, end = self.rows[number]
        if not any(each.link == row and begin - SLACK <= each.along <= end + SLACK for each in touches):
            self.touched.pop(number, None)
            return False
        known = self.touched.get(number)
        if known is None:
            missed = self.sensing.missed > 0.0 and bool(self.rng.uniform() < self.sensing.missed)
            known = self.touched[number] = _Touched(place, missed)
        way = hypot(place[0] - known.place[0], place[1] - known.place[1])
        known.seen = known.seen or not displaces or way >= self.sensing.displacement
        return known.seen and not known.missed


def bits_of(hand: Hand, stretches: tuple[Stretch, ...], sensing: Sensing) -> Bits:
    """The sensors of a hand as rows (row of the links, begin, end) of the planar world."""
    count = len(hand.finger_links)
    rows = []
    for each in stretches:
        side, _, number = each.body.partition("_")
        row = 0 if side == "palm" else int(number) + (count if side == "left" else 0)
        length = hand.palm_width if row == 0 else hand.finger_links[int(number) - 1]
        rows.append((row, each.begin, length if each.end is None else each.end))
    return Bits(stretches, tuple(rows), sensing, np.random.default_rng(sensing.seed))
