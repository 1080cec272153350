"""Starts that are caught whatever the friction and the pressure: enclosed before anything has touched them.

Let the object contain the disk of radius i about its incentre c, and let psi_c be the angle from which the fingertips are
less than 2 i apart. From then on c cannot pass between them: it would have to be i away from both. If c is then in the
pocket of palm, fingers and tip line, it stays there to the end, however the object slides, turns or jams. A start that no
finger reaches before psi_c lies still until then. So it is caught if it lies clear of palm and of all that the fingers
sweep up to psi_c, and its incentre in the pocket. This uses no mechanics but that the object moves only when touched.
Derived in docs/derivations/exact_region.md.
"""

from __future__ import annotations

from math import acos, ceil, cos, hypot, pi, radians

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, MultiPolygon, Polygon, affinity
from shapely.geometry.base import BaseGeometry

from palmar.geometry.planar_set import EMPTY, areal
from palmar.geometry.polygon import turned
from palmar.models.hand import Hand
from palmar.models.objects import Disk, Object

Floats = NDArray[np.float64]
STEP = radians(2.0)
"""Steps of arcs and of orientations; what lies between is bounded, not skipped."""


def caging_core(hand: Hand, thing: Object, last: float, low: float, high: float) -> MultiPolygon:
    """Positions (m) of the object's frame caught for certain at every orientation in [low, high] (rad).

    Straight fingers close from ``hand.open`` to ``last`` (rad).
    """
    centre, inradius = _incircle(thing)
    cosine = (inradius + hand.half_thickness - hand.half_palm) / hand.finger_length
    if not -1.0 < cosine < 1.0:
        return EMPTY
    caged = max(acos(cosine), hand.open)
    if caged >= last or caged - hand.open >= pi:
        return EMPTY
    steps = max(1, ceil((high - low) / STEP))
    thetas, slack = np.linspace(low, high, steps + 1), 0.5 * (high - low) / steps
    core = _pocket(hand, caged, centre, thetas, slack)
    outline = -_swept_outline(thing, thetas, slack)
    for side in (1.0, -1.0):
        sector = _swept(hand, caged)
        core = core - _sum(sector * np.array([side, 1.0]), outline)
    palm = np.array([[-hand.half_palm, 0.0], [hand.half_palm, 0.0]])
    return areal(core - _sum(palm, outline))


def _incircle(thing: Object) -> tuple[tuple[float, float], float]:
    """Centre (in the object's frame) and radius (m) of a disk inside it, as large as found to a millionth of its size."""
    if isinstance(thing, Disk):
        return (0.0, 0.0), thing.radius
    outline = Polygon(thing.vertices)
    size = hypot(outline.bounds[2] - outline.bounds[0], outline.bounds[3] - outline.bounds[1])
    centre = shapely.get_point(shapely.maximum_inscribed_circle(outline, 1e-6 * size), 0)
    return (float(centre.x), float(centre.y)), float(outline.exterior.distance(centre))


def _pocket(hand: Hand, psi: float, centre: tuple[float, float], thetas: Floats, slack: float) -> BaseGeometry:
    """Where the object's frame may be for its incentre to lie in the pocket at all orientations."""
    tip = (hand.half_palm + hand.finger_length * cos(psi), hand.finger_length * np.sin(psi))
    pocket = Polygon([(-hand.half_palm, 0.0), (hand.half_palm, 0.0), tip, (-tip[0], tip[1])])
    found: BaseGeometry = pocket.buffer(-hypot(*centre) * slack, join_style="mitre")
    arms = np.array([turned([centre], float(theta))[0] for theta in thetas])
    base = found
    for x, y in arms:
        found = found & affinity.translate(base, -x, -y)
    return found


def _swept_outline(thing: Object, thetas: Floats, slack: float) -> Floats:
    """Corners (N, 2) whose hull contains the object at all orientations, about its frame's origin."""
    if isinstance(thing, Disk):
        around = np.arange(0.0, 2.0 * pi, STEP)
        return thing.radius / cos(0.5 * STEP) * np.column_stack([np.cos(around), np.sin(around)])
    return np.concatenate([turned(thing.vertices, float(theta)) for theta in thetas]) / cos(slack)


def _swept(hand: Hand, psi: float) -> Floats:
    """Corners whose hull contains what the right finger sweeps from its opening to psi."""
    steps = max(1, ceil((psi - hand.open) / STEP))
    step = (psi - hand.open) / steps
    angles = np.concatenate([[hand.open], hand.open + step * (np.arange(steps) + 0.5), [psi]])
    reach = np.concatenate([[1.0], np.full(steps, 1.0 / cos(0.5 * step)), [1.0]]) * hand.finger_length
    ends = np.column_stack([hand.half_palm + reach * np.cos(angles), reach * np.sin(angles)])
    corners = np.concatenate([[[hand.half_palm, 0.0]], ends])
    if hand.half_thickness == 0.0:
        return corners
    around = np.arange(0.0, 2.0 * pi, 4.0 * STEP)
    ring = hand.half_thickness / cos(2.0 * STEP) * np.column_stack([np.cos(around), np.sin(around)])
    return (corners[:, None, :] + ring[None, :, :]).reshape(-1, 2)


def _sum(first: Floats, second: Floats) -> BaseGeometry:
    """Minkowski sum of two hulls."""
    # A line through all the points: made at once, where a MultiPoint makes a geometry of each.
    return LineString((first[:, None, :] + second[None, :, :]).reshape(-1, 2)).convex_hull
