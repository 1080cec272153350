"""A finger of the Salisbury hand: where its tip is, and which tensions of its four tendons make its joint torques.

N joints are pulled by N + 1 tendons, because a tendon cannot push. The torques fix the tensions up to one number, the
internal tension; it is chosen so that the slackest tendon has the pretension.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from palmar.models.salisbury_hand import SalisburyHand

Floats = NDArray[np.float64]


def joint_torques(hand: SalisburyHand, tensions: Floats) -> Floats:
    """Torques (…, 3) in N m of tensions (…, 4) in N: tau = R T (patent US 4921293)."""
    return np.asarray(tensions, float) @ hand.tendon_matrix.T


@lru_cache
def internal(hand: SalisburyHand) -> Floats:
    """Tensions (4,) that make no torque: (R2/R1, 1, 1, R2/R1), all positive."""
    share = hand.radii[1] / hand.radii[0]
    return np.array([share, 1.0, 1.0, share])


def tensions(hand: SalisburyHand, torques: Floats) -> Floats:
    """The least tensions (…, 4) in N, none below the pretension, that make torques (…, 3) in N m.

    T2 - T3 = tau3 / R2, T1 - T4 = (tau2 - tau3) / R3, R2 (T2 + T3) - R1 (T1 + T4) = tau1; then as much of the internal
    tension as the slackest tendon needs.
    """
    some, none = np.asarray(torques, float) @ _differences(hand), internal(hand)
    needed = ((hand.tension_least - some) / none).max(axis=-1, keepdims=True)
    whole: Floats = some + needed * none
    return whole


@lru_cache
def _differences(hand: SalisburyHand) -> Floats:
    """(3, 4): torques times this are tensions of either sign that make them."""
    two, three = 0.5 / hand.radii[1], 0.5 / hand.radii[2]
    return np.array([[0.0, two, two, 0.0], [three, 0.0, 0.0, -three], [-three, two, -two, three]])


def tip_in_hand(hand: SalisburyHand, finger: int, joints: Floats) -> Floats:
    """Centre (…, 3) in m of a finger's tip in the hand frame at joint angles (…, 3) in rad."""
    joints = np.asarray(joints, float)
    swing, first, both = joints[..., 0], joints[..., 1], joints[..., 1] + joints[..., 2]
    near, far = hand.links
    inward, up = near * np.sin(first) + far * np.sin(both), near * np.cos(first) + far * np.cos(both)
    radial, side, height = hand.base_circle - inward, -up * np.sin(swing), up * np.cos(swing)
    cosine, sine = np.cos(hand.bases[finger]), np.sin(hand.bases[finger])
    return np.stack([cosine * radial - sine * side, sine * radial + cosine * side, height], axis=-1)
