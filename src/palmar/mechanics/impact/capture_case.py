"""A case's hand and disk as the capture kernel takes them: straight fingers, closing alike from the open angle."""

from __future__ import annotations

from math import inf

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture_hand import closing_hand
from palmar.mechanics.impact.collision import ImpactLaw, rod_inertia
from palmar.mechanics.impact.finger_motion import CaptureHand
from palmar.models.case import Case
from palmar.models.hand import Fingers
from palmar.models.objects import Disk
from palmar.models.support import SupportKind


def capture_hand_of(case: Case) -> CaptureHand:
    """For the capture kernel; raises NotCoveredError for objects on a table, polygons and ranges.

    Several links are kept straight, so they count as one.
    """
    if case.support.kind is not SupportKind.FREE:
        raise NotCoveredError('support.kind = "table": this is for objects in free space')
    if not isinstance(case.object, Disk):
        raise NotCoveredError('object.shape = "polygon": in free space only disks are simulated')
    hand = case.hand
    return closing_hand(
        hand.half_palm, [hand.finger_length], case.object.radius, hand.half_thickness, first=hand.open,
        rate=hand.finger_rate, limit=hand.base_limits[1], colliding=hand.fingers is Fingers.COLLIDING,
    )  # fmt: skip


def impact_law_of(case: Case) -> ImpactLaw:
    """Mass, finger inertia (a uniform rod), its motor's torque (none: it restores the rate at once) and friction.

    Raises NotCoveredError for slowed fingers that cannot pass each other.
    """
    hand = case.hand
    inertia = inf if hand.finger_mass is None else rod_inertia(hand.finger_mass, hand.finger_length)
    torque = inf if hand.finger_torque is None else hand.finger_torque
    if torque < inf and hand.fingers is Fingers.COLLIDING:
        raise NotCoveredError(
            'hand.finger_torque_N_m: slowed fingers are only simulated with hand.fingers = "crossing"'
        )
    return ImpactLaw(case.object.mass, inertia, torque, case.contact.friction)
