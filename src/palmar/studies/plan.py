"""A plan that certainly ends in a grasp: from a case and a set of places to the policy with the fewest approaches."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import radians

from shapely import affinity
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.approach import Doubt
from palmar.behaviours.fewest import Fewest
from palmar.behaviours.placing import target
from palmar.behaviours.planner import Opening, Planner
from palmar.behaviours.policy import approaches
from palmar.behaviours.recentring import recentring
from palmar.behaviours.search import Found, fewest_approaches
from palmar.behaviours.superposed import closings_only, strips
from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import areal
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.models.case import Case, Range
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Fingers
from palmar.models.objects import Disk
from palmar.models.sensors import Stretch
from palmar.models.support import SupportKind
from palmar.regions.captured import captured_region
from palmar.regions.exact import exact_region
from palmar.regions.hand_sweep import may_be_touched
from palmar.regions.profile import above, not_below, profile

OTHER_OPENINGS = tuple(radians(each) for each in (30.0, 60.0, 75.0))
"""Base angles (rad) tried beside the case's own."""
COARSE = 1e-4
"""Flattening of the regions closed from, as a share of the finger's length."""
FAR = 10.0
"""Finger lengths beyond which nothing is of interest to a closing motion."""


class Rule(Enum):
    """How the next approach is chosen."""

    FEWEST = "fewest"
    """By search: as few approaches as can be found."""
    RECENTRE = "recentre"
    """The source's: under the middle of what is known."""
    STRIPS = "strips"
    """Strip beside strip across what is known, from one side to the other, and a plan of its own for what is felt."""
    CLOSINGS = "closings"
    """No touch: close where the object may be, one place after the other."""


@dataclass(frozen=True)
class Plan:
    """What the search found, the sensors it speaks of, and what it assumes of them."""

    found: Found
    stretches: tuple[Stretch, ...]
    doubt: Doubt
    closure: Closure
    rule: Rule = Rule.FEWEST
    guarantee: Guarantee = Guarantee.CLOSED_FORM
    """Of the regions that the hand closes in."""


def plan(
    case: Case,
    uncertainty: BaseGeometry,
    at: tuple[float, float],
    most: int,
    closure: Closure = Closure.FRICTIONAL,
    rule: Rule = Rule.FEWEST,
    directions: tuple[float, ...] = (0.0,),
    largest: float | None = None,
) -> Plan:
    """The plan for an object whose centre is at ``at`` (m, hand frame) up to the set of errors ``uncertainty`` (m).

    ``directions`` (rad): how far the hand may be turned from how it stands. ``largest`` (m): on a table the radius may be
    any from that of the case to this. Raises NotCoveredError for objects that are no disks.
    """
    if rule is Rule.CLOSINGS and case.hand.fingers is Fingers.COLLIDING:
        raise NotCoveredError(
            "closings one after the other are for fingers that pass each other: others end alike on nothing and on an object"
        )
    planner, stretches = planner_of(case, closure, directions, largest)
    belief = affinity.translate(uncertainty, *at)
    if rule is Rule.RECENTRE:
        policy = recentring(planner, belief, most)
        found = Found(policy, Fewest(planner).least(belief, approaches(policy)), False, 0)
    elif rule is Rule.STRIPS:
        found = strips(planner, belief, most)
    elif rule is Rule.CLOSINGS:
        found = closings_only(planner, belief)
    else:
        found = fewest_approaches(planner, belief, most)
    free = case.support.kind is SupportKind.FREE
    guarantee = Guarantee.SAMPLED if free or planner.doubt.spread > 0.0 else Guarantee.CLOSED_FORM
    return Plan(found, stretches, planner.doubt, closure, rule, guarantee)


def planner_of(
    case: Case,
    closure: Closure = Closure.FRICTIONAL,
    directions: tuple[float, ...] = (0.0,),
    largest: float | None = None,
) -> tuple[Planner, tuple[Stretch, ...]]:
    """What the search needs of a case: for every opening the profile and the region; and the sensors."""
    if not isinstance(case.object, Disk) or case.support.pressure_centre != (0.0, 0.0):
        raise NotCoveredError("plans are for disks pressed about their centre: the sensors' regions need a radius")
    if case.ranges:
        raise NotCoveredError("plans take plain numbers, not ranges")
    if largest is not None and case.support.kind is SupportKind.FREE:
        raise NotCoveredError("plans in free space take one radius")
    if case.support.kind is SupportKind.FREE and case.start.velocity != (0.0, 0.0):
        raise NotCoveredError("start.velocity_mm_s: plans in free space are for heavy objects at rest")
    stretches = case.sensors.stretches(case.hand)
    low, high = case.hand.base_limits
    angles = dict.fromkeys((case.hand.open, *(each for each in OTHER_OPENINGS if low <= each < high)))
    openings = tuple(opening_of(case, stretches, angle, closure, largest) for angle in angles)
    spread = 0.0 if largest is None else largest - case.object.radius
    return Planner(openings, Doubt(case.sensors.displacement, case.sensors.pose_error, spread), directions), stretches


def opening_of(
    case: Case, stretches: tuple[Stretch, ...], angle: float, closure: Closure, largest: float | None = None
) -> Opening:
    """Profile and closing region of a disk's case with the fingers at a base angle (rad).

    With a ``largest`` radius (m) the region is what those of all radii from the case's have in common, and nothing of the
    largest disk is touched on the way up; the profile stays that of the case.
    """
    assert isinstance(case.object, Disk)
    opened = case.model_copy(update={"hand": case.hand.model_copy(update={"open": float(angle)})})
    radius, far = case.object.radius, FAR * case.hand.finger_length
    widest = radius if largest is None else largest
    if case.support.kind is SupportKind.FREE:
        region = captured_region(opened, closure, None)
    else:
        spread = () if widest <= radius else (Range(place=("object", "radius"), low=radius, high=widest),)
        region = exact_region(opened.model_copy(update={"ranges": spread}), closure, COARSE * case.hand.finger_length)
    seen = profile(case.hand, radius, stretches, angle)
    clear = profile(case.hand, widest, stretches, angle)
    assert region.outer is not None
    return Opening(
        angle,
        seen,
        target(areal(region.centre.intersection(above(clear, far)))),
        areal(region.outer.intersection(not_below(seen, far))),
        may_be_touched(case.hand, widest, angle, straight_motion(case.hand).last, far),
    )
