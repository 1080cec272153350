"""Which advance of the arm, before and while closing, makes the region large enough with the least travel or time.

A motion straight ahead has two numbers, the travel T and the share s of it that the arm goes before the fingers move; the
ratio of the arm's speed to that of the fingers follows from them. With an arm of speed V and fingers that need the time c
to close, and that go slower where the arm could not follow, it takes s T / V + max(c, (1 - s) T / V).

The least travel is bisected for each share looked at, and the share itself is searched: both ends, then ever finer steps
about the best so far. A share that does not do with clearly less than the best costs one region.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import Circle, inscribed_circle
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.support import SupportKind
from palmar.regions.arm_moves import region_of_motion
from palmar.regions.moving import ArmMotion, moving_sets
from palmar.regions.simulated import object_reach

SPACING = 1.0 / 64.0
"""Of simulated starts, in finger lengths."""
RESOLUTION, FARTHEST = 1.0 / 512.0, 4.0
"""Of the least travel, and the most travel looked at, in finger lengths."""
STEPS = (0.25, 0.125, 0.0625)
"""Of the share, one round each."""
ALL_FIRST, ALL_WHILE = 1.0, 0.0
"""Shares of the source's two ways: move and grab, and move while closing."""

Say = Callable[[str], None]


@dataclass(frozen=True)
class Travel:
    """The least travel (m) found with this share before closing, its time (s), and the largest circle of its region.

    ``guarantee``: of the region.
    """

    share: float
    travel: float
    seconds: float
    motion: ArmMotion
    room: Circle
    guarantee: Guarantee


@dataclass(frozen=True)
class ArmMotions:
    """Of the source's two ways; with the least travel; in the least time. None where nothing does within ``FARTHEST``."""

    first: Travel | None
    closing: Travel | None
    shortest: Travel | None
    quickest: Travel | None


def room_of(case: Case, motion: ArmMotion) -> tuple[Circle, Guarantee] | None:
    """The largest circle (m) in the region of a motion, and what vouches for the region; None if nothing is caught.

    A closed form where there is one; else simulated starts, also where a certified region could be had in longer time.
    """
    if motion.per_radian == 0.0:
        region = region_of_motion(case, motion, Closure.FRICTIONAL, SPACING * case.hand.finger_length)
        centre, guarantee = region.centre, region.guarantee
    else:
        centre, guarantee = moving_sets(case, motion, SPACING * case.hand.finger_length).centre, Guarantee.SAMPLED
    return None if centre.is_empty else (inscribed_circle(centre, 1e-3 * case.hand.finger_length), guarantee)


def best_arm_motions(case: Case, radius: float, say: Say = lambda words: None) -> ArmMotions:
    """The motions with the least travel and time with which any place known within ``radius`` (m) is caught.

    More travel is taken to allow no less error, as it does in every case looked at; the answer itself is simulated.
    ``say`` hears what is being looked at. Raises NotCoveredError without a table, or with ranges.
    """
    if case.support.kind is not SupportKind.TABLE or case.ranges:
        raise NotCoveredError("arm motions are for objects on a table, and plain numbers")
    if radius > _reached(case):
        return ArmMotions(None, None, None, None)
    search = _Search(case, radius, say)
    first, closing = search.least(ALL_FIRST), search.least(ALL_WHILE)
    ends = [each for each in (first, closing) if each is not None]
    shortest = search.best(ends, lambda each: each.travel, lambda share, travel: travel)
    quickest = search.best(ends, lambda each: each.seconds, search.travel_within)
    return ArmMotions(first, closing, shortest, quickest)


def _reached(case: Case) -> float:
    """Half the width (m) of what a hand going straight ahead can touch: no region is wider."""
    hand = case.hand
    return hand.half_palm + hand.finger_length + hand.half_thickness + object_reach(case.object)


def _about(share: float, step: float) -> list[float]:
    """Shares a step and two steps off, the nearer first."""
    near = (share - step, share + step, share - 2.0 * step, share + 2.0 * step)
    return [each for each in near if ALL_WHILE < each < ALL_FIRST]


@dataclass(frozen=True)
class _Search:
    case: Case
    radius: float
    say: Say

    @property
    def resolution(self) -> float:
        return RESOLUTION * self.case.hand.finger_length

    @property
    def sweep(self) -> float:
        """Angle (rad) that the fingers turn by."""
        motion = straight_motion(self.case.hand)
        return motion.last - motion.first

    def seconds(self, share: float, travel: float) -> float:
        """Time of a motion; V from the behaviour's speed, c from the fingers' rate."""
        closing, moving = self.sweep / self.case.hand.finger_rate, travel / self.case.behaviour.speed
        return share * moving + max(closing, (1.0 - share) * moving)

    def travel_within(self, share: float, seconds: float) -> float:
        """The most travel (m) of a share for which this time is enough."""
        speed, spare = self.case.behaviour.speed, seconds - self.sweep / self.case.hand.finger_rate
        return min(speed * spare / share, speed * seconds) if share > 0.0 else speed * seconds

    def tried(self, share: float, travel: float) -> Travel | None:
        """The motion with this travel (m), if its region allows the error."""
        arm = ArmMotion(share * travel, (1.0 - share) * travel / self.sweep)
        found = room_of(self.case, arm)
        if found is None or found[0].radius < self.radius:
            return None
        return Travel(share, travel, self.seconds(share, travel), arm, *found)

    def least(self, share: float) -> Travel | None:
        """The least travel of a share; None within ``FARTHEST``."""
        self.say(_looking_at(share))
        length = self.case.hand.finger_length
        found = self.tried(share, 0.0)
        if found is not None:
            return found
        low, high = 0.0, 0.25 * length
        while (found := self.tried(share, high)) is None:
            low, high = high, 2.0 * high
            if high > FARTHEST * length:
                return None
        return self._between(low, found)

    def best(
        self, ends: list[Travel], cost: Callable[[Travel], float], worth: Callable[[float, float], float]
    ) -> Travel | None:
        """Of ``ends`` and of shares between: the least cost; ``worth`` is the travel that a share has for a cost."""
        best = min(ends, key=cost, default=None)
        centre = 0.5 if best is None else best.share
        for step in STEPS if best is None or best.travel > 0.0 else ():
            for share in _about(centre, step):
                better = self.least(share) if best is None else self.below(share, worth(share, cost(best)))
                if better is not None:
                    best, centre = better, share
        return best

    def below(self, share: float, travel: float) -> Travel | None:
        """The least travel of a share that does with less than ``travel`` by twice the resolution; else None."""
        self.say(_looking_at(share))
        enough = travel - 2.0 * self.resolution
        found = self.tried(share, enough) if enough > 0.0 else None
        return None if found is None else self._between(0.0, found)

    def _between(self, low: float, found: Travel) -> Travel:
        """Bisection between a travel that does not do and one that does."""
        while found.travel - low > self.resolution:
            middle = 0.5 * (low + found.travel)
            better = self.tried(found.share, middle)
            low, found = (middle, found) if better is None else (low, better)
        return found


def _looking_at(share: float) -> str:
    return f"{100.0 * share:.4g} % of the travel before closing"
