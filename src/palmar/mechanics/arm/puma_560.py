"""The Puma 560: forward kinematics, all closed-form inverses, Jacobian, and which places of the hand it can serve.

Standard Denavit-Hartenberg parameters, A_i = Rot_z(q_i) Trans(a_i, 0, d_i) Rot_x(alpha_i); lengths of the robotics toolbox
(Corke and Armstrong-Helouvry 1994, as in its model Puma560). The base frame has its z axis up and its origin at the
shoulder; the last three axes meet in the origin of frame 6.

Joint limits are those that the toolbox's comments give. Its numbers, symmetric about 0 (joints 2, 3, 4: 110, 135, 266 deg),
do not fit its own zero: they exclude its nominal pose, where joint 3 is at 180 deg.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

A = np.array([0.0, 0.4318, 0.0203, 0.0, 0.0, 0.0])
"""Link lengths (m)."""
D = np.array([0.0, 0.0, 0.15005, 0.4318, 0.0, 0.0])
"""Link offsets (m)."""
ALPHA = np.radians([90.0, 0.0, -90.0, 90.0, -90.0, 0.0])
"""Link twists (rad)."""
LOWER = np.radians([-160.0, -45.0, -225.0, -110.0, -100.0, -266.0])
UPPER = np.radians([160.0, 225.0, 45.0, 170.0, 100.0, 266.0])
"""Limits of the joints (rad)."""
STRAIGHT_WRIST = 1e-9
"""Sine of joint 5 below which joints 4 and 6 turn about one axis; joint 4 is then put to 0."""


@dataclass(frozen=True)
class Branches:
    """Joint angles (…, 8, 6) in (-pi, pi] or, where that lies outside the limits, a turn off; and which of the
    eight exist and lie within the limits (…, 8).

    Order: shoulder (2), elbow (2), wrist (2), the last varying fastest.
    """

    joints: Floats
    allowed: Bools


def link_transforms(joints: Floats) -> Floats:
    """Of joint angles (…, 6): A_i as homogeneous matrices (…, 6, 4, 4)."""
    cosine, sine = np.cos(joints), np.sin(joints)
    ca, sa = np.round(np.cos(ALPHA), 15), np.round(np.sin(ALPHA), 15)
    out = np.zeros((*joints.shape, 4, 4))
    out[..., 0, 0], out[..., 0, 1], out[..., 0, 2], out[..., 0, 3] = cosine, -sine * ca, sine * sa, A * cosine
    out[..., 1, 0], out[..., 1, 1], out[..., 1, 2], out[..., 1, 3] = sine, cosine * ca, -cosine * sa, A * sine
    out[..., 2, 1], out[..., 2, 2], out[..., 2, 3] = sa, ca, D
    out[..., 3, 3] = 1.0
    return out


def forward(joints: Floats) -> Floats:
    """Pose of frame 6 in the base (…, 4, 4) at joint angles (…, 6) in rad."""
    links = link_transforms(np.asarray(joints, float))
    pose = links[..., 0, :, :]
    for i in range(1, 6):
        pose = pose @ links[..., i, :, :]
    return pose


def jacobian(joints: Floats) -> Floats:
    """Of frame 6 in the base (…, 6, 6): rows are velocity (m) and angular velocity (rad) per joint rate.

    Column i is (z_{i-1} x (p - o_{i-1}), z_{i-1}).
    """
    joints = np.asarray(joints, float)
    links, end = link_transforms(joints), forward(joints)[..., :3, 3]
    frame = np.broadcast_to(np.eye(4), (*joints.shape[:-1], 4, 4))
    columns = []
    for i in range(6):
        axis, origin = frame[..., :3, 2], frame[..., :3, 3]
        columns.append(np.concatenate([np.cross(axis, end - origin), axis], axis=-1))
        frame = frame @ links[..., i, :, :]
    return np.stack(columns, axis=-1)


def inverse(pose: Floats) -> Branches:
    """All joint angles that put frame 6 at poses (…, 4, 4).

    The wrist centre (X, -d3, Y) after joint 1 has X^2 = x^2 + y^2 - d3^2; the elbow follows from
    a3 cos q3 - d4 sin q3 = (X^2 + Y^2 - a2^2 - a3^2 - d4^2) / (2 a2); the wrist is Rot_z(q4) Rot_y(-q5) Rot_z(q6).
    """
    pose = np.asarray(pose, float)
    place, signs = pose[..., :3, 3], np.array([1.0, -1.0])
    x, y, z = (place[..., k, None, None] for k in range(3))
    square = x**2 + y**2 - D[2] ** 2
    out = np.sqrt(np.maximum(square, 0.0)) * signs[:, None]
    first = np.arctan2(y, x) - np.arctan2(-D[2], out)
    reach, lag = np.hypot(A[2], D[3]), np.arctan2(D[3], A[2])
    share = (out**2 + z**2 - A[1] ** 2 - reach**2) / (2.0 * A[1] * reach)
    third = np.arccos(np.clip(share, -1.0, 1.0)) * signs - lag
    cosine, sine = np.cos(third), np.sin(third)
    along, across = A[1] + A[2] * cosine - D[3] * sine, A[2] * sine + D[3] * cosine
    second = np.arctan2(z, out) - np.arctan2(across, along)
    exists = (square >= 0.0) & (np.abs(share) <= 1.0)
    arms = np.stack(np.broadcast_arrays(first, second, third), axis=-1)
    wrists = _wrist(arms, pose[..., None, None, :3, :3])
    whole = np.concatenate([np.broadcast_to(arms[..., None, :], wrists.shape), wrists], axis=-1)
    joints = np.pi - np.mod(np.pi - whole.reshape(*place.shape[:-1], 8, 6), 2.0 * np.pi)
    joints = joints + 2.0 * np.pi * ((joints < LOWER) * 1.0 - (joints > UPPER))
    reached = np.broadcast_to(exists[..., None], wrists.shape[:-1]).reshape(*place.shape[:-1], 8)
    return Branches(joints, reached & _within(joints).all(axis=-1))


def _within(joints: Floats) -> Bools:
    return (joints >= LOWER) & (joints <= UPPER)


def _wrist(arms: Floats, turn: Floats) -> Floats:
    """Both wrists (…, 2, 3) that turn frame 3, at arm angles (…, 3), to rotations (…, 3, 3)."""
    links = link_transforms(np.concatenate([arms, np.zeros_like(arms)], axis=-1))[..., :3, :3]
    third = links[..., 0, :, :] @ links[..., 1, :, :] @ links[..., 2, :, :]
    rest = np.swapaxes(third, -1, -2) @ turn
    sine = np.hypot(rest[..., 0, 2], rest[..., 1, 2])
    straight = sine < STRAIGHT_WRIST
    wrists = []
    for sign in (1.0, -1.0):
        fourth = np.arctan2(-sign * rest[..., 1, 2], -sign * rest[..., 0, 2])
        fifth = np.arctan2(sign * sine, rest[..., 2, 2])
        sixth = np.arctan2(-sign * rest[..., 2, 1], sign * rest[..., 2, 0])
        alone = np.arctan2(rest[..., 1, 0], rest[..., 0, 0])
        wrists.append(np.stack([np.where(straight, 0.0, fourth), fifth, np.where(straight, alone, sixth)], axis=-1))
    return np.stack(wrists, axis=-2)


def nearest(pose: Floats, joints: Floats) -> Floats | None:
    """The allowed inverse of one pose (4, 4) nearest to joint angles (6,), whole turns included; None without any."""
    found = inverse(pose)
    if not found.allowed.any():
        return None
    candidates = found.joints[found.allowed]
    turns = 2.0 * np.pi * np.round((joints - candidates) / (2.0 * np.pi))
    turned = np.where(_within(candidates + turns), candidates + turns, candidates)
    best: Floats = turned[np.abs(turned - joints).max(axis=-1).argmin()]
    return best


def reachable(hand_poses: Floats, hand_in_flange: Floats | None = None) -> Bools:
    """Which hand poses (…, 4, 4) in the base some allowed joint angles reach; ``hand_in_flange`` (4, 4) mounts the hand."""
    mount = np.eye(4) if hand_in_flange is None else hand_in_flange
    reached: Bools = np.asarray(inverse(np.asarray(hand_poses, float) @ np.linalg.inv(mount)).allowed.any(axis=-1))
    return reached
