"""From a case to its exact region: which method covers it, what ranges mean, and why a region is empty."""

from __future__ import annotations

from math import isnan

from shapely import MultiPolygon

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import EMPTY, grown
from palmar.mechanics.closure.disk_2_2 import Radii, frictional_radii, structural_radii
from palmar.mechanics.pushing.closing_case import closing_hand
from palmar.mechanics.pushing.closing_tables import build_tables
from palmar.mechanics.pushing.resting import slider_of
from palmar.models.case import Case, Range
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Fingers
from palmar.models.objects import Disk
from palmar.models.support import SupportKind
from palmar.regions.closing_exact import ExactSets, exact_sets
from palmar.regions.region import Model, Region
from palmar.regions.robust import robust_sets
from palmar.regions.simulated import Orientations, simulated_region

FLATTENING = 1e-5
"""Default flattening error of curves, as a share of the finger's length."""
FRICTION = ("contact", "friction")
WITHOUT_EFFECT = (FRICTION, ("support", "friction"), ("contact", "restitution"), ("object", "mass"))
"""Ranges that leave the region of a disk alone, or that its lowest value decides."""


def exact_region(
    case: Case,
    closure: Closure = Closure.FRICTIONAL,
    tolerance: float | None = None,
    orientations: Orientations | None = None,
    spacing: float | None = None,
) -> Region:
    """The true pre-image of the closing motion on a table.

    Disks under centred pressure: closed form, boundaries within ``tolerance`` (m; 1e-5 finger lengths); a range of friction
    means caught for every value in it, which is caught for the lowest (docs/derivations/exact_region.md). Polygons, and
    other pressures: from simulated starts at most ``spacing`` (m) apart, for all ``orientations`` (rad, first and last).
    Raises NotCoveredError where no method covers the case.
    """
    if case.support.kind is not SupportKind.TABLE:
        raise NotCoveredError('support.kind = "free": the exact region is for objects on a table')
    lowest = with_lowest_friction(case, closure)
    if not isinstance(lowest.object, Disk) or lowest.support.pressure_centre != (0.0, 0.0):
        return simulated_region(case, lowest, closure, orientations, spacing)
    tolerance = tolerance or FLATTENING * lowest.hand.finger_length
    if lowest.ranges:
        return _over_ranges(case, lowest, closure, tolerance)
    sets = disk_sets(lowest, tolerance)
    return Region(
        model=Model.EXACT,
        closure=closure,
        guarantee=Guarantee.CLOSED_FORM,
        centre=sets.centre,
        contact=sets.contact,
        whole=sets.whole,
        flattening=sets.flattening,
        reason=empty_reason(lowest, closure) if sets.centre.is_empty else None,
        notes=_notes(case),
        outer=sets.outer,
    )


def _over_ranges(case: Case, lowest: Case, closure: Closure, tolerance: float) -> Region:
    """What is caught for all values of numbers given as ranges."""

    def sides(each: Case) -> tuple[MultiPolygon, MultiPolygon]:
        sets = disk_sets(each, tolerance)
        return sets.centre, sets.outer

    sets = robust_sets(lowest, sides)
    reason = None
    if sets.centre.is_empty:
        empty = next((each for each in lowest.corners() if disk_sets(each, tolerance).centre.is_empty), None)
        reason = "no start is caught for all values of the numbers given as ranges"
        reason = f"for some of the values given as ranges, {empty_reason(empty, closure)}" if empty else reason
    places = ", ".join(".".join(map(str, each.place)) for each in lowest.ranges)
    note = f"caught for all of {sets.cases} combinations of {places}, shrunk by {1e3 * sets.shrunk:.2g} mm for those between"
    radii = [each.object.radius for each in lowest.corners() if isinstance(each.object, Disk)]
    whole, flattening = grown(sets.centre, max(radii), tolerance)
    return Region(
        model=Model.EXACT,
        closure=closure,
        guarantee=Guarantee.SAMPLED,
        centre=sets.centre,
        contact=EMPTY,
        whole=whole,
        flattening=flattening,
        reason=reason,
        notes=(note, *_notes(case)),
        outer=sets.outer,
    )


def disk_sets(case: Case, tolerance: float) -> ExactSets:
    """The sets of a disk under centred pressure; numbers with a range at their middle."""
    assert isinstance(case.object, Disk)
    hand = closing_hand(case.hand, case.object.radius, case.contact.friction)
    if hand.last <= hand.first:
        return ExactSets(EMPTY, EMPTY, EMPTY, EMPTY, 0.0, ())
    return exact_sets(hand, build_tables(hand, slider_of(case.object, case.support).surface, spin=False), tolerance)


def with_lowest_friction(case: Case, closure: Closure) -> Case:
    """The case at the lowest friction it allows (0 for structural closure), without the ranges that this settles."""
    friction = min([case.contact.friction, *(each.low for each in case.ranges if each.place == FRICTION)])
    if closure is Closure.STRUCTURAL:
        friction = 0.0
    contact = case.contact.model_copy(update={"friction": friction})
    rest: tuple[Range, ...] = tuple(each for each in case.ranges if each.place not in WITHOUT_EFFECT)
    return case.model_copy(update={"contact": contact, "ranges": rest})


def empty_reason(case: Case, closure: Closure) -> str:
    """Why nothing is caught."""
    assert isinstance(case.object, Disk)
    radius, radii = case.object.radius, held_radii(case)
    if isnan(float(radii.max)):
        return f"this hand has no {closure.value} hold of any disk"
    if not radii.holds(radius):
        held = f"{1e3 * float(radii.min):.4g} to {1e3 * float(radii.max):.4g} mm"
        side = "small" if radius < float(radii.min) else "large"
        return f"the disk is too {side} for a {closure.value} hold, which this hand has of radii {held}"
    return "a hold exists, but closing from the opening given leads no start into it"


def held_radii(case: Case) -> Radii:
    """Radii that the case's straight fingers hold at its friction."""
    hand, alpha = case.hand, case.contact.friction_angle
    crossing = hand.fingers is Fingers.CROSSING
    size = (hand.half_palm, hand.finger_length)
    if alpha > 0.0:
        return frictional_radii(*size, alpha, hand.half_thickness, crossing=crossing, psi_limits=hand.base_limits)
    return structural_radii(*size, hand.half_thickness, crossing=crossing, psi_limits=hand.base_limits)


def _notes(case: Case) -> tuple[str, ...]:
    links = len(case.hand.finger_links)
    return (f"the {links} links of a finger are kept straight",) if links > 1 else ()
