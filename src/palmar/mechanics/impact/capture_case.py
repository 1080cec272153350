"""A case's hand and disk as the capture kernel takes them: both fingers move alike from the open angle."""

from __future__ import annotations

from math import inf

import numpy as np

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture_hand import closing_hand, programmed_hand
from palmar.mechanics.impact.collision import ImpactLaw, rod_inertia
from palmar.mechanics.impact.finger_motion import CaptureHand
from palmar.mechanics.impact.touch_down_case import touch_down_programme
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.hand import Fingers
from palmar.models.jointed_motion import JOINTED_CLOSING, coupled_limit, curl_of
from palmar.models.objects import Disk
from palmar.models.support import SupportKind


def capture_hand_of(case: Case) -> CaptureHand:
    """For the capture kernel; raises NotCoveredError for objects on a table, polygons and ranges.

    Several links are kept straight, so they count as one, unless the behaviour curls or couples the distal joints.
    """
    if case.support.kind is not SupportKind.FREE:
        raise NotCoveredError('support.kind = "table": this is for objects in free space')
    if not isinstance(case.object, Disk):
        raise NotCoveredError('object.shape = "polygon": in free space only disks are simulated')
    hand = case.hand
    if case.behaviour.name in JOINTED_CLOSING:
        return _jointed(case, case.object.radius)
    if case.behaviour.name is BehaviourName.TOUCH_DOWN:
        return _touching_down(case, case.object.radius)
    return closing_hand(
        hand.half_palm, [hand.finger_length], case.object.radius, hand.half_thickness, first=hand.open,
        rate=hand.finger_rate, limit=hand.base_limits[1], colliding=hand.fingers is Fingers.COLLIDING,
    )  # fmt: skip


def _jointed(case: Case, radius: float) -> CaptureHand:
    hand, does, colliding = case.hand, case.behaviour, case.hand.fingers is Fingers.COLLIDING
    if hand.finger_mass is not None:
        raise NotCoveredError(
            "hand.finger_mass_kg: fingers whose distal joints move are taken as heavy, without a mass"
        )
    if does.name is BehaviourName.CLOSE_COUPLED:
        return closing_hand(
            hand.half_palm, hand.finger_links, radius, hand.half_thickness, first=hand.open, rate=hand.finger_rate,
            limit=coupled_limit(case), offsets=[does.bend], ratios=[does.ratio], colliding=colliding,
        )  # fmt: skip
    bend, rate = curl_of(case), hand.finger_rate
    programme = [(bend / rate, np.array([[0.0, rate]] * 2)), (inf, np.array([[rate, 0.0]] * 2))]
    return programmed_hand(
        hand.half_palm, hand.finger_links, radius, hand.half_thickness, np.array([[hand.open, 0.0]] * 2),
        programme if bend > 0.0 else programme[1:], limit=hand.base_limits[1], colliding=colliding,
    )  # fmt: skip


def _touching_down(case: Case, radius: float) -> CaptureHand:
    hand = case.hand
    programme = [(duration, np.array(rates)[:, None]) for duration, rates in touch_down_programme(case)]
    return programmed_hand(
        hand.half_palm, [hand.finger_length], radius, hand.half_thickness, np.full((2, 1), hand.open), programme,
        limit=hand.base_limits[1], colliding=hand.fingers is Fingers.COLLIDING,
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
