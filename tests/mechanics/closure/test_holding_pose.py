"""Holding poses against signed distances and against the brute-force decision."""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, pi, radians, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from palmar.mechanics.closure.holding_pose import Pose, holding_pose, touching_pose
from palmar.mechanics.closure.sizing import Grip
from reference.disk_holding import holds_structurally, holds_with_friction

EXAMPLE = Grip(1.2, 1.0, friction_angle=radians(35.0))

grips = st.builds(
    Grip,
    half_palm=st.floats(0.2, 2.0),
    finger_length=st.just(1.0),
    half_thickness=st.one_of(st.just(0.0), st.floats(0.01, 0.15)),
    friction_angle=st.one_of(st.none(), st.floats(0.01, 1.3)),
    crossing=st.booleans(),
    psi_limits=st.one_of(st.just((0.0, pi)), st.tuples(st.floats(0.0, 1.5), st.floats(1.6, pi))),
)


def gap(grip: Grip, pose: Pose, radius: float) -> float:
    """Signed distance between the right finger's surface and the disk."""
    x, y = grip.half_palm, 0.0
    along = min(max((0.0 - x) * cos(pose.psi) + (pose.height - y) * sin(pose.psi), 0.0), grip.finger_length)
    return hypot(x + along * cos(pose.psi), along * sin(pose.psi) - pose.height) - radius - grip.half_thickness


def decided(grip: Grip, radius: float) -> bool:
    """The brute-force decision."""
    given = (radius, grip.half_palm, grip.finger_length)
    rest = {"crossing": grip.crossing, "psi_limits": grip.psi_limits}
    if grip.friction_angle is None:
        return bool(holds_structurally(*given, grip.half_thickness, **rest))
    return bool(holds_with_friction(*given, grip.friction_angle, grip.half_thickness, **rest))


def held_off_limits(grip: Grip, radius: float) -> bool | None:
    """The decision where it is the same for a slightly smaller and larger disk, None next to a limit."""
    near = {decided(grip, radius * factor) for factor in (1.0 - 1e-6, 1.0, 1.0 + 1e-6)}
    return near.pop() if len(near) == 1 else None


@settings(max_examples=100, deadline=None)
@given(grip=grips, radius=st.floats(0.02, 4.0))
def test_a_pose_is_found_exactly_where_brute_force_holds(grip: Grip, radius: float) -> None:
    pose, held = holding_pose(grip, radius), held_off_limits(grip, radius)
    if held is not None:
        assert (pose is not None) == held
    if pose is not None:
        assert gap(grip, pose, radius) == pytest.approx(0.0, abs=1e-7)
        assert pose.height >= radius
        assert pose.on_palm == (pose.height == radius)
        alpha = grip.friction_angle or 0.0
        assert pose.elevation >= -alpha - 1e-8
        assert pose.on_palm or pose.elevation <= alpha + 1e-8


@settings(max_examples=80, deadline=None)
@given(grip=grips, radius=st.floats(0.02, 4.0), rise=st.floats(0.0, 2.0), share=st.floats(0.0, 0.999))
def test_fingers_are_clear_before_they_touch(grip: Grip, radius: float, rise: float, share: float) -> None:
    pose = touching_pose(grip, radius, radius + rise)
    if pose is not None:
        assert gap(grip, pose, radius) == pytest.approx(0.0, abs=1e-7)
        assert gap(grip, replace(pose, psi=share * pose.psi), radius) >= -1e-9


@settings(max_examples=100, deadline=None)
@given(grip=grips, radius=st.floats(0.02, 4.0))
def test_no_pinch_asks_for_less_friction(grip: Grip, radius: float) -> None:
    pose = holding_pose(grip, radius)
    if pose is None or pose.on_palm:
        return
    highest = hypot(grip.half_palm, grip.finger_length + radius + grip.half_thickness)
    others = [touching_pose(grip, radius, height) for height in np.linspace(radius, highest, 400)]
    low, high = grip.psi_limits
    inner = (grip.half_thickness - grip.half_palm) / grip.finger_length
    for other in others:
        if other is None or not low <= other.psi <= high or sin(other.psi) < grip.half_thickness / grip.finger_length:
            continue
        if grip.crossing or cos(other.psi) >= inner:
            assert abs(pose.elevation) <= abs(other.elevation) + 1e-8


def test_published_example() -> None:
    # Section 2.2.2: structural 0.226 to 0.974, the tip then on the equator; frictional up to 2.054, on the palm.
    plain = replace(EXAMPLE, friction_angle=None)
    limits = np.array([1.2 - 0.56**0.5, 1.2 + 0.56**0.5]) / 2.0
    assert limits == pytest.approx([0.226, 0.974], abs=5e-4)
    for radius in limits:
        pose = holding_pose(plain, radius)
        assert pose is not None
        assert pose.elevation == pytest.approx(0.0, abs=1e-8)
        assert sin(pose.psi) == pytest.approx(radius)
    assert holding_pose(plain, 0.225) is None
    assert holding_pose(plain, 0.975) is None
    largest = holding_pose(EXAMPLE, 2.0535)
    assert largest is not None
    assert largest.on_palm
    assert largest.elevation == pytest.approx(-radians(35.0), abs=2e-3)


def test_wide_reach_holds_the_largest_disk_off_the_palm() -> None:
    # Equation 2.1: R = (D + L sin alpha) / cos alpha, the finger leaning out by alpha, the tip at the cone's edge.
    alpha = 0.5
    grip = Grip(0.5, 2.0, friction_angle=alpha)
    pose = holding_pose(grip, (0.5 + 2.0 * sin(alpha)) / cos(alpha))
    assert pose is not None
    assert not pose.on_palm
    assert pose.psi == pytest.approx(0.5 * pi - alpha)
    assert pose.elevation == pytest.approx(-alpha)


def test_tips_that_meet_pinch_a_small_disk_at_its_equator() -> None:
    grip = Grip(0.5, 1.0, friction_angle=0.1, crossing=False)
    pose = holding_pose(grip, 0.01)
    assert pose is not None
    assert not pose.on_palm
    assert pose.elevation == pytest.approx(0.0, abs=1e-12)
    assert cos(pose.psi) == pytest.approx(-0.49)
    assert holding_pose(replace(grip, friction_angle=None), 0.01) is None
