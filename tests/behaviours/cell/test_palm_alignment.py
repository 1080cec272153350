"""Turning about the contact: it stays where it is, and the other side comes forward until it touches."""

import numpy as np
import pytest

from palmar.behaviours.cell.palm_alignment import aligned
from palmar.models.salisbury_hand import SalisburyHand

HAND = SalisburyHand()


def place(pose: np.ndarray, k: int) -> np.ndarray:
    """Of sensor k."""
    return (pose @ np.array([(1.0, -1.0)[k] * HAND.pad_offset, HAND.grasp_line, 0.0, 1.0]))[:3]


@pytest.mark.parametrize("k", [0, 1])
def test_the_contact_stays_and_the_other_side_comes_forward(k):
    pose = np.eye(4)
    turned = aligned(pose, (k == 0, k == 1), HAND, 0.1)
    assert place(turned, k) == pytest.approx(place(pose, k), abs=1e-15)
    assert place(turned, 1 - k)[2] == pytest.approx(2.0 * HAND.pad_offset * np.sin(0.1))
    assert turned[:3, :3] @ turned[:3, :3].T == pytest.approx(np.eye(3), abs=1e-15)


@pytest.mark.parametrize("tilt", [-0.3, -0.02, 0.05, 0.25])
def test_it_ends_square_to_a_plane_from_any_tilt(tilt):
    """A wall at z = 0 felt by whichever sensor is farther ahead."""
    cosine, sine = np.cos(tilt), np.sin(tilt)
    pose = np.eye(4)
    pose[:3, :3] = [[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]]
    pose[2, 3] = -max(place(pose, k)[2] for k in (0, 1))
    for _ in range(400):
        bits = tuple(bool(place(pose, k)[2] > -2e-5) for k in (0, 1))
        if all(bits):
            break
        pose = aligned(pose, bits, HAND, 1e-3)
    assert all(bits)
    assert abs(np.arctan2(pose[0, 2], pose[2, 2])) < 2e-3


def test_both_or_neither_leave_it():
    for bits in ((True, True), (False, False)):
        assert aligned(np.eye(4), bits, HAND, 0.1) == pytest.approx(np.eye(4))
