"""The closing strategies of a hand of two joints a finger, side by side: which catches from the largest region.

Straight closing; curl first, then close (sections 5.2.2 and 5.3.1), at the angle that theory gives (table: the preshape
without rolling; free: the one that the centrifugal force asks for) and at the angle of the largest region; both joints at
the ratio of rates of the largest region (section 5.3.1). Angles and ratios are searched on a grid and then in finer steps
about the best, by regions at a coarse spacing; the areas told are those of regions at the default spacing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import radians

from palmar.errors import NotCoveredError
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case
from palmar.models.jointed_motion import distal_limit
from palmar.models.support import SupportKind
from palmar.regions.build import build_region
from palmar.regions.region import Region
from palmar.studies.preshape import Preshapes, preshapes

COARSE = 1.0 / 32.0
"""Spacing of the regions that are searched among, in finger lengths."""
ANGLES = tuple(radians(each) for each in range(10, 101, 10))
RATIOS = (0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0)
ROUNDS = 2
"""Halvings of the grid's step about the best."""
Say = Callable[[str], None]


@dataclass(frozen=True)
class Strategy:
    """What it is called, what the hand does, the angle (rad) or ratio of that, and the region."""

    name: str
    behaviour: Behaviour
    value: float | None
    region: Region


def strategies(case: Case, say: Say = lambda words: None) -> tuple[Strategy, ...]:
    """All that apply, straight closing first; raises NotCoveredError for other hands than of two links a finger.

    ``say`` hears what is being looked at.
    """
    if len(case.hand.finger_links) != 2:
        raise NotCoveredError(f"strategies are for fingers of two links, not {len(case.hand.finger_links)}")
    search = _Search(case, say)
    found = [search.told("straight", None, Behaviour())]
    for name, angle in _from_theory(case):
        if angle <= distal_limit(case.hand):
            found.append(search.told(name, angle, _curled(angle)))
    angles = [each for each in ANGLES if each < distal_limit(case.hand)]
    if angles:
        found.append(search.best("curl first", angles, _curled))
    found.append(search.best("coupled", list(RATIOS), _coupled))
    return tuple(found)


def winner(found: tuple[Strategy, ...]) -> Strategy:
    """The one with the largest region."""
    return max(found, key=lambda each: each.region.area)


def _from_theory(case: Case) -> list[tuple[str, float]]:
    """Names and angles (rad) that a formula gives."""
    known: Preshapes = preshapes(case)
    if case.support.kind is SupportKind.FREE:
        return [("centrifugal", known.centrifugal[0])] if known.centrifugal is not None else []
    return [("no rolling", known.tip.angle)] if known.tip is not None else []


def _curled(angle: float) -> Behaviour:
    return Behaviour(name=BehaviourName.CURL_AND_CLOSE, preshape=angle)


def _coupled(ratio: float) -> Behaviour:
    return Behaviour(name=BehaviourName.CLOSE_COUPLED, ratio=ratio)


@dataclass(frozen=True)
class _Search:
    case: Case
    say: Say

    def region(self, behaviour: Behaviour, tolerance: float | None) -> Region:
        return build_region(self.case.model_copy(update={"behaviour": behaviour}), tolerance=tolerance)

    def told(self, name: str, value: float | None, behaviour: Behaviour) -> Strategy:
        self.say(name)
        return Strategy(name, behaviour, value, self.region(behaviour, None))

    def best(self, name: str, grid: list[float], make: Callable[[float], Behaviour]) -> Strategy:
        """The value of the largest region: on the grid, then between its neighbours."""
        coarse = COARSE * self.case.hand.finger_length
        areas: dict[float, float] = {}

        def area(value: float) -> float:
            if value not in areas:
                self.say(f"{name}: {value:.4g}")
                areas[value] = self.region(make(value), coarse).area
            return areas[value]

        best = max(grid, key=area)
        for _ in range(ROUNDS):
            known = sorted(areas)
            k = known.index(best)
            between = [0.5 * (best + each) for each in (*known[max(k - 1, 0) : k], *known[k + 1 : k + 2])]
            best = max((best, *between), key=area)
        return self.told(name, best, make(best))
