"""The touch-down of a case's fingers: how each turns, so as to be slow where the object is expected."""

from __future__ import annotations

from math import isnan

from palmar.errors import NotCoveredError
from palmar.geometry.straight_finger import touching_angle
from palmar.mechanics.impact.collision import rod_inertia
from palmar.mechanics.impact.touch_down_4_3_2 import Row, ramps, together
from palmar.models.case import Case
from palmar.models.hand import Hand
from palmar.models.objects import Disk

PIECES = 8
"""Of constant rate, by which each ramp of a touch-down is stepped."""


def touch_down_programme(case: Case) -> list[Row]:
    """The rates of both base joints; each finger is slow from where it may first touch a disk about the case's start.

    That disk is larger than the object by the behaviour's uncertainty. Raises NotCoveredError for polygons, fingers that
    do not reach, and hands of which no acceleration is known.
    """
    hand, does = case.hand, case.behaviour
    if not isinstance(case.object, Disk):
        raise NotCoveredError('object.shape = "polygon": behaviour "touch_down" is for disks')
    if hand.open > hand.base_limits[1]:
        raise NotCoveredError("hand.open_deg is beyond the base joint's limit")
    apart, acceleration = case.object.radius + hand.half_thickness + does.uncertainty, _acceleration(case)
    both = []
    for side, name in ((1.0, "right"), (-1.0, "left")):
        angle = touching_angle(hand.half_palm, hand.finger_length, apart, side * case.start.at[0], case.start.at[1])
        if isnan(angle):
            angle = _within(case, side * case.start.at[0], apart, name)
        turn = min(max(angle - hand.open, 0.0), hand.base_limits[1] - hand.open)
        both.append(ramps(turn, does.touch_rate, acceleration, hand.finger_rate, PIECES))
    return together(both[0], both[1])


def _within(case: Case, x: float, apart: float, name: str) -> float:
    """The open angle, where the base joint itself lies so near to the object; else there is no touch."""
    hand, y = case.hand, case.start.at[1]
    if (x - hand.half_palm) ** 2 + y * y <= apart * apart:
        return hand.open
    raise NotCoveredError(
        f'behaviour "touch_down": the {name} finger does not reach the object where it is expected, the case\'s start'
    )


def _acceleration(case: Case) -> float:
    """Of a finger (rad/s^2), as the behaviour says or as its motor's torque turns a rod of its mass."""
    hand: Hand = case.hand
    if case.behaviour.finger_acceleration is not None:
        return case.behaviour.finger_acceleration
    if hand.finger_mass is None or hand.finger_torque is None:
        raise NotCoveredError(
            'behaviour "touch_down" needs behaviour.finger_acceleration_deg_s2, or hand.finger_mass_kg with'
            " hand.finger_torque_N_m"
        )
    return hand.finger_torque / rod_inertia(hand.finger_mass, hand.finger_length)
