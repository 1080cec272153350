"""What a found hand tolerates, by the best method there is for it, and the guarantee of that number."""

from __future__ import annotations

import shapely

from palmar.geometry.planar_set import Circle
from palmar.models.case import Range
from palmar.models.design_brief import DesignBrief
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.regions.exact import exact_region
from palmar.studies.design.tolerance import Place, case_of, is_exact, plan_for, tolerance


def certified(brief: DesignBrief, hand: Hand, place: Place | None) -> tuple[float | None, Guarantee]:
    """Error (m) tolerated about a place (m), for the brief's ranges without its margin; None where only the hold counts.

    Disks on a table: the distance from the place to the boundary of the exact region over all the range of radii.
    """
    if place is None:
        return None, Guarantee.CLOSED_FORM
    if brief.targets.sensors is not None:
        return brief.targets.error, plan_for(brief, hand).guarantee
    if not is_exact(brief):
        plain = brief.model_copy(update={"limits": brief.limits.model_copy(update={"margin": 0.0})})
        return tolerance(plain, hand).radius, Guarantee.SAMPLED
    circle, guarantee = _in_region(brief, hand, place)
    return circle.radius, guarantee


def _in_region(brief: DesignBrief, hand: Hand, place: Place) -> tuple[Circle, Guarantee]:
    assert brief.targets.radii is not None
    low, high = brief.targets.radii
    case = case_of(brief, hand, Disk(radius=0.5 * (low + high)), brief.targets.friction[0])
    if low < high:
        case = case.model_copy(update={"ranges": (Range(place=("object", "radius"), low=low, high=high),)})
    region = exact_region(case)
    middle = shapely.Point(place)
    inside = region.centre.contains(middle)
    return Circle(place, float(region.centre.boundary.distance(middle)) if inside else 0.0), region.guarantee
