"""What bits and final joint angles say about the grasp, without any look at the object."""

from __future__ import annotations

from enum import Enum

from palmar.behaviours.sensor_places import SensorPlaces
from palmar.models.motion import Observation

AT_END = 1e-3
"""A base joint within this (rad) of its last angle has reached it."""


class Verdict(Enum):
    """What the hand may say of itself."""

    CAUGHT = "caught"
    """A finger is held up before its last angle, and two of palm and fingers feel something: it is between them."""
    MISSED = "missed"
    """Both fingers are at their last angle, nothing is felt, and fingers so closed leave no room for an object."""
    UNKNOWN = "unknown"
    """Anything else."""


def verdict(seen: Observation, places: SensorPlaces, last: float, roomy: bool) -> Verdict:
    """Judge the last observation of a closing motion.

    ``last`` (rad) is the base angle at which an empty hand ends; ``roomy`` whether an object may then be inside all the
    same, as between fingers that meet. A jam can pass for a catch: bits do not tell forces.
    """
    ended = all(joints[0] >= last - AT_END for joints in (seen.right, seen.left))
    held_up = any(
        stalled and joints[0] < last - AT_END
        for stalled, joints in zip(seen.stalled, (seen.right, seen.left), strict=True)
    )
    if held_up and places.bodies_felt(seen) >= 2:
        return Verdict.CAUGHT
    if ended and not roomy and not any(seen.bits):
        return Verdict.MISSED
    return Verdict.UNKNOWN
