"""Where a closing finger first meets a disk at rest, and whether the disk lies clear of the open hand."""

from __future__ import annotations

from math import acos, asin, atan2, cos, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_tables import ClosingHand

Floats = NDArray[np.float64]
TOUCHING = 1e-9
"""Overlaps at the start below this part of the radius count as touching."""


@compiled
def first_touch(d: float, length: float, rho: float, x: float, y: float) -> tuple[float, float]:
    """(psi, r) at which the finger of base (d, 0) first meets a disk at rest at (x, y); r > length on the tip, NaN never."""
    square = (x - d) * (x - d) + y * y
    reach = sqrt(square)
    if reach <= rho or reach > length + rho:
        return np.nan, np.nan
    bearing, along = atan2(y, x - d), sqrt(square - rho * rho)
    if along <= length:
        return bearing - asin(rho / reach), along
    return bearing - acos((length * length + square - rho * rho) / (2.0 * length * reach)), along


@compiled
def overlaps(hand: ClosingHand, x: float, y: float) -> bool:
    """Whether a disk at (x, y) overlaps the palm or either open finger."""
    d, slack = hand.half_palm, hand.radius * TOUCHING
    beside = max(abs(x) - d, 0.0)
    clear = hand.radius - slack
    if beside * beside + y * y < clear * clear:
        return True
    c, s, clear = cos(hand.first), sin(hand.first), clear + hand.half_thickness
    for side in (1.0, -1.0):
        px = side * x - d
        along = min(max(px * c + y * s, 0.0), hand.length)
        px, py = px - along * c, y - along * s
        if px * px + py * py < clear * clear:
            return True
    return False


@compiled
def first_contacts(hand: ClosingHand, centres: Floats, points: Floats) -> None:
    """Where the right finger first touches a disk at each centre (N, 2), into ``points`` (N, 2); NaN never."""
    rho = hand.radius + hand.half_thickness
    for k in range(len(centres)):
        x, y = centres[k, 0], centres[k, 1]
        psi, along = first_touch(hand.half_palm, hand.length, rho, x, y)
        reach = min(along, hand.length)
        foot_x, foot_y = hand.half_palm + reach * cos(psi), reach * sin(psi)
        share = hand.half_thickness / rho
        points[k, 0], points[k, 1] = foot_x + share * (x - foot_x), foot_y + share * (y - foot_y)
