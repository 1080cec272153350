"""Which targets and limits a found hand just meets: what would have to be relaxed for a smaller one."""

from __future__ import annotations

from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.design_brief import DesignBrief
from palmar.models.hand import Hand
from palmar.studies.design.bounds import least_reach, wrap_of
from palmar.studies.design.circumstances import STRAIGHT
from palmar.studies.design.tolerance import is_exact, tolerance

NEARLY = 5e-3
"""Share within which something counts as just met."""
SMALLER = 0.98
"""Of a hand, where what it tolerates comes in steps."""


def binding(brief: DesignBrief, hand: Hand, does: Behaviour = STRAIGHT) -> tuple[str, ...]:
    """Names of what binds: "largest radius", "smallest radius", "error", or a limit by its key."""
    d, length = hand.half_palm, hand.finger_length
    found = []
    if brief.targets.radii is not None:
        wrap = wrap_of(brief, len(hand.finger_links))
        if float(wrap.least_finger(0.98 * d)) > length or _meets(float(wrap.least_finger(d)), length):
            found.append("largest radius")
        radii = wrap.straight_radii(d, length)
        straight = does.name is BehaviourName.CLOSE
        if straight and float(radii.min) > 0.0 and _meets(float(radii.min), wrap.smallest):
            found.append("smallest radius")
    if brief.error > 0.0:
        if _error_binds(brief, hand, does):
            found.append("error")
    elif brief.targets.vertices is not None:
        found.append("orientations")
    limits = brief.limits
    for name, value, pair in (
        ("palm_width_mm", 2.0 * d, limits.palm_width),
        ("finger_length_mm", length, limits.finger_length),
        ("hand_length_mm", 2.0 * (d + length), (0.0, limits.hand_length)),
    ):
        found += [name] if any(end > 0.0 and _meets(value, end) for end in pair) else []
    return tuple(found)


def _error_binds(brief: DesignBrief, hand: Hand, does: Behaviour) -> bool:
    """Whether more would hardly be tolerated; where that is sampled, whether a smaller hand tolerates too little."""
    if brief.targets.sensors is not None or _meets(hand.finger_length, least_reach(brief)):
        return True
    if is_exact(brief, does):
        return tolerance(brief, hand).radius <= brief.error * (1.0 + NEARLY)
    links = tuple(SMALLER * each for each in hand.finger_links)
    return tolerance(brief, brief.limits.hand(SMALLER * hand.half_palm, links), does).radius < brief.error


def _meets(value: float, end: float) -> bool:
    return abs(value - end) <= NEARLY * end
