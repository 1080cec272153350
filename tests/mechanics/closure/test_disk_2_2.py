"""Disks a 2-jointed hand holds: published numbers, branches and their boundaries, invariants, and brute force."""

from math import asin, atan, cos, degrees, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from palmar.geometry.straight_finger import last_angle
from palmar.mechanics.closure.disk_2_2 import frictional_radii, structural_radii, touched_radius
from reference.disk_holding import holds_structurally, holds_with_friction

ALPHA = atan(0.7)


def limits(radii):
    return float(radii.min), float(radii.max)


def test_the_published_example():
    assert limits(structural_radii(1.2, 1.0)) == pytest.approx((0.226, 0.974), abs=5e-4)
    assert limits(frictional_radii(1.2, 1.0, ALPHA)) == pytest.approx((0.220, 2.054), abs=5e-4)
    assert degrees(asin(1 - 2 / 1.2**2)) == pytest.approx(-22.9, abs=0.05)
    assert degrees(2 * atan(0.2 / 2.2)) == pytest.approx(10.4, abs=0.05)


@pytest.mark.parametrize("beta", [0.3, 1.0])
def test_up_to_beta_one_every_disk_up_to_the_half_palm(beta):
    assert limits(structural_radii(beta, 1.0)) == (0.0, beta)
    largest = (beta + sin(ALPHA)) / cos(ALPHA)
    assert limits(frictional_radii(beta, 1.0, ALPHA)) == pytest.approx((0.0, largest))


def test_boundaries_of_the_structural_branches():
    just_above = structural_radii(1.0 + 1e-12, 1.0)
    assert limits(just_above) == pytest.approx((0.0, 1.0), abs=1e-11)
    at_root_two = structural_radii(sqrt(2.0) * (1 - 1e-15), 1.0)
    assert limits(at_root_two) == pytest.approx((sqrt(0.5), sqrt(0.5)), abs=1e-6)
    assert np.isnan(structural_radii(sqrt(2.0) * (1 + 1e-9), 1.0).max)


@pytest.mark.parametrize("beta", [1.5, 2.0, 3.0])
def test_at_the_least_friction_one_radius_remains(beta):
    least = asin(1 - 2 / beta**2)
    assert np.isnan(frictional_radii(beta, 1.0, least - 1e-9).max)
    only = beta * sqrt(beta**2 - 1) / 2
    assert limits(frictional_radii(beta, 1.0, least + 1e-13)) == pytest.approx((only, only), rel=1e-5)


@pytest.mark.parametrize("beta", [1.1, 1.2, 2.0])
def test_beyond_alpha_a_the_smallest_disk_is_limited_by_geometry(beta):
    alpha_a = 2 * atan((beta - 1) / (beta + 1))
    smallest = (beta**2 - 1) / 2
    for alpha in (alpha_a, alpha_a + 1e-9, alpha_a + 0.3):
        assert frictional_radii(beta, 1.0, alpha).min == pytest.approx(smallest, rel=1e-9)
    assert frictional_radii(beta, 1.0, alpha_a - 0.05).min > smallest


@given(st.floats(0.01, 2.0), st.floats(0.1, 3.0), st.floats(0.0, 0.05))
def test_without_friction_both_closures_are_one(half_palm, length, h):
    plain, rough = structural_radii(half_palm, length, h), frictional_radii(half_palm, length, 0.0, h)
    assert limits(rough) == pytest.approx(limits(plain), nan_ok=True)


@given(st.floats(0.05, 2.0), st.floats(0.0, 1.4), st.floats(0.0, 0.3), st.floats(1e-3, 1e3), st.booleans())
def test_radii_scale_with_the_hand(beta, alpha, h, scale, crossing):
    one = frictional_radii(beta, 1.0, alpha, h, crossing=crossing)
    many = frictional_radii(scale * beta, scale, alpha, scale * h, crossing=crossing)
    assert limits(many) == pytest.approx((scale * one.min, scale * one.max), rel=1e-6, abs=1e-7 * scale, nan_ok=True)


@given(st.floats(0.05, 1.9), st.floats(0.01, 1.2), st.floats(0.0, 0.3), st.booleans())
def test_more_friction_never_holds_less(beta, alpha, h, crossing):
    less, more = (frictional_radii(beta, 1.0, each, h, crossing=crossing) for each in (alpha, alpha + 0.1))
    if not np.isnan(less.max):
        assert more.max >= less.max * (1 - 1e-9)
        assert more.min <= less.min + 1e-9


def test_a_round_fingertip_sets_the_smallest_disk():
    """Two touching round tips of radius h on the palm leave room for h/4 beneath them (the source's figure 2.6)."""
    h, length = 0.1, 1.0
    reach = sqrt(length**2 - h**2)
    assert structural_radii(reach + h, length, h, crossing=False).min == pytest.approx(h / 4, rel=1e-6)


def test_colliding_line_fingers_leave_the_incircle_of_palm_and_fingers():
    d, length = 0.06, 0.244
    assert structural_radii(d, length, crossing=False).min == pytest.approx(d * sqrt((length - d) / (length + d)))


def test_a_thick_finger_against_a_disk_is_a_line_on_a_narrower_palm():
    thick, line = structural_radii(0.9, 1.0, 0.1), structural_radii(0.8, 1.0)
    assert limits(thick) == pytest.approx(limits(line))


def test_the_touched_radius_is_touched():
    for psi in np.radians([60.0, 100.0, 150.0]):
        for h in (0.0, 0.1):
            radius = float(touched_radius(1.0, 1.1, h, psi))
            along = np.clip((-cos(psi)) * 1.0 + radius * sin(psi), 0.0, 1.1)
            gap = np.hypot(1.0 + along * cos(psi), along * sin(psi) - radius) - radius - h
            assert gap == pytest.approx(0.0, abs=1e-12)
    assert last_angle(0.06, 0.244, 0.0, True, pi) == pi


def test_infinite_friction_is_approached_without_blowing_up():
    for mu in (1e2, 1e4, 1e6):
        radii = frictional_radii(1.2, 1.0, atan(mu))
        assert radii.min == pytest.approx(0.22)
        assert radii.max > 0.5 * mu
    assert tan(radians(89.9)) > 100


def sweep(count, seed, thickness=0.0):
    rng = np.random.default_rng(seed)
    alpha = np.where(rng.random(count) < 0.05, 0.0, rng.uniform(0.0, 1.4, count))
    return rng.uniform(0.02, 2.0, count), alpha, rng.uniform(0.0, thickness, count)


@pytest.mark.parametrize(
    ("seed", "thickness", "options"),
    [
        (1, 0.0, {}),
        (2, 0.3, {}),
        (3, 0.3, {"crossing": False}),
        (4, 0.3, {"psi_limits": (0.9, 2.2)}),
        (5, 0.3, {"psi_limits": (1.5, 2.9), "crossing": False}),
    ],
)
def test_brute_force_holds_just_inside_every_limit_and_not_just_outside(seed, thickness, options):
    d, alpha, h = sweep(800, seed, thickness)
    for radii, holds in (
        (structural_radii(d, 1.0, h, **options), lambda r: holds_structurally(r, d, 1.0, h, **options)),
        (frictional_radii(d, 1.0, alpha, h, **options), lambda r: holds_with_friction(r, d, 1.0, alpha, h, **options)),
    ):
        some = ~np.isnan(radii.max) & (radii.max - radii.min > 1e-4 * radii.max)
        assert some.sum() > 200
        for limit, sign in ((radii.max, -1.0), (radii.min, 1.0)):
            known = some & (limit > 1e-5)
            inside, outside = (np.where(known, limit * (1.0 + side * 1e-6), 1.0) for side in (sign, -sign))
            assert holds(inside)[known].all()
            assert not holds(outside)[known].any()
        anywhere = np.exp(np.random.default_rng(seed).uniform(np.log(0.01), np.log(6.0), len(d)))
        assert np.array_equal(holds(anywhere), radii.holds(anywhere))
