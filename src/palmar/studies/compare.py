"""Regions of one case by several models, and a simulated start for every promise that another model breaks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np
import shapely
from shapely import MultiPolygon

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import areal
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.outcome import Outcome
from palmar.regions.build import build_region
from palmar.regions.region import Model, Region
from palmar.studies.simulate import simulate_start

ANGLES = tuple(radians(each) for each in (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0))
HAIR = 1e-4
"""Rays this near to a region, in its sizes, meet it."""
LEAST = 1e-4
"""Differences below this share of the promised area are not reported."""


@dataclass(frozen=True)
class Difference:
    """Where ``promised_by`` says caught and ``denied_by`` does not: the set (m), a start well inside it, how that ends.

    ``outcome`` and ``end`` (m) are None where nothing here carries such an object.
    """

    promised_by: Model
    denied_by: Model
    where: MultiPolygon
    start: tuple[float, float]
    outcome: Outcome | None
    end: tuple[float, float] | None


@dataclass(frozen=True)
class Reach:
    """Distance (m) from the right base joint to the farthest first contact at an angle (rad) there, for each region."""

    angle: float
    distances: tuple[float | None, ...]


@dataclass(frozen=True)
class Comparison:
    """The regions, in the order asked for, where they differ, and how far each reaches in some directions."""

    regions: tuple[Region, ...]
    differences: tuple[Difference, ...]
    reaches: tuple[Reach, ...]


def compare_regions(case: Case, models: Sequence[Model], closure: Closure) -> Comparison:
    """Build the regions and simulate a start, frictionless for structural closure, in each part they disagree about."""
    regions = tuple(build_region(case, model, closure) for model in models)
    friction = 0.0 if closure is Closure.STRUCTURAL else case.contact.friction
    played = case.model_copy(update={"contact": case.contact.model_copy(update={"friction": friction})})
    found = [_difference(played, one, other) for one in regions for other in regions if one is not other]
    joint = case.hand.half_palm
    reaches = [Reach(angle, tuple(_reach(each.contact, joint, angle) for each in regions)) for angle in ANGLES]
    return Comparison(regions, tuple(each for each in found if each is not None), tuple(reaches))


def _reach(contact: MultiPolygon, joint: float, angle: float) -> float | None:
    """Along a ray from the joint the farthest point of the contact region (m); None if the ray misses it."""
    if contact.is_empty:
        return None
    far = 2.0 * max(abs(each) for each in contact.bounds)
    ray = shapely.LineString([(joint, 0.0), (joint + far * cos(angle), far * sin(angle))])
    points = shapely.get_coordinates(shapely.intersection(contact.buffer(HAIR * far), ray))
    return float(np.hypot(points[:, 0] - joint, points[:, 1]).max()) if len(points) else None


def _difference(case: Case, one: Region, other: Region) -> Difference | None:
    """What the first promises and the second denies: beyond its outer side, where it has one."""
    where = areal(one.centre - (other.centre if other.outer is None else other.outer))
    if where.area <= LEAST * max(one.area, other.area):
        return None
    largest = max(where.geoms, key=lambda part: part.area)
    point = shapely.get_point(shapely.maximum_inscribed_circle(largest), 0)
    start = float(point.x), float(point.y)
    try:
        result = simulate_start(case, start)
    except NotCoveredError:
        return Difference(one.model, other.model, where, start, None, None)
    return Difference(one.model, other.model, where, start, result.outcome, result.pose[:2])
