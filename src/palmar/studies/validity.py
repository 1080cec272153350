"""Numbers beside every region: how nearly the motion is quasi-static, when the object would topple, and what it takes.

Each number comes with the closing rate up to which it stays harmless. The region itself knows neither rate nor mass nor the
table's friction; these tell whether the table, the hand and the pace at hand let it apply.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np
import shapely
from numpy.typing import NDArray

from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.inertia import coasting, drift, inertia_ratio, rate_for
from palmar.mechanics.pushing.toppling import nearest_edge, toppling_height
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.support import SupportKind
from palmar.regions.region import Region
from palmar.studies.pace import Pace, pace
from palmar.studies.pressure_offset import OffsetEffect

SMALL_RATIO, SMALL_SHARE = 0.1, 0.1
"""Quasi-static: inertia at most this share of the table's friction, drift and coasting at most this of the allowed error."""


@dataclass(frozen=True)
class QuasiStatic:
    """Inertia over friction while pushed; coasting and drift (m) against the allowed error (m); finger rates (rad/s).

    ``rate_limit`` is the rate up to which the motion counts as quasi-static, ``drift_rate_limit`` the one at which drift
    and coasting together use up the whole allowed error; inf for never. ``squeeze_speed`` (m/s) is that of a disk
    squeezed by two fingers or onto the palm, which 95% of the starts do not exceed.
    """

    ratio: float
    coasting: float
    drift: float
    allowed: float
    rate: float
    rate_limit: float
    drift_rate_limit: float
    push_speed: float
    squeeze_speed: float

    @property
    def holds(self) -> bool:
        """Whether the motion counts as quasi-static at the case's rate."""
        return self.rate <= self.rate_limit

    @property
    def verdict(self) -> str:
        """In words."""
        if self.holds:
            return "quasi-static"
        if self.rate < self.drift_rate_limit and self.ratio < 1.0:
            return "not quite quasi-static, which costs the edge of the region"
        return "not quasi-static, so the region does not apply"


@dataclass(frozen=True)
class Toppling:
    """Greatest height (m) above the table at which fingers may push, at the case's rate; the tipping edge (m) ahead."""

    edge: float
    height: float


@dataclass(frozen=True)
class Validity:
    """What must hold for the region to apply; ``offset`` only where asked for, ``uncovered`` says why a part is missing.

    A free object neither slides nor topples: both are None. ``alike_at_any_rate``: at rest it fares alike at any rate of
    the fingers, for they keep it.
    """

    quasi_static: QuasiStatic | None
    toppling: Toppling | None
    offset: OffsetEffect | None = None
    uncovered: tuple[str, ...] = ()
    alike_at_any_rate: bool = False


def validity(
    case: Case, region: Region | None, offset: OffsetEffect | None = None, refused: tuple[str, ...] = ()
) -> Validity:
    """The numbers for a case on a table, none for a free object.

    Of numbers given as ranges the worst end, or the middle where none is worst. ``offset`` and
    ``refused`` are what a question about the pressure's centre gave, or why it gave nothing.
    """
    if case.support.kind is SupportKind.FREE:
        return Validity(None, None, offset, refused, case.behaviour.name is not BehaviourName.TOUCH_DOWN)
    table = _limits(case, ("support", "friction"), case.support.friction)
    plain = case.model_copy(update={"ranges": (), "support": case.support.model_copy(update={"friction": table[0]})})
    quasi_static, acceleration, uncovered = None, 0.0, list(refused)
    if not isinstance(plain.object, Disk):
        uncovered.append("how nearly quasi-static the motion is: found for disks only")
    elif region is not None and not region.centre.is_empty:
        try:
            moved = pace(plain, region.centre)
            quasi_static = _quasi_static(plain, plain.object.radius, region, moved)
            acceleration = plain.hand.finger_rate**2 * moved.push_acceleration
        except NotCoveredError as error:
            uncovered.append(f"how nearly quasi-static the motion is: {error}")
    edge = _tipping_edge(plain)
    return Validity(
        quasi_static, Toppling(edge, toppling_height(edge, table[1], acceleration)), offset, tuple(uncovered)
    )


def _quasi_static(case: Case, radius: float, region: Region, moved: Pace) -> QuasiStatic:
    rate, table = case.hand.finger_rate, case.support.friction
    assert region.allowed_error is not None
    allowed = region.allowed_error.radius
    ratio = inertia_ratio(rate, moved.push_acceleration, table)
    coasts = coasting(rate, moved.push_speed, table)
    rho = radius + case.hand.half_thickness
    drifts = drift(rate, edge_contact(case, radius, region), case.hand.finger_length, rho, table)
    # Where nothing holds the object back it glides: no rate is slow enough.
    strayed = coasts + drifts
    limit = (
        0.0
        if strayed == inf
        else min(rate_for(ratio, SMALL_RATIO, rate), rate_for(strayed, SMALL_SHARE * allowed, rate))
    )
    end = 0.0 if strayed == inf else rate_for(strayed, allowed, rate)
    speeds = rate * moved.push_speed, rate * moved.squeeze_speed
    return QuasiStatic(ratio, coasts, drifts, allowed, rate, limit, end, *speeds)


def edge_contact(case: Case, radius: float, region: Region) -> float:
    """Where on the open finger (m from its joint) the outermost caught disk was touched, or would have been.

    A disk first touched at psi and r would, at rho per radian, have been at r - rho (psi - psi0) on the open finger.
    """
    hand = case.hand
    rho, length = radius + hand.half_thickness, hand.finger_length
    points = shapely.get_coordinates(region.centre.boundary)
    points = points[points[:, 0] >= 0.0]
    away = points - (hand.half_palm, 0.0)
    reach = np.hypot(away[:, 0], away[:, 1])
    along = np.sqrt(np.maximum(reach**2 - rho**2, 0.0))
    on_link = (along > 0.0) & (along <= length)
    if not on_link.any():
        return length
    psi = np.arctan2(away[on_link, 1], away[on_link, 0]) - np.arcsin(rho / reach[on_link])
    began: NDArray[np.float64] = along[on_link] - rho * np.maximum(psi - hand.open, 0.0)
    return float(np.clip(began.max(), 0.0, length))


def _tipping_edge(case: Case) -> float:
    """Least distance (m) from the centre of pressure to the edge of the base, in the worst direction."""
    x, y = case.support.pressure_centre
    if isinstance(case.object, Disk):
        return max(case.object.radius - float(np.hypot(x, y)), 0.0)
    from palmar.geometry.polygon import area_centroid

    middle = area_centroid(case.object.vertices)
    return max(nearest_edge(case.object.vertices, (middle[0] + x, middle[1] + y)), 0.0)


def _limits(case: Case, place: tuple[str, str], value: float) -> tuple[float, float]:
    known = [each for each in case.ranges if each.place == place]
    return (known[0].low, known[0].high) if known else (value, value)
