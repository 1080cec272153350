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
    """Mass, finger inertia (a uniform rod, its rate restored at once by the motor) and friction of the case's impacts."""
    mass = case.hand.finger_mass
    inertia = inf if mass is None else rod_inertia(mass, case.hand.finger_length)
    return ImpactLaw(case.object.mass, inertia, inf, case.contact.friction)
