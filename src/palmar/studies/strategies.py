"""The closing strategies of a hand of two joints a finger, side by side: which catches from the largest region.

Straight closing; curl first, then close (sections 5.2.2 and 5.3.1), at the angle that theory gives (table: the preshape
without rolling; free: the one that the centrifugal force asks for) and at the angle of the largest region; both joints at
the ratio of rates of the largest region (section 5.3.1). Angles and ratios are searched on a grid and then in finer steps
about the best, by regions at a coarse spacing and at last at a finer one; an ``Effort`` says how.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import radians

from palmar.errors import NotCoveredError
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case
from palmar.models.jointed_motion import distal_limit
from palmar.models.objects import Disk
from palmar.models.support import SupportKind
from palmar.regions.build import build_region
from palmar.regions.captured import captured_count
from palmar.regions.jointed_closing import jointed_count
from palmar.regions.region import Region
from palmar.studies.preshape import Preshapes, preshapes


@dataclass(frozen=True)
class Effort:
    """How carefully to search; spacings in finger lengths, ``told`` that of the regions told (None: the default).

    First the grids ``angles`` (rad) and ``ratios`` at the spacing ``coarse``, their steps halved ``rounds`` times about the
    best; then at the spacing ``fine``, if there is one, the best, its neighbours at that step, and ``fine_rounds`` halvings.
    ``counted``: areas that are only compared are numbers of starts on a grid, not regions.
    """

    angles: tuple[float, ...]
    ratios: tuple[float, ...]
    coarse: float
    rounds: int
    fine: float | None = None
    fine_rounds: int = 0
    told: float | None = None
    counted: bool = False


CAREFUL = Effort(
    angles=tuple(radians(each) for each in range(10, 101, 10)),
    ratios=(0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0),
    coarse=1.0 / 32.0, rounds=2, fine=1.0 / 64.0, fine_rounds=1,
)  # fmt: skip
QUICK = Effort(
    angles=tuple(radians(each) for each in (20, 40, 60, 80)),
    ratios=(0.25, 0.5, 1.0, 2.0),
    coarse=1.0 / 20.0, rounds=2, told=1.0 / 32.0, counted=True,
)  # fmt: skip
"""For a report."""
Say = Callable[[str], None]


@dataclass(frozen=True)
class Strategy:
    """What it is called, what the hand does, the angle (rad) or ratio of that, and the region.

    Where the value was searched for: to which ``step`` (rad, or of the ratio), by regions at which ``spacing`` (m).
    """

    name: str
    behaviour: Behaviour
    value: float | None
    region: Region
    step: float | None = None
    spacing: float | None = None


def strategies(case: Case, say: Say = lambda words: None, effort: Effort | None = None) -> tuple[Strategy, ...]:
    """All that apply, straight closing first; ``effort`` is CAREFUL unless given. ``say`` hears what is being looked at.

    Raises NotCoveredError for other hands than of two links a finger, whose joints are moved one by one.
    """
    if len(case.hand.finger_links) != 2:
        raise NotCoveredError(f"strategies are for fingers of two links, not {len(case.hand.finger_links)}")
    if case.open_joints[1] != 0.0:
        raise NotCoveredError(
            "behaviour.bend_deg: strategies are for joints that move one by one, from straight fingers"
        )
    if not isinstance(case.object, Disk) or case.ranges or case.support.wall is not None:
        raise NotCoveredError("strategies are for disks, plain numbers, and a table without a wall")
    effort = CAREFUL if effort is None else effort
    search = _Search(case, say, effort)
    found = [search.told("straight", None, Behaviour())]
    for name, angle in _from_theory(case):
        if angle <= distal_limit(case.hand):
            found.append(search.told(name, angle, _curled(angle)))
    angles = [each for each in effort.angles if each < distal_limit(case.hand)]
    if angles:
        found.append(search.best("curl first", angles, _curled))
    found.append(search.best("coupled", list(effort.ratios), _coupled))
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
    effort: Effort

    def region(self, behaviour: Behaviour, spacing: float | None) -> Region:
        """At a spacing in finger lengths, None for the default."""
        tolerance = None if spacing is None else spacing * self.case.hand.finger_length
        return build_region(self.case.model_copy(update={"behaviour": behaviour}), tolerance=tolerance)

    def area(self, behaviour: Behaviour, spacing: float) -> float:
        """Only to be compared with others."""
        if not self.effort.counted:
            return self.region(behaviour, spacing).area
        case = self.case.model_copy(update={"behaviour": behaviour})
        counted = captured_count if case.support.kind is SupportKind.FREE else jointed_count
        return counted(case, spacing * case.hand.finger_length)

    def told(self, name: str, value: float | None, behaviour: Behaviour, step: float | None = None) -> Strategy:
        """Straight closing on a table, a closed form, has no spacing."""
        self.say(name)
        closed = behaviour.name is BehaviourName.CLOSE and self.case.support.kind is SupportKind.TABLE
        region = self.region(behaviour, None if closed else self.effort.told)
        searched = self.effort.coarse if self.effort.fine is None else self.effort.fine
        spacing = None if step is None else searched * self.case.hand.finger_length
        return Strategy(name, behaviour, value, region, step, spacing)

    def best(self, name: str, grid: list[float], make: Callable[[float], Behaviour]) -> Strategy:
        """The value of the largest region."""
        effort = self.effort
        value, step = self._climb(name, grid, make, effort.coarse, effort.rounds)
        if effort.fine is not None:
            near = [each for each in (value - step, value, value + step) if each > 0.0]
            near = [each for each in near if make(each).preshape <= distal_limit(self.case.hand)]
            value, step = self._climb(name, near, make, effort.fine, effort.fine_rounds)
        return self.told(name, value, make(value), step)

    def _climb(
        self, name: str, grid: Iterable[float], make: Callable[[float], Behaviour], spacing: float, rounds: int
    ) -> tuple[float, float]:
        """The value of the largest region on a grid, then between its neighbours; and how far the nearest of these are."""
        areas: dict[float, float] = {}

        def area(value: float) -> float:
            if value not in areas:
                self.say(f"{name}: {value:.4g}")
                areas[value] = self.area(make(value), spacing)
            return areas[value]

        best = max(grid, key=area)
        for _ in range(rounds):
            best = max((best, *(0.5 * (best + each) for each in _neighbours(best, areas))), key=area)
        return best, min((abs(best - each) for each in _neighbours(best, areas)), default=best)


def _neighbours(value: float, among: Iterable[float]) -> list[float]:
    """The next smaller and the next larger number, where there are such."""
    known = sorted(among)
    k = known.index(value)
    return [*known[max(k - 1, 0) : k], *known[k + 1 : k + 2]]
