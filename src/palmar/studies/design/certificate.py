"""What a found hand tolerates, by the best method there is for it, and the guarantee of that number."""

from __future__ import annotations

import shapely

from palmar.geometry.planar_set import Circle
from palmar.models.behaviour import Behaviour
from palmar.models.case import Range
from palmar.models.design_brief import DesignBrief
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.regions.exact import exact_region
from palmar.studies.design.circumstances import Circumstances, case_of
from palmar.studies.design.felt import plan_for
from palmar.studies.design.tolerance import ROOM, Place, is_exact


def certified(brief: DesignBrief, hand: Hand, place: Place | None, does: Behaviour) -> tuple[float | None, Guarantee]:
    """Error (m) tolerated about a place (m), for the brief's ranges without its margin; None where only the hold counts.

    Disks on a table, straight fingers: the place's distance from the boundary of the exact region over all the radii.
    """
    if place is None:
        return None, Guarantee.CLOSED_FORM
    if brief.targets.sensors is not None:
        one = brief.targets.radii is not None and brief.targets.radii[0] == brief.targets.radii[1]
        return brief.targets.error, Guarantee.CLOSED_FORM if one else plan_for(brief, hand).guarantee
    if not is_exact(brief, does):
        plain = brief.model_copy(update={"limits": brief.limits.model_copy(update={"margin": 0.0})})
        return Circumstances(plain, hand, does).circle(place, ROOM * plain.error), Guarantee.SAMPLED
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
