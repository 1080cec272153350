"""Can a hand with jointed fingers hold it: the radii held by any bend of the fingers, and the verdict on a disk."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, nan, tan

import numpy as np

from palmar.mechanics.closure.chain import Chain, Hold, largest_hold
from palmar.mechanics.closure.disk_2_2 import Radii, frictional_radii, structural_radii
from palmar.mechanics.closure.four_jointed_5_1 import CASES, four_jointed_radii
from palmar.mechanics.closure.four_jointed_cradle import folded_radius
from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
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

    ``cases`` are the intervals held without friction by each set of links, known for two line links a finger;
    ``largest`` the posture that holds the largest disk where it was found by optimisation; ``straight`` what is held with
    the fingers kept straight, without friction and with it.
    """

    structural: RadiusRange | None
    frictional: RadiusRange | None
    object: Verdict
    cases: dict[str, Intervals]
    largest: Hold | None
    straight: tuple[RadiusRange | None, RadiusRange | None]
    notes: tuple[str, ...]


def bends(case: Case) -> bool:
    """Whether the case is answered with bent fingers: more than one link, a disk, no joint limits."""
    return len(case.hand.finger_links) > 1 and isinstance(case.object, Disk) and case.hand.joint_limits is None


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
        (_common([each.straight[0] for each in corners]), _common([each.straight[1] for each in corners])),
        (*nominal.notes, "what is reported holds at every end of the given ranges"),
    )


def _corner(case: Case) -> JointedClosure:
    hand, alpha = case.hand, case.contact.friction_angle
    assert isinstance(case.object, Disk)
    cases, holds = _cases(hand), _holds(hand, alpha)
    largest = (_largest(hand, 0.0, holds[0]), _largest(hand, alpha, holds[1]))
    straight = _straight(hand, alpha)
    structural = _range(_smallest(hand, straight[0]), largest[0])
    frictional = _range(min(_smallest(hand, each) for each in straight), largest[1]) if alpha else structural
    radius = case.object.radius
    reason = _reason(case, (structural, frictional), cases, holds)
    verdict = Verdict(_within(structural, radius), _within(frictional, radius), reason)
    ends = (_straight_range(straight[0]), _straight_range(straight[1]))
    return JointedClosure(structural, frictional, verdict, cases, holds[1], ends, tuple(_notes(hand)))


def _closed_form(hand: Hand) -> bool:
    return len(hand.finger_links) == 2 and hand.finger_thickness == 0.0


def _holds(hand: Hand, alpha: float) -> tuple[Hold | None, Hold | None]:
    """The largest holds without and with friction, by optimisation where there is no closed form."""
    if _closed_form(hand):
        return None, None
    given = (hand.half_palm, hand.finger_links)
    plain = largest_hold(Chain(*given, 0.0, hand.half_thickness))
    return plain, (largest_hold(Chain(*given, alpha, hand.half_thickness)) if alpha else plain)


def _largest(hand: Hand, alpha: float, hold: Hold | None) -> float:
    if _closed_form(hand):
        proximal, distal = hand.finger_links
        return float(largest_with_friction(hand.half_palm, proximal, distal, alpha))
    return hold.radius if hold else nan


def _straight(hand: Hand, alpha: float) -> tuple[Radii, Radii]:
    body = (hand.half_palm, hand.finger_length)
    crossing = hand.fingers is Fingers.CROSSING
    return (
        structural_radii(*body, hand.half_thickness, crossing=crossing),
        frictional_radii(*body, alpha, hand.half_thickness, crossing=crossing),
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
    holds: tuple[Hold | None, Hold | None],
) -> str:
    assert isinstance(case.object, Disk)
    radius, friction = case.object.radius, tan(case.contact.friction_angle)
    alone = _sentence(radius, ranges[0], "without friction", _by(radius, ranges[0], cases, holds[0]))
    if not friction or _within(ranges[0], radius):
        return alone
    how = f"with friction {friction:.3g}"
    rough = _sentence(radius, ranges[1], how, _by(radius, ranges[1], {}, holds[1]))
    return f"{rough if _within(ranges[1], radius) else f'{how} {rough}'}; without friction {alone}"


def _sentence(radius: float, radii: RadiusRange | None, how: str, by: str) -> str:
    if radii is None:
        return "no disk can be held: the fingers do not reach the equator of any disk on the palm"
    if radius > radii.radius_max:
        return f"too large by {_mm(radius - radii.radius_max)}: the largest disk is held {by}"
    if radius < radii.radius_min:
        return f"too small by {_mm(radii.radius_min - radius)}: the fingertips cannot come close enough together"
    above = f", {_mm(radius - radii.radius_min)} above the smallest" if radii.radius_min > 0.0 else ""
    return f"held {how} {by}, {_mm(radii.radius_max - radius)} below the largest{above}"


def _by(radius: float, radii: RadiusRange | None, cases: dict[str, Intervals], hold: Hold | None) -> str:
    """Which contacts hold the disk, or the largest one where the disk is larger; where not known for this disk, how."""
    held = _within(radii, radius)
    shown = radius if held or radii is None else radii.radius_max
    able = [IN_WORDS[name] for name, known in cases.items() if any(low <= shown <= high for low, high in known)]
    if able:
        return f"by {' or by '.join(able)}"
    if hold is None or held:
        return "by palm and fingers"
    return f"by {carriers(hold)}"


def carriers(hold: Hold) -> str:
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
    if hand.fingers is Fingers.COLLIDING:
        notes.append("fingers lie in one plane: the smallest radius is that between tips that meet")
    return notes


def _mm(length: float) -> str:
    return f"{float(f'{1e3 * length:.3g}'):g} mm"
