"""A finger of the Salisbury hand: where its tip is, and which tensions of its four tendons make its joint torques.

N joints are pulled by N + 1 tendons, because a tendon cannot push. The torques fix the tensions up to one number, the
internal tension; it is chosen so that the slackest tendon has the pretension.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from palmar.models.salisbury_hand import Curl, SalisburyHand

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
    tip: Floats = chain_in_hand(hand, finger, joints)[..., 2, :]
    return tip


def chain_in_hand(hand: SalisburyHand, finger: int, joints: Floats) -> Floats:
    """Base, knuckle and tip's centre (…, 3, 3) in m of a finger in the hand frame at joint angles (…, 3) in rad."""
    joints = np.asarray(joints, float)
    swing, first, both = joints[..., 0], joints[..., 1], joints[..., 1] + joints[..., 2]
    (near, far), none = hand.links, np.zeros_like(first)
    inward = np.stack([none, near * np.sin(first), near * np.sin(first) + far * np.sin(both)], axis=-1)
    up = np.stack([none, near * np.cos(first), near * np.cos(first) + far * np.cos(both)], axis=-1)
    radial, side, height = hand.base_circle - inward, -up * np.sin(swing)[..., None], up * np.cos(swing)[..., None]
    cosine, sine = np.cos(hand.bases[finger]), np.sin(hand.bases[finger])
    return np.stack([cosine * radial - sine * side, sine * radial + cosine * side, height], axis=-1)


def meeting_curl(hand: SalisburyHand, curl: Curl, radius: float, clearance: float) -> float:
    """The curl (rad) up to which closing fingers stay ``clearance`` (m) off a cylinder that lies across the palm.

    Its axis is parallel to the hand's x, over the grasp line, its ``radius`` (m) above the palm's face. Seen along the axis
    each link is a segment in the (y, z) plane, so its distance from the axis is that of a segment from a point, whatever
    the finger's plane. Curls are looked through in steps of 5e-3 rad, from open to the joint's limit.
    """
    curls = np.arange(curl.opened, hand.joint_limits[1][1], 5e-3)
    chains = np.stack([chain_in_hand(hand, k, curl.joints(curls)) for k in range(3)])[..., 1:]
    start, along = chains[:, :, :-1] - (hand.grasp_line, radius), np.diff(chains, axis=2)
    share = np.clip(-(start * along).sum(axis=-1) / (along**2).sum(axis=-1), 0.0, 1.0)
    apart = np.linalg.norm(start + share[..., None] * along, axis=-1)
    sizes = hand.link_radius, max(hand.link_radius, hand.tip_radius)
    meets = (apart - sizes < radius + clearance).any(axis=(0, 2))
    return float(curls[max(int(np.argmax(meets)) - 1, 0)] if meets.any() else curls[-1])
