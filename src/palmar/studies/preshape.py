"""Preshapes of the distal joint that theory gives for a case: no rolling on a table, no sliding in free space."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.centrifugal_5_3_1 import centrifugal_angles
from palmar.mechanics.pushing.limit_surface import LimitSurface
from palmar.mechanics.pushing.preshape_5_2 import (
    Ride,
    RidingDisk,
    RidingFinger,
    disc_radius,
    preshape,
)
from palmar.mechanics.pushing.pressure_cells import PRESSURE_EXPONENT
from palmar.mechanics.pushing.slider import disk_slider
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.support import Pressure, SupportKind

PLACES = (0.25, 0.5, 1.0)
"""Of the contact on the distal link, as parts of it."""
OFFSET = 0.05
"""Of the pressure's centre, in radii, for the sensitivity to it."""


@dataclass(frozen=True)
class Preshapes:
    """What theory says of the distal joint's angle.

    ``tip``: the ride at the tip under the case's own pressure, ``places`` along the link; ``by_pressure``: at the tip,
    under named pressures and a thin ring; ``by_offset``: least and largest angle (rad) as the pressure's centre moves by
    ``OFFSET`` radii; ``disc``: the radius (m) of the source's contact region. None where there is none. Tables only.
    ``centrifugal``: least and largest angle (rad) that balance the centrifugal force, the disk clear of the proximal link.
    """

    tip: Ride | None
    places: tuple[tuple[float, Ride | None], ...]
    by_pressure: tuple[tuple[str, Ride | None], ...]
    by_offset: tuple[float, float] | None
    disc: float | None
    centrifugal: tuple[float, float] | None


def preshapes(case: Case) -> Preshapes:
    """For a disk before fingers of two links; raises NotCoveredError for others, and for ranges."""
    if len(case.hand.finger_links) != 2 or not isinstance(case.object, Disk) or case.ranges:
        raise NotCoveredError("preshapes are for disks, fingers of two links, and plain numbers")
    proximal, distal = case.hand.finger_links
    radius, h = case.object.radius, case.hand.half_thickness
    if case.support.kind is SupportKind.FREE:
        return Preshapes(None, (), (), None, None, centrifugal_angles(proximal, distal, radius, h))
    finger = RidingFinger(proximal, h)
    own = RidingDisk(radius, _surface(radius, PRESSURE_EXPONENT[case.support.pressure]))
    tip = preshape(finger, own, distal)
    named = [(each.value, PRESSURE_EXPONENT[each]) for each in Pressure] + [("thin ring", inf)]
    return Preshapes(
        tip,
        tuple((part, preshape(finger, own, part * distal)) for part in PLACES),
        tuple((name, preshape(finger, RidingDisk(radius, _surface(radius, e)), distal)) for name, e in named),
        _by_offset(finger, radius, PRESSURE_EXPONENT[case.support.pressure], distal),
        None if tip is None else disc_radius(proximal, distal, tip.angle),
        None,
    )


def _surface(radius: float, exponent: float) -> LimitSurface:
    return disk_slider(radius, exponent).surface


def _by_offset(finger: RidingFinger, radius: float, exponent: float, distal: float) -> tuple[float, float] | None:
    """Least and largest angle over four ways in which the pressure's centre may be off."""
    angles = []
    for x, y in ((OFFSET, 0.0), (-OFFSET, 0.0), (0.0, OFFSET), (0.0, -OFFSET)):
        offset = x * radius, y * radius
        found = preshape(finger, RidingDisk(radius, disk_slider(radius, exponent, offset).surface, offset), distal)
        if found is None:
            return None
        angles.append(found.angle)
    return min(angles), max(angles)
