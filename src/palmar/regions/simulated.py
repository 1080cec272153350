"""From a case to a region by simulated starts, with the part of it that is certain beside it."""

from __future__ import annotations

from math import ceil, cos, degrees, hypot, pi, radians

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPoint, MultiPolygon, affinity
from shapely.geometry.base import BaseGeometry

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import EMPTY, areal, grown
from palmar.geometry.polygon import turned
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import slider_body
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.objects import Disk, Object
from palmar.regions.caging_core import caging_core
from palmar.regions.closing_sampled import SampledSets, sampled_sets
from palmar.regions.pushed_core import pushed_core
from palmar.regions.region import Model, Region

Orientations = tuple[float, float]
"""First and last orientation of the object's frame (rad)."""
SPACING = 1.0 / 64.0
"""Default spacing of starts, in finger lengths."""
FINEST = 1.0 / 2048.0
"""Least spacing, in finger lengths: finer ones would take hours."""
TURN = radians(5.0)
"""Orientations at most this far apart are simulated."""
QUARTER = 16
"""Chords of a quarter circle."""


def simulated_sets(
    case: Case, orientations: Orientations | None, spacing: float | None, certain: MultiPolygon = EMPTY
) -> SampledSets:
    """The sets of a case without ranges, at all orientations asked for; raises NotCoveredError if no finger can move.

    Positions in ``certain`` (m) are known to be caught and are not simulated.
    """
    motion, slider = straight_motion(case.hand), slider_of(case.object, case.support)
    if motion.last <= motion.first:
        raise NotCoveredError("hand.open_deg: the fingers cannot close any further")
    thetas = _thetas(*(orientations or (case.start.theta, case.start.theta)))
    body = slider_body(slider, case.contact.friction)
    length = case.hand.finger_length
    return sampled_sets(motion, body, slider.centre, thetas, max(spacing or SPACING * length, FINEST * length), certain)


def simulated_region(case: Case, closure: Closure, orientations: Orientations | None, spacing: float | None) -> Region:
    """The region of a case without ranges, caught at all orientations asked for, with its certain part."""
    low, high = orientations or (case.start.theta, case.start.theta)
    thetas = _thetas(low, high)
    core = _certain(case, low, high)
    sets = simulated_sets(case, orientations, spacing, core)
    whole, flattening = covered_from(sets.centre, case.object, thetas)
    apart = degrees(thetas[1] - thetas[0]) if len(thetas) > 1 else 0.0
    spread = f", at {sets.orientations} orientations {apart:.3g} deg apart" if apart else ""
    if sets.different < sets.orientations:
        spread += f" of which {sets.different} differ"
    if sets.mirrored:
        spread += ", the mirror image taken for the other half"
    empty = sets.centre.is_empty and core.is_empty
    return Region(
        model=Model.EXACT,
        closure=closure,
        guarantee=Guarantee.SAMPLED,
        centre=sets.centre,
        contact=EMPTY,
        whole=whole,
        flattening=flattening,
        reason="no start on the grid is caught" if empty else None,
        notes=(f"{sets.starts} simulated starts, {1e3 * sets.spacing:.3g} mm apart at the boundary{spread}",),
        outer=sets.outer,
        certain=core,
        orientations=(low, high),
        spacing=sets.spacing,
    )


def _certain(case: Case, low: float, high: float) -> MultiPolygon:
    """Positions of the object's frame that are certain: enclosed before it is touched, or followed by bounds."""
    hand, last = case.hand, straight_motion(case.hand).last
    untouched = caging_core(hand, case.object, last, low, high)
    if hand.half_thickness > 0.0:
        return untouched
    slider = slider_of(case.object, case.support)
    pushed: BaseGeometry = pushed_core(
        hand.half_palm, hand.finger_length, hand.open, last, slider, case.contact.friction
    )
    return areal(untouched | _seen_from_frame(pushed, slider.centre, low, high))


def _seen_from_frame(places: BaseGeometry, centre: tuple[float, float], low: float, high: float) -> BaseGeometry:
    """Places of the centre of pressure -> places of the object's frame from which it lies there at all orientations."""
    arm = hypot(*centre)
    if arm == 0.0 or places.is_empty:
        return places
    if high - low >= 2.0 * pi - 1e-9:
        # The centre may be anywhere on a circle; corners of the arcs are put outside of it.
        return places.buffer(-arm / cos(pi / (4.0 * QUARTER)), quad_segs=QUARTER)
    thetas = _thetas(low, high)
    if len(thetas) > 1:
        places = places.buffer(-arm * 0.5 * TURN)
    arms = [turned([centre], float(theta))[0] for theta in thetas]
    within: BaseGeometry = shapely.intersection_all([affinity.translate(places, -x, -y) for x, y in arms])
    return within


def object_reach(thing: Object) -> float:
    """Distance (m) of the object's farthest point from its frame's origin."""
    return thing.radius if isinstance(thing, Disk) else float(np.hypot(*np.transpose(thing.vertices)).max())


def _thetas(low: float, high: float) -> NDArray[np.float64]:
    """Orientations from low to high, not more than TURN apart; a full turn is not closed twice."""
    steps = ceil((high - low) / TURN - 1e-9)
    full = high - low >= 2.0 * pi - 1e-9
    return np.linspace(low, high, steps + 1)[: steps if full else steps + 1]


def covered_from(centre: MultiPolygon, thing: Object, thetas: NDArray[np.float64]) -> tuple[MultiPolygon, float]:
    """What the objects that start in the region cover, and its flattening (m)."""
    if centre.is_empty:
        return EMPTY, 0.0
    if isinstance(thing, Disk):
        return grown(centre, thing.radius, 1e-3 * thing.radius)
    if len(thetas) > 1:
        return grown(centre, object_reach(thing), 1e-3 * object_reach(thing))
    corners = turned(thing.vertices, float(thetas[0]))
    pieces = [
        MultiPoint((part[:, None, :] + corners[None, :, :]).reshape(-1, 2)).convex_hull
        for polygon in centre.geoms
        for part in _segments(np.asarray(polygon.exterior.coords))
    ]
    return areal(shapely.union_all([*pieces, *centre.geoms])), 0.0


def _segments(ring: NDArray[np.float64]) -> NDArray[np.float64]:
    """The sides of a ring, (N, 2, 2)."""
    return np.stack([ring[:-1], ring[1:]], axis=1)
