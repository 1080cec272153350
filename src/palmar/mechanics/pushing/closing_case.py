"""A case's hand and support as the closing kernels take them."""

from __future__ import annotations

from math import pi

from palmar.geometry.straight_finger import last_angle
from palmar.mechanics.pushing.closing_tables import ClosingHand
from palmar.mechanics.pushing.limit_surface import LimitSurface, disk_surface, sampled_surface
from palmar.mechanics.pushing.pressure_cells import PRESSURE_EXPONENT, disk_cells
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import Disk
from palmar.models.support import Pressure, Support


def closing_hand(hand: Hand, radius: float, friction: float) -> ClosingHand:
    """The straight-fingered hand as the kernel takes it, closing until palm, other finger or joint limit end it."""
    crossing = hand.fingers is Fingers.CROSSING
    h = hand.half_thickness
    last = float(last_angle(hand.half_palm, hand.finger_length, h, crossing, hand.base_limits[1]))
    return ClosingHand(hand.half_palm, hand.finger_length, h, radius, friction, hand.open, min(last, pi))


def pressure_surface(disk: Disk, support: Support) -> LimitSurface:
    """The limit surface of a disk under the support's pressure distribution."""
    if support.pressure is Pressure.UNIFORM:
        return disk_surface(disk.radius)
    return sampled_surface(disk_cells(disk.radius, PRESSURE_EXPONENT[support.pressure]))
