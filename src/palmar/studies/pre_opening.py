"""The smallest safe pre-opening: how little the fingers must open for an object known up to a set of position errors."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import cos

from shapely import MultiPolygon
from shapely.geometry.base import BaseGeometry

from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.hand import Hand
from palmar.regions.build import build_region
from palmar.regions.exact import exact_region
from palmar.regions.opening import Openings, WidestOpening, openings_anywhere, openings_at, widest_opening
from palmar.regions.region import Model
from palmar.regions.shrink import fits

Pair = tuple[float, float]
COARSE = 1e-4
"""Flattening of the regions looked at, as a share of the finger's length; they lie inside the true ones."""


@dataclass(frozen=True)
class PreOpening:
    """Openings that catch the whole uncertainty about the nominal place ``at`` (m), and about the best place.

    ``now`` tells whether the case's own opening does so about the nominal place; ``widest`` the opening that allows the
    largest error in every direction.
    """

    at: Pair
    nominal: Openings
    best: Openings
    now: bool
    widest: WidestOpening | None


def pre_opening(
    case: Case, uncertainty: BaseGeometry, at: Pair, model: Model = Model.EXACT, closure: Closure = Closure.FRICTIONAL
) -> PreOpening:
    """Scan the openings of the case's hand; ``uncertainty`` is the set of errors (m) about the nominal place.

    Raises NotCoveredError where no region covers the case.
    """

    @cache
    def region_of(angle: float) -> MultiPolygon:
        opened = case.model_copy(update={"hand": case.hand.model_copy(update={"open": angle})})
        if model is Model.EXACT:
            return exact_region(opened, closure, COARSE * case.hand.finger_length).centre
        return build_region(opened, model, closure).centre

    limits = case.hand.base_limits
    return PreOpening(
        at,
        openings_at(region_of, limits, uncertainty, at),
        openings_anywhere(region_of, limits, uncertainty),
        fits(region_of(case.hand.open), uncertainty, at),
        widest_opening(region_of, limits),
    )


def tip_gap(hand: Hand, angle: float) -> float:
    """Free distance (m) between the tips of the straight fingers at a base angle (rad); negative once they have passed."""
    return 2.0 * (hand.half_palm + hand.finger_length * cos(angle) - hand.half_thickness)


def time_saved(hand: Hand, angle: float) -> float:
    """Closing time (s) saved by starting at a base angle (rad) instead of the case's opening."""
    return (angle - hand.open) / hand.finger_rate
