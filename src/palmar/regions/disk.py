"""From a case to the closed-form region of its disk, with the reason where it is empty."""

from __future__ import annotations

from math import isnan

from shapely import MultiPolygon

from palmar.geometry.planar_set import EMPTY, with_mirror_image
from palmar.mechanics.closure.disk_2_2 import Radii, frictional_radii, structural_radii
from palmar.mechanics.pushing.closing_case import closing_hand
from palmar.mechanics.pushing.closing_tables import ClosingHand, Tables, build_tables
from palmar.mechanics.pushing.resting import slider_of
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Fingers
from palmar.models.objects import Disk
from palmar.regions.closing_exact import ExactSets, exact_sets, exact_sides
from palmar.regions.region import Model, Region


def disk_region(case: Case, closure: Closure, tolerance: float) -> Region:
    """The region of a disk under centred pressure, boundaries within ``tolerance`` (m)."""
    sets = disk_sets(case, tolerance)
    return Region(
        model=Model.EXACT,
        closure=closure,
        guarantee=Guarantee.CLOSED_FORM,
        centre=sets.centre,
        contact=sets.contact,
        whole=sets.whole,
        flattening=sets.flattening,
        reason=empty_reason(case, closure) if sets.centre.is_empty else None,
        outer=sets.outer,
    )


def disk_sets(case: Case, tolerance: float) -> ExactSets:
    """The sets of a disk under centred pressure; numbers with a range at their middle."""
    known = _closing(case)
    return exact_sets(*known, tolerance) if known else ExactSets(EMPTY, EMPTY, EMPTY, EMPTY, 0.0, ())


def disk_sides(case: Case, tolerance: float) -> tuple[MultiPolygon, MultiPolygon]:
    """Inner and outer side of the centre region alone, in half the time."""
    known = _closing(case)
    if not known:
        return EMPTY, EMPTY
    sides = exact_sides(*known, tolerance)
    return with_mirror_image(sides.inner), with_mirror_image(sides.outer)


def _closing(case: Case) -> tuple[ClosingHand, Tables] | None:
    """The hand as the kernels take it, and its tables; None where it cannot close any further."""
    assert isinstance(case.object, Disk)
    hand = closing_hand(case.hand, case.object.radius, case.contact.friction)
    if hand.last <= hand.first:
        return None
    return hand, build_tables(hand, slider_of(case.object, case.support).surface, spin=False)


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
