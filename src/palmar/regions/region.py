"""A pre-image: where an object may start so that a motion catches it, and how far that is to be trusted."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import cached_property

from shapely import MultiPolygon

from palmar.geometry.planar_set import Circle, inscribed_circle
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee


class Model(Enum):
    """How a region was obtained."""

    EXACT = "exact"
    """The stated mechanics solved; the region given is the inner side of its error band."""
    PUBLISHED = "published"
    """The source's construction (on a table section 3.3.1, free 4.2.1), joined to the axis by a chord."""
    CORRECTED = "corrected"
    """That of section 4.2.1 with the right sign in equation 4.9; for free objects only."""


@dataclass(frozen=True)
class Region:
    """Sets in the hand frame (m); all empty, with the reason, where nothing is caught.

    ``centre`` holds the object's centres, ``contact`` the first contact points on the fingers,
    ``whole`` the entire object. ``flattening`` bounds the distance (m) between curved boundaries and the
    polygons given, which lie inside them. ``outer`` is the outer side of the error band: beyond it nothing is caught.
    """

    model: Model
    closure: Closure
    guarantee: Guarantee
    centre: MultiPolygon
    contact: MultiPolygon
    whole: MultiPolygon
    flattening: float
    reason: str | None = None
    notes: tuple[str, ...] = ()
    outer: MultiPolygon | None = None
    certain: MultiPolygon | None = None
    """Beside a sampled region: the part that is caught for certain, whatever friction and pressure."""
    orientations: tuple[float, float] | None = None
    """First and last orientation (rad) of the object for which the region holds; None: any."""
    spacing: float | None = None
    """Of the simulated starts (m)."""
    resting: tuple[tuple[float, float], ...] | None = None
    """Before a wall: intervals of x (m) from which an object that rests on it is caught."""

    @property
    def area(self) -> float:
        """Area (m^2) of the centre region, both halves, valid starts only."""
        return float(self.centre.area)

    @property
    def band(self) -> float:
        """Area (m^2) between the inner and the outer side; 0 without an outer side."""
        return 0.0 if self.outer is None else max(float(self.outer.area) - self.area, 0.0)

    @cached_property
    def allowed_error(self) -> Circle | None:
        """Largest circle of object centres, to 1e-4 of the region's size; None for an empty region."""
        if self.centre.is_empty:
            return None
        left, low, right, high = self.centre.bounds
        return inscribed_circle(self.centre, 1e-4 * max(right - left, high - low))
