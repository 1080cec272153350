"""What a case's behaviour does with the second joint of each finger, within that joint's limits."""

from __future__ import annotations

from math import degrees, pi

from palmar.errors import NotCoveredError
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.hand import Hand

JOINTED_CLOSING = (BehaviourName.CURL_AND_CLOSE, BehaviourName.CLOSE_COUPLED)
"""Motions of two joints a finger that need no sensor."""


def check_two_links(case: Case) -> None:
    """Raises NotCoveredError for fingers without exactly two links."""
    links = len(case.hand.finger_links)
    if links != 2:
        raise NotCoveredError(f'behaviour "{case.behaviour.name.value}" is for fingers of two links, not {links}')


def distal_limit(hand: Hand) -> float:
    """The largest angle (rad) of the distal joint; half a turn, where the links lie on each other, without a limit."""
    return pi if hand.joint_limits is None else min(hand.joint_limits[1][1], pi)


def curl_of(case: Case) -> float:
    """The preshape angle (rad) of a case; raises NotCoveredError where the distal joint does not go so far."""
    check_two_links(case)
    angle, most = case.behaviour.preshape, distal_limit(case.hand)
    if angle > most:
        raise NotCoveredError(
            f"behaviour.preshape_deg = {degrees(angle):.4g}: the distal joint goes to {degrees(most):.4g}"
        )
    return angle


def coupled_limit(case: Case) -> float:
    """The base angle (rad) at which one joint of a coupled finger is at its end, and with it the motion."""
    check_two_links(case)
    hand, ratio, bend = case.hand, case.behaviour.ratio, case.behaviour.bend
    low = -pi if hand.joint_limits is None else max(hand.joint_limits[1][0], -pi)
    most = hand.base_limits[1]
    if ratio == 0.0:
        return most
    return min(most, hand.open + ((distal_limit(hand) if ratio > 0.0 else low) - bend) / ratio)
