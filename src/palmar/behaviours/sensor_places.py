"""Which part of the hand each sensor of a layout is on."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from palmar.models.motion import Observation
from palmar.models.sensors import Stretch

Numbers = tuple[int, ...]


@dataclass(frozen=True)
class SensorPlaces:
    """Numbers of the sensors on the palm, and on each link of the right and of the left finger, from the base out."""

    palm: Numbers
    right: tuple[Numbers, ...]
    left: tuple[Numbers, ...]

    def palm_feels(self, seen: Observation) -> bool:
        """Whether any sensor on the palm fires."""
        return _any(self.palm, seen)

    def link_feels(self, finger: int, link: int, seen: Observation) -> bool:
        """Whether any sensor on a link fires; finger 0 is the right one."""
        return _any((self.right, self.left)[finger][link], seen)

    def bodies_felt(self, seen: Observation) -> int:
        """On how many of palm, right and left finger a sensor fires."""
        fingers = [any(_any(link, seen) for link in each) for each in (self.right, self.left)]
        return int(self.palm_feels(seen)) + sum(fingers)


def places_of(stretches: Iterable[Stretch], links: int) -> SensorPlaces:
    """The places of a layout's stretches on a hand with so many links to a finger."""
    found: dict[str, list[int]] = {}
    for number, each in enumerate(stretches):
        found.setdefault(each.body, []).append(number)

    def on(side: str) -> tuple[Numbers, ...]:
        return tuple(tuple(found.get(f"{side}_{k + 1}", ())) for k in range(links))

    return SensorPlaces(tuple(found.get("palm", ())), on("right"), on("left"))


def _any(numbers: Numbers, seen: Observation) -> bool:
    return any(seen.bits[each] for each in numbers)
