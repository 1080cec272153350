"""The least finger around a disk: the source's hands, the kernels of closure, and scale."""

from math import atan, tan

import numpy as np
import pytest

from palmar.mechanics.closure.chain import Chain, largest_hold
from palmar.mechanics.closure.disk_2_2 import frictional_radii
from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
from palmar.mechanics.closure.shortest_hand import shortest_hand
from palmar.studies.design.wrap import Wrap

ANY = (0.0, 1.0)


def test_the_hand_of_four_radii():
    assert Wrap(1, 0.05, 0.05, 0.0).shortest(ANY, ANY) == pytest.approx((0.05, 0.05), rel=1e-9)


def test_the_half_octagon():
    wrap = Wrap(2, 0.05, 0.05, 0.0)
    found = wrap.shortest(ANY, ANY)
    half = sum(found)
    assert (found[0] / half, *np.array(wrap.links_of(*found)) / half) == pytest.approx((0.25, 0.5, 0.25), abs=1e-7)


@pytest.mark.parametrize("links", [1, 2, 3, 5])
def test_without_friction_it_is_the_polygon_of_chapter_5(links):
    wrap = Wrap(links, 0.04, 0.04, 0.0)
    assert wrap.least_length() == pytest.approx(shortest_hand(links, 0.04).length)
    assert 2.0 * sum(wrap.shortest(ANY, ANY)) == pytest.approx(wrap.least_length(), rel=1e-9)


def test_no_hand_of_one_or_two_links_holds_more_with_friction():
    alpha = atan(0.4)
    share = np.linspace(0.01, 0.99, 99)
    one = np.nanmax(frictional_radii(share, 1.0 - share, alpha).max)
    palm, proximal = (each.ravel() for each in np.meshgrid(share, share))
    some = palm + proximal < 0.995
    palm, proximal = palm[some], proximal[some]
    two = np.nanmax(largest_with_friction(palm, proximal, 1.0 - palm - proximal, alpha))
    for links, most in ((1, one), (2, two)):
        least = Wrap(links, 1.0, 1.0, alpha).least_length()
        assert most * least <= 2.0 + 1e-9
        assert most * least == pytest.approx(2.0, rel=3e-3)


@pytest.mark.parametrize(("links", "alpha"), [(1, 0.3), (2, 0.0), (2, 0.3)])
def test_thick_fingers_hold_just_that_disk(links, alpha):
    wrap = Wrap(links, 0.01, 0.05, alpha, 0.008)
    half_palm, finger = wrap.shortest(ANY, ANY)
    hold = largest_hold(Chain(half_palm, wrap.links_of(half_palm, finger), alpha, 0.008))
    assert hold.radius == pytest.approx(0.05, rel=1e-6)


def test_no_shorter_thick_hand_of_one_link_holds_it():
    wrap = Wrap(1, 0.05, 0.05, 0.3, 0.008)
    least = sum(wrap.shortest(ANY, ANY))
    half_palm = np.linspace(0.2, 0.8, 4001) * least
    most = [np.nanmax(wrap.straight_radii(half_palm, size - half_palm).max) for size in (0.999 * least, 1.001 * least)]
    assert most[0] < 0.05 < most[1]


def test_a_wide_palm_asks_for_fingers_that_reach_the_smallest_disk():
    wrap = Wrap(1, 0.01, 0.05, 0.0)
    half_palm, finger = wrap.shortest((0.07, 0.07), ANY)
    radii = wrap.straight_radii(half_palm, finger)
    assert float(radii.min) == pytest.approx(0.01)
    assert float(radii.max) > 0.05


def test_off_a_narrow_palm_straight_fingers_pinch():
    alpha = atan(0.5)
    wrap = Wrap(1, 0.03, 0.03, alpha)
    half_palm, finger = wrap.shortest((0.005, 0.005), ANY)
    assert float(wrap.straight_radii(half_palm, finger).max) == pytest.approx(0.03)
    assert finger == pytest.approx((0.03 * np.cos(alpha) - 0.005) / np.sin(alpha))


def test_a_finger_limit_below_the_least_leaves_none():
    assert Wrap(1, 0.05, 0.05, 0.0).shortest(ANY, (0.0, 0.049)) is None


def test_more_links_tend_to_the_circle():
    lengths = [Wrap(links, 1.0, 1.0, 0.2).least_length() for links in (1, 2, 3, 50)]
    assert lengths == sorted(lengths, reverse=True)
    assert lengths[-1] == pytest.approx(np.pi - 0.4, rel=1e-3)
    assert lengths[0] == pytest.approx(4.0 * tan(np.pi / 4.0 - 0.1))
