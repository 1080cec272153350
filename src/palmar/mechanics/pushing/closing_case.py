"""A case's hand as the closing kernels take it: straight fingers, both from the open angle to the end of their travel."""

from __future__ import annotations

from palmar.geometry.straight_finger import last_angle
from palmar.mechanics.pushing.closing_tables import ClosingHand
from palmar.mechanics.pushing.hand_pose import HandMotion, hand_motion
from palmar.models.hand import Fingers, Hand


def closing_hand(hand: Hand, radius: float, friction: float) -> ClosingHand:
    """For the event-to-event kernel, with the disk's radius (m) and the friction."""
    crossing = hand.fingers is Fingers.CROSSING
    h = hand.half_thickness
    alone, met = (
        float(last_angle(hand.half_palm, hand.finger_length, h, passes, hand.base_limits[1]))
        for passes in (True, False)
    )
    ends = (alone, 0.0) if crossing else (met, alone)
    return ClosingHand(hand.half_palm, hand.finger_length, h, radius, friction, hand.open, *ends)


def straight_motion(hand: Hand, wall: float | None = None) -> HandMotion:
    """For the stepping kernel; ``wall`` (m) is that of the case's support."""
    motion = hand_motion(
        hand.half_palm,
        [hand.finger_length],
        hand.half_thickness,
        first=hand.open,
        limit=hand.base_limits[1],
        colliding=hand.fingers is Fingers.COLLIDING,
    )
    return motion if wall is None else motion._replace(wall=wall)
