"""Can a hand with jointed fingers hold it: the radii held by any bend of the fingers, and the verdict on a disk."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import degrees, hypot, nan, pi

import numpy as np

from palmar.mechanics.closure.chain import Chain, largest_hold
from palmar.mechanics.closure.closing_links import LimitedHand
from palmar.mechanics.closure.disk_2_2 import Radii, frictional_radii, structural_radii
from palmar.mechanics.closure.four_jointed_5_1 import CASES, four_jointed_radii
from palmar.mechanics.closure.four_jointed_cradle import folded_radius
from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
from palmar.mechanics.closure.limited import MOST_LINKS, LimitedRadii, limited_radii, stance_at
from palmar.mechanics.closure.stance import Stance, stance_of
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import Disk
from palmar.studies.closure import Change, RadiusRange, Slope, Verdict
from palmar.studies.jointed_changes import changes_and_slopes
from palmar.studies.jointed_reason import Held, Intervals, jointed_reason, within

Coupling = tuple[float, float, float]


@dataclass(frozen=True)
class JointedClosure:
    """What `palmar closure` reports of jointed fingers; radii in m, None where none is held.

    ``changes`` and ``slopes`` are known where ``cases`` are.

    ``cases`` are the intervals held without friction by each set of links, known for two line links a finger without
    joint limits; ``largest`` the stances that hold the largest disks where they were found by a search, ``intervals`` the
    radii held where these are no single interval, ``straight`` what is held with the fingers kept straight: each without
    friction and with it.
    """

    structural: RadiusRange | None
    frictional: RadiusRange | None
    object: Verdict
    cases: dict[str, Intervals]
    largest: tuple[Stance | None, Stance | None]
    intervals: tuple[Intervals, Intervals]
    straight: tuple[RadiusRange | None, RadiusRange | None]
    notes: tuple[str, ...]
    changes: tuple[Change, ...] = ()
    slopes: tuple[Slope, ...] = ()
    coupled: bool = False
    """Whether the joints of a finger are coupled, so that none is kept straight."""


def bends(case: Case) -> bool:
    """Whether the case is answered with bent fingers: more than one link, a disk, joint limits for a few links only."""
    links = len(case.hand.finger_links)
    return links > 1 and isinstance(case.object, Disk) and (case.hand.joint_limits is None or links <= MOST_LINKS)


def bends_in_closed_form(case: Case) -> bool:
    """Whether the verdict takes milliseconds: two links a finger that are not limited, plain numbers."""
    free = case.hand.joint_limits is None and coupling_of(case) is None
    return bends(case) and free and _closed_form(case.hand) and not case.ranges


def jointed_verdict(case: Case) -> JointedClosure:
    """The answer without what to change, for a case that ``bends_in_closed_form``."""
    return _corner(case)


def jointed_closure(case: Case) -> JointedClosure:
    """The answer for a case that ``bends``; with ranges in it, what is held at every combination of their ends."""
    corners = [_corner(each) for each in case.corners()]
    if len(corners) == 1:
        (only,) = corners
        if not only.cases:
            return only
        changes, slopes = changes_and_slopes(case, only.object)
        return replace(only, changes=changes, slopes=slopes)
    nominal = _corner(case.model_copy(update={"ranges": ()}))
    worst = min(corners, key=lambda each: (each.object.frictional, each.object.structural))
    held = (all(each.object.structural for each in corners), all(each.object.frictional for each in corners))
    return JointedClosure(
        _common([each.structural for each in corners]),
        _common([each.frictional for each in corners]),
        Verdict(*held, f"at the worst end of the ranges: {worst.object.reason}"),
        {},
        nominal.largest,
        ((), ()),
        (_common([each.straight[0] for each in corners]), _common([each.straight[1] for each in corners])),
        (*nominal.notes, "what is reported holds at every end of the given ranges"),
        coupled=nominal.coupled,
    )


def _corner(case: Case) -> JointedClosure:
    hand, alpha = case.hand, case.contact.friction_angle
    assert isinstance(case.object, Disk)
    if hand.joint_limits is not None or coupling_of(case) is not None:
        return _limited(case)
    cases, holds = _cases(hand), _holds(hand, alpha)
    largest = (_largest(hand, 0.0, holds[0]), _largest(hand, alpha, holds[1]))
    straight = _straight(hand, alpha)
    structural = _range(_smallest(hand, straight[0]), largest[0])
    frictional = _range(min(_smallest(hand, each) for each in straight), largest[1]) if alpha else structural
    radius = case.object.radius
    reason = jointed_reason(case, Held((structural, frictional), cases, holds))
    verdict = Verdict(within(structural, radius), within(frictional, radius), reason)
    ends = (_straight_range(straight[0]), _straight_range(straight[1]))
    return JointedClosure(structural, frictional, verdict, cases, holds, ((), ()), ends, tuple(_notes(hand, None)))


def _limited(case: Case) -> JointedClosure:
    """Within joint limits and a coupling, by the search of ``mechanics.closure.limited``."""
    hand, alpha, coupling = case.hand, case.contact.friction_angle, coupling_of(case)
    assert isinstance(case.object, Disk)
    radius = case.object.radius
    plain = limited_radii(limited_hand(hand, 0.0, coupling))
    rough = limited_radii(limited_hand(hand, alpha, coupling)) if alpha else plain
    ranges, holds = (_hull(plain), _hull(rough)), (plain.largest, rough.largest)
    held = [any(low <= radius <= high for low, high in each.intervals) for each in (plain, rough)]
    several = tuple(each.intervals if len(each.intervals) > 1 else () for each in (plain, rough))
    gap = [within(each, radius) and not so for each, so in zip(ranges, held, strict=True)]
    if gap[1]:
        reason = "between two ranges of radii that are held"
    else:
        reason = jointed_reason(case, Held((None if gap[0] else ranges[0], ranges[1]), {}, holds))
    straight = _straight(hand, alpha)
    ends = (_straight_range(straight[0]), _straight_range(straight[1])) if coupling is None else (None, None)
    return JointedClosure(
        *ranges,
        Verdict(held[0], held[1], reason),
        {},
        holds,
        (several[0], several[1]),
        ends,
        tuple(_notes(hand, coupling)),
        coupled=coupling is not None,
    )


def coupling_of(case: Case) -> Coupling | None:
    """Open base angle, open distal angle (rad) and ratio, where the behaviour couples the two joints of a finger."""
    if case.behaviour.name is not BehaviourName.CLOSE_COUPLED or len(case.hand.finger_links) != 2:
        return None
    base, bend = case.open_joints
    return base, bend, case.behaviour.ratio


def limited_hand(hand: Hand, friction_angle: float, coupling: Coupling | None = None) -> LimitedHand:
    """The hand as the search within joint limits takes it; without limits, joints turn by half a turn either way."""
    free = (hand.base_limits, *[(-pi, pi)] * (len(hand.finger_links) - 1))
    limits = free if hand.joint_limits is None else (hand.base_limits, *hand.joint_limits[1:])
    crossing = hand.fingers is Fingers.CROSSING
    return LimitedHand(
        hand.half_palm, hand.finger_links, limits, friction_angle, hand.half_thickness, crossing, coupling
    )


def _hull(radii: LimitedRadii) -> RadiusRange | None:
    return RadiusRange(radii.intervals[0][0], radii.intervals[-1][1]) if radii.intervals else None


def _closed_form(hand: Hand) -> bool:
    return len(hand.finger_links) == 2 and hand.finger_thickness == 0.0


def _holds(hand: Hand, alpha: float) -> tuple[Stance | None, Stance | None]:
    """The largest holds without and with friction, by optimisation where there is no closed form."""
    if _closed_form(hand):
        return None, None
    plain = largest_stance(hand, 0.0)
    return plain, (largest_stance(hand, alpha) if alpha else plain)


def largest_stance(hand: Hand, alpha: float, coupling: Coupling | None = None) -> Stance | None:
    """How the hand holds its largest disk at the friction angle alpha (rad), within its joint limits; None if none."""
    if hand.joint_limits is not None or coupling is not None:
        return limited_radii(limited_hand(hand, alpha, coupling)).largest
    chain = Chain(hand.half_palm, hand.finger_links, alpha, hand.half_thickness)
    hold = largest_hold(chain)
    return None if hold is None else stance_of(hold, chain)


def held_stances(case: Case, answer: JointedClosure, *, frictional: bool) -> tuple[Stance | None, Stance | None]:
    """How the hand stands around the case's disk and around the largest it holds; None where it holds none.

    The case's disk is not looked for with more than three links.
    """
    assert isinstance(case.object, Disk)
    alpha = case.contact.friction_angle if frictional else 0.0
    held = answer.object.frictional if frictional else answer.object.structural
    some = held and len(case.hand.finger_links) <= MOST_LINKS
    coupling = coupling_of(case)
    own = stance_at(limited_hand(case.hand, alpha, coupling), case.object.radius) if some else None
    return own, answer.largest[frictional] or largest_stance(case.hand, alpha, coupling)


def _largest(hand: Hand, alpha: float, hold: Stance | None) -> float:
    if _closed_form(hand):
        proximal, distal = hand.finger_links
        return float(largest_with_friction(hand.half_palm, proximal, distal, alpha))
    return hold.radius if hold else nan


def _straight(hand: Hand, alpha: float) -> tuple[Radii, Radii]:
    body = (hand.half_palm, hand.finger_length)
    crossing = hand.fingers is Fingers.CROSSING
    return (
        structural_radii(*body, hand.half_thickness, crossing=crossing, psi_limits=hand.base_limits),
        frictional_radii(*body, alpha, hand.half_thickness, crossing=crossing, psi_limits=hand.base_limits),
    )


def _smallest(hand: Hand, straight: Radii) -> float:
    """That of straight fingers, which reach farthest along the palm; fingers in one plane bend until their tips meet."""
    h, apart = hand.half_thickness, hypot(hand.half_palm - hand.half_thickness, hand.half_thickness)
    nearest = 2.0 * max(hand.finger_links) - hand.finger_length
    low = 0.0 if np.isnan(straight.min) else float(straight.min)
    if hand.fingers is Fingers.COLLIDING and nearest <= apart <= hand.finger_length:
        return min(0.25 * h, low)
    return low


def _cases(hand: Hand) -> dict[str, Intervals]:
    if len(hand.finger_links) != 2 or hand.finger_thickness > 0.0:
        return {}
    w, (p, q) = hand.half_palm, hand.finger_links
    radii = four_jointed_radii(w, p, q)
    found = {}
    for name in CASES:
        each: Radii = getattr(radii, name)
        intervals = [] if np.isnan(each.max) else [(float(each.min), float(each.max))]
        if name == "distal_proximal" and hand.fingers is Fingers.CROSSING:
            folded = float(folded_radius(w, p, q))
            intervals = [(0.0, folded)] * (not np.isnan(folded)) + intervals
        found[name] = tuple(intervals)
    return found


def _range(smallest: float, largest: float) -> RadiusRange | None:
    return RadiusRange(min(smallest, largest), largest) if largest > 0.0 else None


def _straight_range(radii: Radii) -> RadiusRange | None:
    return None if np.isnan(radii.max) else RadiusRange(float(radii.min), float(radii.max))


def _common(ranges: list[RadiusRange | None]) -> RadiusRange | None:
    known = [each for each in ranges if each is not None]
    low = max((each.radius_min for each in known), default=0.0)
    high = min((each.radius_max for each in known), default=-1.0)
    return RadiusRange(low, high) if len(known) == len(ranges) and low <= high else None


def _notes(hand: Hand, coupling: Coupling | None) -> list[str]:
    notes = [f"the {len(hand.finger_links)} links of a finger bend inwards as they need"]
    if coupling is not None:
        _, bend, ratio = coupling
        notes = [
            f"the distal joint is coupled: at {degrees(bend):.4g} deg in the open hand, it turns {ratio:.4g} times as fast"
            " as the base joint until the proximal link is held up, and then goes on alone; it is never behind that"
        ]
    if hand.finger_thickness > 0.0:
        notes.append(f"fingers are {1e3 * hand.finger_thickness:g} mm thick with round tips, the palm is a line")
    if hand.joint_limits is not None or coupling is not None:
        notes.append("joints keep within their limits; radii are found by a search, the largest to about 3 in 10 000")
    if hand.fingers is Fingers.COLLIDING:
        notes.append("fingers lie in one plane: the smallest radius is that between tips that meet")
    return notes
