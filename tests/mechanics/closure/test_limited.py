"""Disks held within joint limits, against closed forms where limits are wide and against a scan of postures."""

import dataclasses
from math import pi, radians, sin

import numpy as np
import pytest

from palmar.mechanics.closure.closing_links import LimitedHand
from palmar.mechanics.closure.disk_2_2 import structural_radii
from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
from palmar.mechanics.closure.limited import limited_radii, stance_at
from reference.slow_limited import climbed, lifted, scanned

WIDE = ((0.0, pi), (-pi, pi))
OCTAGON = LimitedHand(0.25, (0.5, 0.25), WIDE)


def hand_of(seed: int) -> LimitedHand:
    chance = np.random.default_rng(seed)
    w, p, q = chance.dirichlet((3.0, 3.0, 3.0))
    low = chance.uniform(0.0, radians(75.0))
    limits = (
        (low, chance.uniform(radians(95.0), radians(170.0))),
        (-chance.uniform(0.0, 0.5), chance.uniform(0.3, 2.0)),
    )
    friction = float(chance.choice([0.0, 0.3, 0.5]))
    return LimitedHand(w, (p, q), limits, friction, chance.uniform(0.0, 0.06), bool(chance.integers(2)))


def three_links(seed: int) -> LimitedHand:
    chance = np.random.default_rng(seed)
    w, *links = chance.dirichlet((3.0, 3.0, 2.0, 2.0))
    base = (chance.uniform(0.0, radians(75.0)), chance.uniform(radians(95.0), radians(170.0)))
    further = [(-chance.uniform(0.0, 0.5), chance.uniform(0.3, 2.0)) for _ in range(2)]
    friction = float(chance.choice([0.0, 0.3, 0.5]))
    return LimitedHand(w, tuple(links), (base, *further), friction, chance.uniform(0.0, 0.06), bool(chance.integers(2)))


def test_the_octagon_is_held_with_wide_limits_and_needs_45_degrees_of_each_joint():
    assert limited_radii(OCTAGON).intervals[-1][1] == pytest.approx((1.0 + 2.0**0.5) / 4.0, rel=1e-5)
    enough = dataclasses.replace(OCTAGON, limits=((radians(44.9), pi), (0.0, radians(45.1))))
    assert limited_radii(enough).intervals[-1][1] == pytest.approx((1.0 + 2.0**0.5) / 4.0, rel=1e-5)
    # with less of a bend the base joint stands steeper, and the distal link upright on it
    less = dataclasses.replace(OCTAGON, limits=((radians(60.0), pi), (0.0, radians(45.0))))
    assert limited_radii(less).intervals[-1][1] == pytest.approx(0.25 + 0.5 * sin(radians(30.0)), rel=1e-5)


@pytest.mark.parametrize(("w", "p", "q", "alpha"), [(0.332, 0.249, 0.419, 0.0), (0.363, 0.06, 0.577, 0.61)])
def test_wide_limits_give_the_closed_form(w: float, p: float, q: float, alpha: float):
    found = limited_radii(LimitedHand(w, (p, q), WIDE, alpha))
    assert len(found.intervals) == 1
    assert found.intervals[0][1] == pytest.approx(float(largest_with_friction(w, p, q, alpha)), rel=4e-4)


@pytest.mark.parametrize("seed", range(3))
def test_a_scan_of_postures_finds_the_same_radii(seed: int):
    hand = hand_of(seed)
    found = limited_radii(hand).intervals
    smallest, largest = scanned(hand)
    if not found:
        assert largest == 0.0
        return
    assert found[0][0] - 1e-3 <= smallest <= found[0][0] + 0.03
    assert found[-1][1] - 0.05 <= largest <= found[-1][1] + 1e-3


@pytest.mark.parametrize(("seed", "ratio", "share"), [(0, -1.0, 0.5), (1, 0.4, 0.3), (2, -0.5, 0.8)])
def test_a_coupling_keeps_the_second_joint_from_falling_behind(seed: int, ratio: float, share: float):
    plain = hand_of(seed)
    low, high = plain.limits[1]
    hand = dataclasses.replace(plain, coupling=(plain.limits[0][0], low + share * (high - low), ratio))
    found, free = limited_radii(hand).intervals, limited_radii(plain).intervals
    smallest, largest = scanned(hand)
    assert found[0][0] - 1e-3 <= smallest <= found[0][0] + 0.03
    assert found[-1][1] - 0.05 <= largest <= found[-1][1] + 1e-3
    assert found[-1][1] <= free[-1][1] + 1e-3
    assert found[0][0] >= free[0][0] - 1e-3


def test_links_kept_square_to_the_palm_hold_by_friction_what_is_no_wider_than_their_gap():
    """Tips with round ends reach h beyond: contacts at -alpha at the ends, R cos(alpha) + h cos(alpha) = gap / 2 + h."""
    palm, link, h, alpha = 0.3, 0.4, 0.02, 0.4
    limits = ((radians(50.0), radians(90.0)), (0.0, radians(40.0)))
    hand = LimitedHand(palm, (link, 0.3), limits, alpha, h, False, (radians(50.0), radians(40.0), -1.0))
    gap = palm + link * np.cos(radians(50.0))
    largest = limited_radii(hand).intervals[-1][1]
    assert largest == pytest.approx(gap / np.cos(alpha) - h, rel=1e-3)
    assert stance_at(hand, 1.1 * largest) is None
    assert stance_at(dataclasses.replace(hand, coupling=None), 1.1 * largest) is not None


def test_three_links_hold_what_random_postures_come_to():
    """Of the first the search misses some radii below the largest it finds, which do not end what is held."""
    hard, smooth = three_links(0), three_links(8)
    largest, met = limited_radii(hard).intervals[-1][1], climbed(hard, 0, 2000)
    assert 0.97 * largest <= met <= largest * (1.0 + 1e-4)
    met = climbed(smooth, 8, 2000)
    assert stance_at(smooth, met * (1.0 - 1e-4)) is not None
    assert stance_at(smooth, met * 1.01) is None


def test_the_stance_keeps_its_limits_and_touches_the_disk():
    hand = LimitedHand(0.3, (0.4, 0.3), ((1.0, 2.0), (0.0, 0.4)), 0.4, 0.04)
    found = limited_radii(hand)
    stance = found.largest
    assert stance is not None
    for angle, (low, high) in zip(stance.angles, hand.limits, strict=True):
        assert low - 1e-6 <= angle <= high + 1e-6
    points = stance.joints(hand.half_palm, hand.links)
    radius, elevation = lifted(points[None], hand.half_thickness, np.array([[stance.height]]))
    assert radius[0, 0] == pytest.approx(stance.radius, abs=1e-6)
    assert elevation[0, 0] == pytest.approx(stance.elevation, abs=1e-5)
    assert stance_at(hand, 1.01 * stance.radius) is None


def test_a_hand_twice_as_large_holds_disks_twice_as_large():
    hand = hand_of(1)
    twice = dataclasses.replace(
        hand,
        half_palm=2 * hand.half_palm,
        links=tuple(2 * each for each in hand.links),
        half_thickness=2 * hand.half_thickness,
    )
    one, two = (np.array(limited_radii(each).intervals) for each in (hand, twice))
    assert two == pytest.approx(2.0 * one, rel=1e-6)


def test_stiff_fingers_in_one_plane_stop_where_their_tips_meet():
    hand = LimitedHand(0.25, (0.4, 0.4), ((0.0, radians(170.0)), (0.0, 1e-4)), crossing=False)
    closed = structural_radii(0.25, 0.8, crossing=False)
    assert limited_radii(hand).intervals[0] == pytest.approx((float(closed.min), float(closed.max)), rel=1e-3)
    assert limited_radii(dataclasses.replace(hand, crossing=True)).intervals[0][0] < 0.9 * closed.min
