"""Can a hand with jointed fingers hold it: the radii held by any bend of the fingers, and the verdict on a disk."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, nan, pi, tan

import numpy as np

from palmar.mechanics.closure.chain import Chain, largest_hold
from palmar.mechanics.closure.closing_links import LimitedHand
from palmar.mechanics.closure.disk_2_2 import Radii, frictional_radii, structural_radii
from palmar.mechanics.closure.four_jointed_5_1 import CASES, four_jointed_radii
from palmar.mechanics.closure.four_jointed_cradle import folded_radius
from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
from palmar.mechanics.closure.limited import MOST_LINKS, LimitedRadii, limited_radii, stance_at
from palmar.mechanics.closure.stance import Stance, stance_of
from palmar.models.case import Case
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import Disk
from palmar.studies.closure import RadiusRange, Verdict

Intervals = tuple[tuple[float, float], ...]
IN_WORDS = {
    "proximal_palm": "proximal links and palm",
    "distal_palm": "distal links and palm",
    "distal_proximal": "distal and proximal links",
    "distal_proximal_palm": "distal and proximal links and palm",
}


@dataclass(frozen=True)
class JointedClosure:
    """What `palmar closure` reports of jointed fingers; radii in m, None where none is held.

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


def bends(case: Case) -> bool:
    """Whether the case is answered with bent fingers: more than one link, a disk, joint limits for a few links only."""
    links = len(case.hand.finger_links)
    return links > 1 and isinstance(case.object, Disk) and (case.hand.joint_limits is None or links <= MOST_LINKS)


def jointed_closure(case: Case) -> JointedClosure:
    """The answer for a case that ``bends``; with ranges in it, what is held at every combination of their ends."""
    corners = [_corner(each) for each in case.corners()]
    if len(corners) == 1:
        return corners[0]
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
    )


def _corner(case: Case) -> JointedClosure:
    hand, alpha = case.hand, case.contact.friction_angle
    assert isinstance(case.object, Disk)
    if hand.joint_limits is not None:
        return _limited(case)
    cases, holds = _cases(hand), _holds(hand, alpha)
    largest = (_largest(hand, 0.0, holds[0]), _largest(hand, alpha, holds[1]))
    straight = _straight(hand, alpha)
    structural = _range(_smallest(hand, straight[0]), largest[0])
    frictional = _range(min(_smallest(hand, each) for each in straight), largest[1]) if alpha else structural
    radius = case.object.radius
    reason = _reason(case, (structural, frictional), cases, holds)
    verdict = Verdict(_within(structural, radius), _within(frictional, radius), reason)
    ends = (_straight_range(straight[0]), _straight_range(straight[1]))
    return JointedClosure(structural, frictional, verdict, cases, holds, ((), ()), ends, tuple(_notes(hand)))


def _limited(case: Case) -> JointedClosure:
    """Within joint limits, by the search of ``mechanics.closure.limited``."""
    hand, alpha = case.hand, case.contact.friction_angle
    assert isinstance(case.object, Disk)
    radius = case.object.radius
    plain = limited_radii(limited_hand(hand, 0.0))
    rough = limited_radii(limited_hand(hand, alpha)) if alpha else plain
    ranges, holds = (_hull(plain), _hull(rough)), (plain.largest, rough.largest)
    held = [any(low <= radius <= high for low, high in each.intervals) for each in (plain, rough)]
    several = tuple(each.intervals if len(each.intervals) > 1 else () for each in (plain, rough))
    gap = [_within(each, radius) and not so for each, so in zip(ranges, held, strict=True)]
    if gap[1]:
        reason = "between two ranges of radii that are held"
    else:
        reason = _reason(case, (None if gap[0] else ranges[0], ranges[1]), {}, holds)
    straight = _straight(hand, alpha)
    ends = (_straight_range(straight[0]), _straight_range(straight[1]))
    return JointedClosure(
        *ranges, Verdict(held[0], held[1], reason), {}, holds, (several[0], several[1]), ends, tuple(_notes(hand))
    )


def limited_hand(hand: Hand, friction_angle: float) -> LimitedHand:
    """The hand as the search within joint limits takes it; without limits, joints turn by half a turn either way."""
    free = (hand.base_limits, *[(-pi, pi)] * (len(hand.finger_links) - 1))
    limits = free if hand.joint_limits is None else (hand.base_limits, *hand.joint_limits[1:])
    crossing = hand.fingers is Fingers.CROSSING
    return LimitedHand(hand.half_palm, hand.finger_links, limits, friction_angle, hand.half_thickness, crossing)


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


def largest_stance(hand: Hand, alpha: float) -> Stance | None:
    """How the hand holds its largest disk at the friction angle alpha (rad), within its joint limits; None if none."""
    if hand.joint_limits is not None:
        return limited_radii(limited_hand(hand, alpha)).largest
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
    own = stance_at(limited_hand(case.hand, alpha), case.object.radius) if some else None
    return own, answer.largest[frictional] or largest_stance(case.hand, alpha)


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


def _within(radii: RadiusRange | None, radius: float) -> bool:
    return radii is not None and radii.radius_min <= radius <= radii.radius_max


def _reason(
    case: Case,
    ranges: tuple[RadiusRange | None, RadiusRange | None],
    cases: dict[str, Intervals],
    holds: tuple[Stance | None, Stance | None],
) -> str:
    assert isinstance(case.object, Disk)
    radius, friction = case.object.radius, tan(case.contact.friction_angle)
    limited = case.hand.joint_limits is not None
    alone = _sentence(radius, ranges[0], "without friction", _by(radius, ranges[0], cases, holds[0]), limited=limited)
    if not friction or _within(ranges[0], radius):
        return alone
    how = f"with friction {friction:.3g}"
    rough = _sentence(radius, ranges[1], how, _by(radius, ranges[1], {}, holds[1]), limited=limited)
    return f"{rough if _within(ranges[1], radius) else f'{how} {rough}'}; without friction {alone}"


def _sentence(radius: float, radii: RadiusRange | None, how: str, by: str, *, limited: bool = False) -> str:
    if radii is None:
        return "no disk can be held: the fingers do not reach the equator of any disk on the palm"
    if radius > radii.radius_max:
        return f"too large by {_mm(radius - radii.radius_max)}: the largest disk is held {by}"
    if radius < radii.radius_min:
        why = "the joints reach their limits" if limited else "the fingertips cannot come close enough together"
        return f"too small by {_mm(radii.radius_min - radius)}: {why}"
    above = f", {_mm(radius - radii.radius_min)} above the smallest" if radii.radius_min > 0.0 else ""
    return f"held {how} {by}, {_mm(radii.radius_max - radius)} below the largest{above}"


def _by(radius: float, radii: RadiusRange | None, cases: dict[str, Intervals], hold: Stance | None) -> str:
    """Which contacts hold the disk, or the largest one where the disk is larger; where not known for this disk, how."""
    held = _within(radii, radius)
    shown = radius if held or radii is None else radii.radius_max
    able = [IN_WORDS[name] for name, known in cases.items() if any(low <= shown <= high for low, high in known)]
    if able:
        return f"by {' or by '.join(able)}"
    if hold is None or held:
        return "by the fingers, with or without the palm"
    return f"by {carriers(hold)}"


def carriers(hold: Stance) -> str:
    """The contacts of a hold, links counted from the palm."""
    if hold.carrier is None:
        return f"links {hold.last} of both fingers alone"
    if hold.carrier == 0:
        return f"links {hold.last} of both fingers and the palm"
    return f"links {hold.last} and {hold.carrier} of both fingers"


def _common(ranges: list[RadiusRange | None]) -> RadiusRange | None:
    known = [each for each in ranges if each is not None]
    low = max((each.radius_min for each in known), default=0.0)
    high = min((each.radius_max for each in known), default=-1.0)
    return RadiusRange(low, high) if len(known) == len(ranges) and low <= high else None


def _notes(hand: Hand) -> list[str]:
    notes = [f"the {len(hand.finger_links)} links of a finger bend inwards as they need; kept_straight is without that"]
    if hand.finger_thickness > 0.0:
        notes.append(f"fingers are {1e3 * hand.finger_thickness:g} mm thick with round tips, the palm is a line")
    if hand.joint_limits is not None:
        notes.append("joints keep within their limits; radii are found by a search, the largest to about 3 in 10 000")
    if hand.fingers is Fingers.COLLIDING:
        notes.append("fingers lie in one plane: the smallest radius is that between tips that meet")
    return notes


def _mm(length: float) -> str:
    return f"{float(f'{1e3 * length:.3g}'):g} mm"
