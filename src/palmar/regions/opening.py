"""How far the fingers must open: the base angles at the start from which an uncertain object is certainly caught.

A finger that starts at psi0 instead of 0 has passed the starts it would have touched before; the others fare as they
would have. So the region shrinks as psi0 grows, and the largest psi0 that still covers the uncertainty is the smallest
safe opening. That is not taken for granted (a hand may also start behind the object): the whole range of angles is
scanned, and every change between neighbours is bisected.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import hypot

import numpy as np
from shapely import MultiPolygon
from shapely.geometry.base import BaseGeometry

from palmar.geometry.planar_set import areal, inscribed_circle
from palmar.regions.shrink import enclosing_disk, fits, shrunk

SCANS, FINE = 61, 1e-4
"""Angles looked at, and the precision (rad) of the ends of the intervals between them."""
KEPT = 0.999
"""An allowed error above this share of the largest counts as the largest."""

RegionOf = Callable[[float], MultiPolygon]
"""The inner side (m) of the region of the hand that starts at a base angle (rad)."""


@dataclass(frozen=True)
class Openings:
    """Intervals (rad) of base angles at the start that work, with the place (m) they are about at the largest one."""

    works: tuple[tuple[float, float], ...]
    at: tuple[float, float] | None

    @property
    def smallest(self) -> float | None:
        """The angle (rad) of the smallest opening that works: the largest angle."""
        return self.works[-1][1] if self.works else None


@dataclass(frozen=True)
class WidestOpening:
    """The largest base angle (rad) at which the allowed error (m) is still the largest of all openings."""

    angle: float
    allowed: float


def openings_at(
    region_of: RegionOf, limits: tuple[float, float], uncertainty: BaseGeometry, at: tuple[float, float]
) -> Openings:
    """Openings between ``limits`` (rad) whose region covers the uncertainty (m) about a given place."""
    works = _intervals(lambda angle: fits(region_of(angle), uncertainty, at), limits)
    return Openings(works, at if works else None)


def openings_anywhere(region_of: RegionOf, limits: tuple[float, float], uncertainty: BaseGeometry) -> Openings:
    """Openings whose region covers the uncertainty about some place, which may differ from opening to opening."""
    places: dict[float, tuple[float, float]] = {}

    def covers(angle: float) -> bool:
        known = max((each for each in places if each >= angle), default=None)
        found = roomiest_place(region_of(angle), uncertainty, places[known] if known is not None else None)
        if found is not None:
            places[angle] = found
        return found is not None

    works = _intervals(covers, limits)
    if not works:
        return Openings((), None)
    return Openings(works, roomiest_place(region_of(works[-1][1]), uncertainty, None))


def widest_opening(region_of: RegionOf, limits: tuple[float, float]) -> WidestOpening | None:
    """The opening that allows the largest error in every direction; None where no opening catches anything."""
    angles = np.linspace(*limits, SCANS)
    allowed = np.array([_inscribed(region_of(float(angle))) for angle in angles])
    if not allowed.max() > 0.0:
        return None
    best = int(np.flatnonzero(allowed >= KEPT * allowed.max())[-1])
    return WidestOpening(float(angles[best]), float(allowed[best]))


def roomiest_place(
    region: MultiPolygon, uncertainty: BaseGeometry, likely: tuple[float, float] | None
) -> tuple[float, float] | None:
    """A place about which the uncertainty lies in the region: ``likely`` if it does, else the one with the most room.

    None where there is none.
    """
    if _too_large(region, uncertainty):
        return None
    if likely is not None and fits(region, uncertainty, likely):
        return likely
    disk = enclosing_disk(uncertainty)
    if disk is not None:
        found = inscribed_circle(region, 1e-4 * hypot(*_extent(region)))
        shift = (found.centre[0] - disk.centre[0], found.centre[1] - disk.centre[1])
        return shift if found.radius >= disk.radius else None
    places = shrunk(region, uncertainty)
    if places.is_empty:
        return None
    x, y = inscribed_circle(places, 1e-3 * hypot(*_extent(places))).centre
    return x, y


def _intervals(works: Callable[[float], bool], limits: tuple[float, float]) -> tuple[tuple[float, float], ...]:
    """Where a predicate holds, from large angles to small and so bisected; both ends of each interval work."""
    angles = [float(each) for each in np.linspace(*limits, SCANS)]
    flags = {angle: works(angle) for angle in reversed(angles)}
    found: list[tuple[float, float]] = []
    begin: float | None = None
    for angle, after in zip(angles, [*angles[1:], None], strict=True):
        if flags[angle] and begin is None:
            begin = angle
        if begin is not None and (after is None or not flags[after]):
            found.append((begin, angle if after is None else _bisected(works, angle, after)))
            begin = None
        elif begin is None and after is not None and flags[after]:
            begin = _bisected(works, after, angle)
    return tuple(found)


def _bisected(works: Callable[[float], bool], good: float, bad: float) -> float:
    """The last angle from ``good`` towards ``bad`` that works."""
    while abs(bad - good) > FINE:
        middle = 0.5 * (good + bad)
        good, bad = (middle, bad) if works(middle) else (good, middle)
    return good


def _too_large(region: MultiPolygon, uncertainty: BaseGeometry) -> bool:
    wide, high = _extent(region) if not region.is_empty else (0.0, 0.0)
    needed = _extent(uncertainty)
    return uncertainty.area > region.area or needed[0] > wide or needed[1] > high


def _extent(shape: BaseGeometry) -> tuple[float, float]:
    left, low, right, high = shape.bounds
    return right - left, high - low


def _inscribed(region: MultiPolygon) -> float:
    if region.is_empty:
        return 0.0
    return inscribed_circle(areal(region), 1e-3 * hypot(*_extent(region))).radius
