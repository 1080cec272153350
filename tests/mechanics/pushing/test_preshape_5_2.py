"""The preshape without rolling: published angles, a double integral over the disk, limits and scale."""

from __future__ import annotations

from math import asin, cos, degrees, hypot, inf, pi, sin

import numpy as np
import pytest
from scipy.optimize import brentq

from palmar.mechanics.pushing.limit_surface import disk_surface
from palmar.mechanics.pushing.preshape_5_2 import RidingDisk, RidingFinger, disc_radius, preshape, ride
from palmar.mechanics.pushing.slider import disk_slider

PROXIMAL, DISTAL, RADIUS = 13.7, 10.7, 3.8
DISK = RidingDisk(RADIUS, disk_surface(RADIUS))


@pytest.mark.parametrize(("half_thickness", "angle"), [(0.0, 20.31), (1.25, 26.00), (2.5, 31.98)])
def test_angles_of_the_test_bed(half_thickness: float, angle: float) -> None:
    found = preshape(RidingFinger(PROXIMAL, half_thickness), DISK, DISTAL)
    assert found is not None
    assert degrees(found.angle) == pytest.approx(angle, abs=0.005)
    for along in (2.0, 6.0):  # it hardly matters where the disk touches
        other = preshape(RidingFinger(PROXIMAL, half_thickness), DISK, along)
        assert other is not None and degrees(other.angle) == pytest.approx(angle, abs=0.06)


@pytest.mark.parametrize(("exponent", "angles"), [(1.0, (21.2, 26.9, 32.9)), (-1.0, (18.9, 24.5, 30.4))])
def test_pressure_nearer_the_rim_asks_for_more(exponent: float, angles: tuple[float, ...]) -> None:
    disk = RidingDisk(RADIUS, disk_slider(RADIUS, exponent).surface)
    found = [preshape(RidingFinger(PROXIMAL, h), disk, DISTAL) for h in (0.0, 1.25, 2.5)]
    assert [degrees(each.angle) for each in found if each is not None] == pytest.approx(angles, abs=0.1)


def moment_by_points(
    half_thickness: float, along: float, angle: float, offset: tuple[float, float] = (0.0, 0.0)
) -> float:
    """Sum over 200,000 points of a uniform disk, each rubbing against its velocity about the base: moment at the contact.

    ``offset`` shifts every point by the same way along the ray and across it.
    """
    link, normal = np.array([cos(angle), sin(angle)]), np.array([-sin(angle), cos(angle)])
    contact = np.array([PROXIMAL, 0.0]) + along * link + half_thickness * normal
    centre = contact + RADIUS * normal
    k = np.arange(200_000) + 0.5
    r, turn = RADIUS * np.sqrt(k / len(k)), k * pi * (3.0 - 5.0**0.5)
    ray = centre / hypot(*centre)
    points = centre + np.column_stack([r * np.cos(turn), r * np.sin(turn)])
    points += offset[0] * ray + offset[1] * np.array([-ray[1], ray[0]])
    speed = np.column_stack([-points[:, 1], points[:, 0]])
    force = -speed / np.linalg.norm(speed, axis=1)[:, None]
    arm = points - contact
    moments = (arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]).mean()
    return float(moments / np.linalg.norm(force.mean(axis=0)))


@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.3, 0.0), (0.0, -0.2)])
def test_the_moment_is_that_of_the_points_of_the_disk(offset: tuple[float, float]) -> None:
    disk = RidingDisk(RADIUS, DISK.surface, offset)
    for h, along, angle in ((0.0, 6.0, 0.3), (1.25, 2.0, 0.7), (0.5, 10.0, 0.1)):
        found = ride(RidingFinger(PROXIMAL, h), disk, along, angle)
        assert found.moment == pytest.approx(moment_by_points(h, along, angle, offset), abs=1e-4)
    root = brentq(lambda each: moment_by_points(1.25, 6.0, each, offset), 0.1, 0.8)
    found = preshape(RidingFinger(PROXIMAL, 1.25), disk, 6.0)
    assert found is not None and found.angle == pytest.approx(root, abs=1e-5)


def test_limits() -> None:
    """A small disk asks for asin(h / L); a far one for the line of the moment over force; a thin ring for R / 2 there."""
    small = preshape(RidingFinger(PROXIMAL, 1.0), RidingDisk(1e-4, disk_surface(1e-4)), DISTAL)
    assert small is not None and small.angle == pytest.approx(asin(1.0 / PROXIMAL), abs=1e-5)
    for exponent, line in ((0.0, 0.25), (inf, 0.5)):
        # The disk's centre is 1000 L away along the distal link.
        far = preshape(RidingFinger(1.0), RidingDisk(0.2, disk_slider(0.2, exponent).surface), 1000.0)
        assert far is not None and sin(far.angle) == pytest.approx(0.2 * (1.0 + line), rel=1e-3)
        assert far.friction == pytest.approx(line * 0.2 / far.arm, rel=1e-2)


def test_more_curl_rolls_in_and_where_no_angle_does_there_is_none() -> None:
    found = preshape(RidingFinger(PROXIMAL), DISK, DISTAL)
    assert found is not None
    assert ride(RidingFinger(PROXIMAL), DISK, DISTAL, found.angle + 0.01).moment > 0.0
    assert ride(RidingFinger(PROXIMAL), DISK, DISTAL, found.angle - 0.01).moment < 0.0
    assert preshape(RidingFinger(3.0), DISK, DISTAL) is None


def test_the_unit_of_length_does_not_matter() -> None:
    one = preshape(RidingFinger(PROXIMAL, 1.25), DISK, DISTAL)
    disk = RidingDisk(1e-2 * RADIUS, disk_surface(1e-2 * RADIUS))
    other = preshape(RidingFinger(1e-2 * PROXIMAL, 1.25e-2), disk, 1e-2 * DISTAL)
    assert one is not None and other is not None
    assert other.angle == pytest.approx(one.angle, abs=1e-12)
    assert other.friction == pytest.approx(one.friction, rel=1e-9)


def test_the_source_s_disc_reaches_to_the_tip_of_the_bent_finger() -> None:
    assert disc_radius(3.0, 4.0, 0.5 * pi) == pytest.approx(5.0)
    assert disc_radius(PROXIMAL, DISTAL, 0.0) == PROXIMAL + DISTAL


def test_a_straight_finger_rolls_in_what_presses_near_the_base() -> None:
    offset = (-0.9 * RADIUS, 0.0)
    disk = RidingDisk(RADIUS, disk_slider(RADIUS, 0.0, offset).surface, offset)
    found = preshape(RidingFinger(PROXIMAL, 0.0), disk, DISTAL)
    assert found is not None and found.angle == 0.0
    assert found.moment == ride(RidingFinger(PROXIMAL, 0.0), disk, DISTAL, 0.0).moment > 0.0
