"""From a brief to the smallest hand that meets it: the answer, what binds, how it was verified; or why there is none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import atan, tau

import numpy as np

from palmar.mechanics.closure.orientation_set import total_measure
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.design_brief import DesignBrief
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Hand
from palmar.studies.design.binding import binding
from palmar.studies.design.bounds import Bound, bound, least_reach, wrap_of
from palmar.studies.design.certificate import certified
from palmar.studies.design.circumstances import STRAIGHT
from palmar.studies.design.curled import LINKS, Curled, curling, may_curl
from palmar.studies.design.search import FIRST_GROWTH, MOST_GROWTH, ROUGHLY, WITHIN, Straight, smallest
from palmar.studies.design.tolerance import Place, is_exact, tolerance
from palmar.studies.design.verify import Verification, orientations_held, verify

CASES = 100_000
ROUNDS = 5
MORE = 0.01
"""Share added to the error in a search after one whose hand did not keep its promise."""
FINEST = 4
"""That search also samples twice as densely, up to so many times."""
LARGEST = 64.0
"""Sizes looked at, in that of the bound."""


@dataclass(frozen=True)
class Option:
    """The smallest hand with so many links a finger, or why there is none, and whether that is proven."""

    links: int
    hand: Hand | None
    place: Place | None = None
    does: Behaviour = STRAIGHT
    """How the hand closes, where it has to."""
    least: float | None = None
    """No hand of so many links is shorter (m), by the closed forms; None where they say nothing."""
    because: str | None = None
    proven: bool = False

    @property
    def size(self) -> float | None:
        """Palm and both fingers (m)."""
        return None if self.hand is None else size_of(self.hand)


@dataclass(frozen=True)
class Design:
    """The answer: the smallest hand over the numbers of links allowed, the fewest links first where hands tie.

    ``error`` (m) is what it tolerates about ``place`` (m, hand frame), None where only the hold counts; ``front`` pairs of
    size and tolerated error (m).
    """

    brief: DesignBrief
    options: tuple[Option, ...]
    chosen: Option | None
    error: float | None = None
    binds: tuple[str, ...] = ()
    guarantee: Guarantee | None = None
    verification: Verification | None = None
    front: tuple[tuple[float, float], ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def fewest_links(self) -> int | None:
        """The least number of links a finger with which the brief can be met; None with none."""
        return min((each.links for each in self.options if each.hand is not None), default=None)

    @property
    def least(self) -> float | None:
        """No hand of any of the numbers of links allowed is shorter (m); None where the closed forms do not say."""
        known = [each.least for each in self.options if each.hand is not None or not each.proven]
        return None if None in known else min((each for each in known if each is not None), default=None)

    @property
    def because(self) -> str | None:
        """Why there is no hand, told of the most links, with which it would be the smallest."""
        return None if self.chosen is not None else self.options[-1].because

    @property
    def proven(self) -> bool:
        """Whether that there is no hand is proven, for every number of links."""
        return self.chosen is None and all(each.proven for each in self.options)


def size_of(hand: Hand) -> float:
    """Palm and both fingers (m)."""
    return 2.0 * (hand.half_palm + hand.finger_length)


def design(brief: DesignBrief, cases: int = CASES, seed: int = 0, front: int = 0) -> Design:
    """The smallest hand that meets the brief, tried in ``cases`` random cases; ``front``: how many points of the front."""
    *_, answer = stages(brief, cases, seed)
    if answer.chosen is None or front == 0:
        return answer
    points = ((each.size, error) for each, error in front_hands(brief, front))
    return replace(answer, front=tuple((size, error) for size, error in points if size is not None))


def stages(brief: DesignBrief, cases: int = CASES, seed: int = 0) -> Iterator[Design]:
    """The answer without its front as it grows: a hand that was found, the same tried; the last one counts.

    Where a trial loses an object, the search begins anew for a larger error.
    """
    asked, extra = brief, 0.0
    answer = Design(brief, (), None)
    for round_ in range(ROUNDS):
        options = _options(asked, {each.links: each.size or 0.0 for each in answer.options})
        built = [each for each in options if each.hand is not None]
        if not built:
            yield Design(brief, options, None)
            return
        chosen = min(built, key=lambda each: (round(1e6 * (each.size or 0.0)), each.links))
        assert chosen.hand is not None
        error, guarantee = certified(brief, chosen.hand, chosen.place, chosen.does)
        binds = binding(asked, chosen.hand, chosen.does)
        answer = Design(brief, options, chosen, error, binds, guarantee, notes=_notes(brief, chosen, extra))
        yield answer
        tried = verify(brief, chosen.hand, chosen.place, cases, seed, chosen.does)
        answer = replace(answer, verification=tried)
        yield _without_guarantee(answer, tried.violations) if tried.violations and round_ == ROUNDS - 1 else answer
        short = error is not None and error < brief.targets.error * (1.0 - 1e-6)
        if tried.violations == 0 and not short:
            return
        extra += MORE
        asked = with_error(brief, brief.targets.error * (1.0 + extra))
        asked = asked.model_copy(update={"fineness": min(2 << round_, FINEST)})


def _without_guarantee(answer: Design, lost: int) -> Design:
    note = f"the last of {ROUNDS} searches still lost {lost} cases, so nothing is guaranteed"
    return replace(answer, guarantee=None, notes=(*answer.notes, note))


def _options(brief: DesignBrief, longer: dict[int, float] | None = None) -> tuple[Option, ...]:
    """For every number of links that is allowed; where the hand closes straight, one search serves them all.

    ``longer``: sizes (m) by links that are known not to be enough.
    """
    longer = longer or {}
    allowed = sorted(set(brief.limits.links))
    if brief.error == 0.0 and brief.targets.radii is not None:
        return tuple(_by_bound(brief, links) for links in allowed)
    one = _straight(brief, longer.get(1, 0.0))
    found = [_split(brief, one, links) for links in allowed]
    return tuple(_curled(brief, each, longer.get(LINKS, 0.0)) if _curls(brief, each.links) else each for each in found)


def _curls(brief: DesignBrief, links: int) -> bool:
    return links == LINKS and may_curl(brief)


def _split(brief: DesignBrief, one: Option, links: int) -> Option:
    """The straight finger in equal links, or why there is none; what is proven of one link need not be of more."""
    if links == 1:
        return one
    known = bound(brief, links) if brief.targets.radii is not None else Bound(proven=False)
    if one.hand is None:
        ruled_out = known.because is not None and known.proven
        return replace(one, links=links, because=known.because if ruled_out else one.because, proven=ruled_out)
    lengths = (one.hand.finger_length / links,) * links
    hand = one.hand.model_copy(update={"finger_links": lengths})
    return replace(one, links=links, hand=hand, least=known.least or None)


def _by_bound(brief: DesignBrief, links: int) -> Option:
    """Where only the hold counts the closed form's bound is attained."""
    found = bound(brief, links)
    if found.because is not None:
        return Option(links, None, because=found.because, proven=found.proven)
    lengths = wrap_of(brief, links).links_of(found.half_palm, found.finger)
    return Option(links, brief.limits.hand(found.half_palm, lengths), least=found.least, proven=True)


def _straight(brief: DesignBrief, longer: float) -> Option:
    """The smallest hand whose fingers close straight, from the bound upwards, and from a size (m) that is not enough."""
    low = bound(brief, 1) if brief.targets.radii is not None else Bound(0.25 * _extent(brief), 0.0, None, False)
    if low.because is not None:
        return Option(1, None, because=low.because, proven=low.proven)
    high = min(brief.limits.hand_length, LARGEST * low.size)
    fine, felt = is_exact(brief), brief.targets.sensors is not None
    search = Straight(lambda d, length, beaten: slack(brief, d, (length,), STRAIGHT, beaten), brief.limits, fine, felt)
    found = smallest(
        search.best, max(low.size, longer), high, WITHIN if fine else ROUGHLY, MOST_GROWTH if felt else FIRST_GROWTH
    )
    if found is None:
        slackest, dimensions = search.best(high)
        return Option(1, None, because=_not_found(brief, high, slackest, *dimensions), least=low.least or None)
    hand = brief.limits.hand(found[0], (found[1],))
    place = tolerance(brief, hand).place if brief.error > 0.0 else None
    return Option(1, hand, place, least=low.least or None, proven=True)


def _curled(brief: DesignBrief, straight: Option, longer: float) -> Option:
    """The smallest hand of two links that curls before it closes, or the straight one where none is smaller."""
    low = bound(brief, LINKS)
    if low.because is not None:
        return straight
    high = (
        min(brief.limits.hand_length, LARGEST * low.size) if straight.size is None else straight.size * (1.0 - ROUGHLY)
    )
    search = Curled(
        lambda d, proximal, distal, angle, beaten: slack(brief, d, (proximal, distal), curling(angle), beaten),
        brief.limits,
        least_reach(brief),
    )
    least = max(low.least, longer)
    found = smallest(search.best, least, high, ROUGHLY, FIRST_GROWTH) if least < high else None
    if found is None:
        return straight
    hand, does = brief.limits.hand(found[0], (found[1], found[2])), curling(found[3])
    return Option(LINKS, hand, tolerance(brief, hand, does).place, does, low.least or None, proven=True)


def slack(
    brief: DesignBrief, half_palm: float, links: tuple[float, ...], does: Behaviour = STRAIGHT, beaten: float = -np.inf
) -> float:
    """Not negative where the hand (m) does: tolerated error less that asked for (m), or share of orientations - 1.

    Some number no more than ``beaten`` where the slack is no more than that.
    """
    hand = brief.limits.hand(half_palm, links) if 2.0 * min(links) > brief.limits.finger_thickness else None
    if hand is None:
        return -1.0
    if brief.error == 0.0:
        vertices = (1.0 + brief.limits.margin) * np.array(brief.targets.vertices)
        held = orientations_held(vertices, hand, atan(brief.least_friction.friction))
        return total_measure(held) / tau - 1.0 + 1e-6
    return tolerance(brief, hand, does, max(beaten + brief.error, 0.0)).radius - brief.error


def _not_found(brief: DesignBrief, size: float, best: float, half_palm: float, finger: float) -> str:
    if brief.error == 0.0:
        return f"no hand of {1e3 * size:.5g} mm within the limits was found that holds it at every orientation"
    if brief.targets.sensors is not None:
        most = brief.targets.approaches_max
        return f"no hand of {1e3 * size:.5g} mm was found with a plan of at most {most} approaches for that error"
    if best == -np.inf:
        return f"no palm and finger within their limits make a hand of at most {1e3 * size:.5g} mm"
    found = max(best + brief.error, 0.0)
    return (
        f"the best hand of {1e3 * size:.5g} mm found, palm {2e3 * half_palm:.4g} and fingers {1e3 * finger:.4g} mm,"
        f" tolerates {1e3 * found:.4g} of the {1e3 * brief.error:.4g} mm"
    )


def front_hands(brief: DesignBrief, points: int) -> Iterator[tuple[Option, float]]:
    """Smallest hands for errors (m) from 0 to half as much again as asked for, those without a hand left out.

    Found by the search alone: none of them is tried.
    """
    if brief.targets.radii is None and brief.error == 0.0:
        return
    for error in map(float, np.linspace(0.0, largest_error(brief), points)):
        if error == 0.0 and brief.targets.radii is None:
            continue
        built = [each for each in _options(with_error(brief, error)) if each.size is not None]
        if built:
            yield min(built, key=lambda each: each.size or 0.0), error


def largest_error(brief: DesignBrief) -> float:
    """Where the front ends (m): half as much again as asked for, or the largest radius where none is."""
    return 1.5 * brief.targets.error or brief.held[1]


def with_error(brief: DesignBrief, error: float) -> DesignBrief:
    """The brief for another placement error (m)."""
    return brief.model_copy(update={"targets": brief.targets.model_copy(update={"error": error})})


def _extent(brief: DesignBrief) -> float:
    return float(np.ptp(np.array(brief.targets.vertices), axis=0).min())


def _notes(brief: DesignBrief, chosen: Option, extra: float) -> tuple[str, ...]:
    notes = []
    if brief.error > 0.0 and max(brief.limits.links) > 1 and chosen.does.name is BehaviourName.CLOSE:
        notes.append("fingers close straight, so more links than one do not shorten the hand")
    if extra > 0.0:
        notes.append(
            f"searched for an error larger by {100.0 * extra:.3g} % and more densely, for a smaller hand did not keep its"
            " promise"
        )
    return tuple(notes)
