"""Flight between impacts and the three-impact construction: printed digits, energy, scale, and small steps."""

from math import degrees, pi

import numpy as np
import pytest

from palmar.mechanics.impact import three_impacts_4_2_1 as three
from reference.slow_free_flight import carried

D, L, R = 6.0, 24.4, 3.8


def numbers(found: three.Construction) -> list[float]:
    angles = (found.turn_to_second, found.turn_to_third, found.first_angle)
    return [found.first, found.second, *map(degrees, angles)]


def test_the_published_example_to_its_printed_digits():
    found = numbers(three.construction(D, L, R, published=True))
    assert [round(each, places) for each, places in zip(found, (1, 1, 0, 1, 1), strict=True)] == [
        2.8,
        7.7,
        45,
        53.7,
        -3.6,
    ]
    assert found == pytest.approx([2.7614, 7.7100, 45.02, 53.72, -3.57], abs=5e-3)


def test_the_corrected_example():
    found = numbers(three.construction(D, L, R))
    assert found == pytest.approx([5.2511, 14.1735, 54.02, 31.44, 9.71], abs=5e-3)
    assert found[:2] == pytest.approx([5.2511, 14.1735], abs=5e-5)


@pytest.mark.parametrize("published", [False, True])
def test_the_construction_ends_at_the_tip_when_the_tips_are_a_disk_apart(published):
    found = three.construction(D, L, R, published=published)
    again = three.three_impacts(found.first, R, published=published)
    assert again.third == pytest.approx(L, rel=1e-13)
    assert D + L * np.cos(found.end) == pytest.approx(R, rel=1e-13)
    assert found.second_angle == pytest.approx(found.first_angle + found.turn_to_second)


@pytest.mark.parametrize(("published", "at_first"), [(False, 5.0), (True, 13.0)])
def test_the_third_distance_grows_with_the_first(published, at_first):
    """One function of X1 / R: it rises everywhere, so the construction has one answer for every hand."""
    first = np.geomspace(1e-7, 1e7, 20001)
    third = three.three_impacts(first, 1.0, published=published).third
    slope = np.diff(np.log(third)) / np.diff(np.log(first))
    assert slope.min() > 0.8
    assert third[0] / first[0] == pytest.approx(at_first, rel=1e-6)
    assert third[-1] / first[-1] > 4.5


def test_arrays_and_scale():
    lengths, radii = np.array([[24.4], [2.0]]), np.array([3.8, 0.1, 1e-3])
    found = three.first_distance(lengths, radii)
    assert found.shape == (2, 3)
    assert found[0, 0] == pytest.approx(5.2511, abs=5e-5)
    assert three.first_distance(10.0 * lengths, 10.0 * radii) == pytest.approx(10.0 * found, rel=1e-13)
    one, ten = (numbers(three.construction(k * D, k * L, k * R)) for k in (1.0, 10.0))
    assert ten == pytest.approx([10 * one[0], 10 * one[1], *one[2:]], rel=1e-12)


def test_there_is_none_where_the_tips_never_stand_a_disk_apart():
    assert three.construction(6.0, 2.0, 3.8) is None
    assert three.construction(1.0, 2.0, 3.1) is None
    assert three.construction(6.0, 2.3, 3.8) is not None


def test_a_moving_wall_does_the_work_that_the_printed_sign_exceeds():
    """e = 1: half (u'^2 - u^2) is the impulse times the wall's speed X'; as printed it is 2 X' u too much."""
    one = three.flight(np.linspace(0.5, 9.0, 40), 0.0, np.linspace(1.0, 18.0, 40), R)
    wall, before = one.distance, one.normal
    for after, excess in (
        (three.struck(wall, before), 0.0),
        (three.struck_published(wall, before), 2.0 * wall * before),
    ):
        gained = 0.5 * (after**2 - before**2) - (after - before) * wall
        assert gained == pytest.approx(excess, rel=1e-12, abs=1e-12 * float(wall.max()) ** 2)
    assert np.all(before > 0.0), "so the excess is energy from nowhere"


def test_restitution_is_that_of_the_relative_velocity():
    e = np.linspace(0.0, 1.0, 11)
    after = three.struck(7.0, 3.0, e)
    assert after - 7.0 == pytest.approx(e * (7.0 - 3.0), rel=1e-14)


def test_the_flight_is_that_of_small_steps():
    """The same disk through the plain reference: struck twice on the way, then at the tip as the verdict comes."""
    found = three.construction(D, L, R)
    start = placed(found.first, found.first_angle)
    *end, hits = carried(*start, found.first_angle, found.end - 1e-9, (D, L, R), 1.0, 1e-4)
    assert hits == 2
    assert end[:2] == pytest.approx(placed(L, found.end), abs=1e-3)
    x, y, *_, hits = carried(*start, found.first_angle, found.second_angle - 1e-9, (D, L, R), 1.0, 1e-4)
    assert hits == 1
    assert (x, y) == pytest.approx(placed(found.second, found.second_angle), abs=1e-5)


def placed(distance: float, angle: float) -> tuple[float, float]:
    c, s = np.cos(angle), np.sin(angle)
    return float(D + distance * c - R * s), float(distance * s + R * c)


def test_the_next_contact_is_the_first_one():
    """Between leaving and the next contact the centre stays farther than R from the finger's line; and it is on it then."""
    rng = np.random.default_rng(5)
    x, r, ut = rng.uniform(0.01, 20.0, 300), rng.uniform(0.01, 5.0, 300), rng.uniform(0.0, 20.0, 300)
    un = x * rng.uniform(1.001, 8.0, 300)
    found = three.flight(x, ut, un, r)
    assert np.all((found.turn > 0.0) & (found.turn < pi / 2))
    for share in np.linspace(0.02, 1.0, 50):
        phi = share * found.turn
        px, py = x + ut * phi, r + un * phi
        away = -px * np.sin(phi) + py * np.cos(phi) - r
        if share < 1.0:
            assert np.all(away > 0.0)
        else:
            assert away == pytest.approx(np.zeros(300), abs=1e-12)
            assert np.hypot(found.distance, r) == pytest.approx(np.hypot(px, py), rel=1e-12)
            assert np.hypot(found.along, found.normal) == pytest.approx(np.hypot(ut, un), rel=1e-12)


def test_small_first_distances_keep_their_digits():
    """Close to the joint phi = 2 X / R to first order: no digits are lost where X is far below R."""
    x = np.geomspace(1e-9, 1e-6, 4)
    assert three.flight(x, 0.0, 2.0 * x, 1.0).turn == pytest.approx(2.0 * x, rel=1e-5)
    assert three.first_distance(1e-6, 1.0) == pytest.approx(2e-7, rel=1e-5)


def test_flights_that_are_none():
    assert np.isnan(three.flight(1.0, 0.0, 1.0, R).turn), "it does not leave"
    assert np.isnan(three.flight(1.0, -0.5, 3.0, R).turn), "it moves towards the joint"
