"""From a case to its exact region: which method covers it, and what numbers given as ranges mean."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import nan

from shapely import MultiPolygon

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import EMPTY, grown
from palmar.models.case import Case, Range
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.objects import Disk
from palmar.models.support import SupportKind
from palmar.regions.disk import disk_region, disk_sides, empty_reason
from palmar.regions.region import Model, Region
from palmar.regions.robust import robust_sets
from palmar.regions.simulated import Orientations, object_reach, simulated_region, simulated_sets

FLATTENING = 1e-5
"""Default flattening error of curves, as a share of the finger's length."""
FRICTION, PRESSURE_CENTRE = ("contact", "friction"), ("support", "pressure_centre")
WITHOUT_EFFECT = (("support", "friction"), ("contact", "restitution"), ("object", "mass"))
"""Ranges that leave a region on a table alone."""


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
    Other ranges: see ``robust``. Raises NotCoveredError where no method covers the case.
    """
    if case.support.kind is not SupportKind.TABLE:
        raise NotCoveredError('support.kind = "free": the exact region is for objects on a table')
    if case.support.wall is not None:
        raise NotCoveredError("support.wall_mm: this needs a region without a wall")
    settled = settle(case, closure)
    tolerance = tolerance or FLATTENING * case.hand.finger_length
    if settled.ranges:
        region = _over_ranges(settled, closure, tolerance, orientations, spacing)
    elif _is_centred_disk(settled):
        region = disk_region(settled, closure, tolerance)
    else:
        region = simulated_region(settled, closure, orientations, spacing)
    links = len(case.hand.finger_links)
    kept = (f"the {links} links of a finger are kept straight",) if links > 1 else ()
    return replace(region, notes=(*region.notes, *kept))


def in_closed_form(case: Case, closure: Closure) -> bool:
    """Whether ``exact_region`` of a case that it covers is in closed form: a disk under centred pressure, plain numbers."""
    settled = settle(case, closure)
    return not settled.ranges and _is_centred_disk(settled)


def _is_centred_disk(case: Case) -> bool:
    off = case.support.pressure_centre != (0.0, 0.0) or any(each.place[:2] == PRESSURE_CENTRE for each in case.ranges)
    return isinstance(case.object, Disk) and not off


def settle(case: Case, closure: Closure) -> Case:
    """The case without the ranges that need no search: friction 0 for structural closure, else the lowest for a disk."""
    idle = {*WITHOUT_EFFECT}
    contact = case.contact
    if closure is Closure.STRUCTURAL:
        contact = contact.model_copy(update={"friction": 0.0})
        idle.add(FRICTION)
    elif _is_centred_disk(case):
        lowest = min([contact.friction, *(each.low for each in case.ranges if each.place == FRICTION)])
        contact = contact.model_copy(update={"friction": lowest})
        idle.add(FRICTION)
    rest: tuple[Range, ...] = tuple(each for each in case.ranges if each.place not in idle)
    return case.model_copy(update={"contact": contact, "ranges": rest})


def _over_ranges(
    case: Case, closure: Closure, tolerance: float, orientations: Orientations | None, spacing: float | None
) -> Region:
    """What is caught for all values of numbers given as ranges."""
    sides: Callable[[Case], tuple[MultiPolygon, MultiPolygon]]
    step = nan
    if _is_centred_disk(case):

        def sides(each: Case) -> tuple[MultiPolygon, MultiPolygon]:
            return disk_sides(each, tolerance)
    else:
        step = simulated_sets(case.settled([each.low for each in case.ranges]), orientations, spacing).spacing

        def sides(each: Case) -> tuple[MultiPolygon, MultiPolygon]:
            sets = simulated_sets(each, orientations, spacing)
            return sets.centre, sets.outer

    sets = robust_sets(case, sides)
    places = ", ".join(".".join(map(str, each.place)) for each in case.ranges)
    note = f"caught for all of {sets.cases} combinations of {places}, shrunk by {1e3 * sets.shrunk:.2g} mm for those between"
    whole, flattening = grown(sets.centre, max(object_reach(each.object) for each in case.corners()), tolerance)
    return Region(
        model=Model.EXACT,
        closure=closure,
        guarantee=Guarantee.SAMPLED,
        centre=sets.centre,
        contact=EMPTY,
        whole=whole,
        flattening=flattening,
        reason=_why_empty(case, closure, tolerance) if sets.centre.is_empty else None,
        notes=(note,),
        outer=sets.outer,
        orientations=None if _is_centred_disk(case) else orientations or (case.start.theta, case.start.theta),
        spacing=None if step != step else step,
    )


def _why_empty(case: Case, closure: Closure, tolerance: float) -> str:
    if _is_centred_disk(case):
        for each in case.corners():
            if disk_sides(each, tolerance)[0].is_empty:
                return f"for some of the values given as ranges, {empty_reason(each, closure)}"
    return "no start is caught for all values of the numbers given as ranges"
