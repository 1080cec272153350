"""The brute-force decision, in configurations that can be argued by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from .disk_holding import holds_structurally, holds_with_friction
from .limits import scan_limits

HAIR = 1e-9


@pytest.mark.parametrize("half_thickness", [0.0, 0.1])
def test_upright_finger_touches_the_equator(half_thickness: float) -> None:
    # The finger's surface stands 0.5 from the axis: any larger disk on the palm pushes it open beyond the
    # normal.
    radius = np.array([0.1, 0.5 - HAIR, 0.5, 0.5 + HAIR])
    held = holds_structurally(radius, 0.5 + half_thickness, 1.0, half_thickness)
    assert held.tolist() == [True, True, True, False]


def test_tip_on_the_equator() -> None:
    # Fingers of length 5 from (7, 0): the tip of direction (-3, 4) is at (4, 4), on the equator of the disk
    # of radius 4 lying on the palm; the tip of direction (-4, 3) is at (3, 3). Between the two, the equator
    # is nearer to the base than 5, so that the finger reaches over it; outside them it is farther.
    radius = np.array([3.0 - HAIR, 3.0, 3.5, 4.0, 4.0 + HAIR])
    assert holds_structurally(radius, 7.0, 5.0).tolist() == [False, True, True, True, False]


def test_finger_must_reach_the_disk() -> None:
    # The disk of radius 4 on the palm has its centre 5 from the base of a finger of length 1, so the tip just
    # touches it, arctan(4/3) below the equator; a smaller disk is out of reach.
    below = math.atan2(4.0, 3.0)
    assert holds_with_friction(4.0, 3.0, 1.0, below + HAIR)
    assert not holds_with_friction(4.0 - HAIR, 3.0, 1.0, below + HAIR)
    assert not holds_with_friction(4.0, 3.0, 1.0, below - 1e-6)
    assert not holds_structurally(4.0, 3.0, 1.0)


@pytest.mark.parametrize("half_thickness", [0.0, 0.05])
def test_fingers_of_one_plane_cannot_wrap_a_small_disk(half_thickness: float) -> None:
    # Their tips meet on the axis far above the disk, while crossing fingers come down on it; between the tips
    # it can still be pinched with friction, and only with friction.
    hand = (0.5, 1.0)
    small = 0.01
    assert holds_structurally(small, *hand, half_thickness)
    assert not holds_structurally(small, *hand, half_thickness, crossing=False)
    assert holds_with_friction(small, *hand, 0.1, half_thickness, crossing=False)
    assert not holds_with_friction(small, *hand, 0.0, half_thickness, crossing=False)


def test_joint_limits() -> None:
    # Fingers that stop at the normal never come over a disk of 0.4, those that start there never touch one of
    # 0.6.
    hand = (0.5, 1.0)
    upright = math.pi / 2
    assert not holds_structurally(0.4, *hand, psi_limits=(0.0, upright - HAIR))
    assert holds_structurally(0.4, *hand, psi_limits=(upright, math.pi))
    assert holds_with_friction(0.6, *hand, 0.5, psi_limits=(0.0, upright))
    assert not holds_with_friction(0.6, *hand, 0.5, psi_limits=(upright + HAIR, math.pi))


def test_broadcasting_and_scale() -> None:
    radius = np.geomspace(0.01, 5.0, 40)[:, None]
    half_palm = np.array([0.3, 1.2, 1.7])
    held = holds_with_friction(radius, half_palm, 1.0, 0.4)
    assert held.shape == (40, 3)
    assert 0 < held.sum() < held.size
    np.testing.assert_array_equal(held, holds_with_friction(300.0 * radius, 300.0 * half_palm, 300.0, 0.4))


def test_scan_finds_the_limits_argued_above() -> None:
    found = scan_limits(7.0, 5.0, 0.0, samples=200)
    assert found.structural == found.frictional
    np.testing.assert_allclose(found.structural, [(3.0, 4.0)], rtol=1e-9)
    wide = scan_limits(3.0, 1.0, math.radians(60.0), samples=400)
    assert wide.structural == []
    assert len(wide.frictional) == 1
    assert wide.frictional[0][0] == pytest.approx(4.0, rel=1e-9)
