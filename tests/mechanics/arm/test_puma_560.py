"""The Puma's kinematics: published poses, invariants, and finite differences."""

import numpy as np
import pytest

from palmar.mechanics.arm.puma_560 import LOWER, UPPER, D, forward, inverse, jacobian, nearest, reachable

RANDOM = np.random.default_rng(5)
JOINTS = RANDOM.uniform(LOWER, UPPER, (10_000, 6))


def test_the_toolbox_prints_these_poses():
    """Of the robotics toolbox: the nominal pose qn, (0, 45 deg, 180 deg, 0, 45 deg, 0); and all zero."""
    nominal = forward(np.radians([0.0, 45.0, 180.0, 0.0, 45.0, 0.0]))
    assert nominal[:3, 3] == pytest.approx([0.5963, -0.1501, -0.01435], abs=1e-4)
    assert nominal[:3, :3] == pytest.approx(np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]), abs=1e-12)
    assert forward(np.zeros(6))[:3, 3] == pytest.approx([0.4521, -0.15005, 0.4318], abs=1e-12)


def test_poses_are_rigid_and_within_the_reach():
    poses = forward(JOINTS)
    assert np.abs(np.swapaxes(poses[:, :3, :3], 1, 2) @ poses[:, :3, :3] - np.eye(3)).max() < 1e-12
    assert np.hypot(0.8641, D[2]) >= np.linalg.norm(poses[:, :3, 3], axis=1).max() - 2e-4


def test_every_inverse_leads_back_and_one_of_them_is_the_start():
    poses = forward(JOINTS)
    found = inverse(poses)
    back = forward(found.joints[found.allowed])
    owner = np.broadcast_to(np.arange(len(JOINTS))[:, None], found.allowed.shape)[found.allowed]
    assert np.abs(back - poses[owner]).max() < 1e-9
    apart = np.abs(np.angle(np.exp(1j * (found.joints - JOINTS[:, None])))).max(axis=-1)
    assert apart.min(axis=1).max() < 1e-6
    assert found.allowed[np.arange(len(JOINTS)), apart.argmin(axis=1)].all()
    assert reachable(poses).sum() == found.allowed.any(axis=1).sum()


def test_a_straight_wrist_has_an_inverse():
    joints = np.radians([20.0, 30.0, -100.0, 40.0, 0.0, 10.0])
    found = nearest(forward(joints), joints)
    assert found is not None
    assert forward(found) == pytest.approx(forward(joints), abs=1e-9)


def test_the_nearest_inverse_keeps_whole_turns():
    joints = np.radians([20.0, 30.0, -100.0, 160.0, 40.0, -250.0])
    assert nearest(forward(joints), joints + 0.01) == pytest.approx(joints, abs=1e-9)


def test_the_limits_hold_the_toolbox_s_nominal_pose():
    nominal = forward(np.radians([0.0, 45.0, 180.0, 0.0, 45.0, 0.0]))
    assert nearest(nominal, np.radians([0.0, 45.0, -180.0, 0.0, 45.0, 0.0])) == pytest.approx(
        np.radians([0.0, 45.0, -180.0, 0.0, 45.0, 0.0]), abs=1e-9
    )


def test_what_is_out_of_reach_has_no_inverse():
    far = np.eye(4)
    far[:3, 3] = [0.9, 0.0, 0.0]
    assert nearest(far, np.zeros(6)) is None
    assert not reachable(far[None]).any()


def test_the_jacobian_is_the_derivative():
    joints, step = JOINTS[:200], 1e-6
    analytic = jacobian(joints)
    for k in range(6):
        ahead, behind = forward(joints + step * np.eye(6)[k]), forward(joints - step * np.eye(6)[k])
        assert np.abs((ahead - behind)[:, :3, 3] / (2 * step) - analytic[:, :3, k]).max() < 1e-8
        spin = (ahead - behind)[:, :3, :3] / (2 * step) @ np.swapaxes(forward(joints)[:, :3, :3], 1, 2)
        assert np.abs(np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], -1) - analytic[:, 3:, k]).max() < 1e-8
