"""The smallest safe opening against the angle at which a finger would touch the uncertain disk, and against simulation."""

from functools import cache
from math import asin, atan2, hypot, pi

import numpy as np
import pytest
from shapely import MultiPolygon, Point, box

from palmar.geometry.planar_set import EMPTY
from palmar.mechanics.pushing.closing import close_disk
from palmar.mechanics.pushing.closing_tables import ClosingHand
from palmar.mechanics.pushing.limit_surface import disk_surface
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.regions.exact import exact_region
from palmar.regions.opening import openings_anywhere, openings_at, widest_opening

CASE = open_case("testbed_table")[1]
LIMITS = (0.0, 0.95 * pi)


@cache
def region_of(angle):
    hand = CASE.hand.model_copy(update={"open": angle})
    return exact_region(CASE.model_copy(update={"hand": hand}), tolerance=2e-5).centre


def test_one_place_is_safe_until_the_finger_would_touch_it():
    x, y = 0.0, 0.12
    found = openings_at(region_of, LIMITS, Point(0, 0).buffer(1e-6), (x, y))
    touch = atan2(y, x - 0.06) - asin(0.038 / hypot(x - 0.06, y))
    assert found.works == ((0.0, pytest.approx(touch, abs=2e-4)),)


def test_the_uncertainty_is_caught_from_the_smallest_opening_and_not_from_a_smaller_one():
    disk = Point(0, 0).buffer(0.03, quad_segs=64)
    smallest = openings_at(region_of, LIMITS, disk, (0.02, 0.12)).smallest
    rim = np.array([0.02, 0.12]) + 0.03 * np.array([(np.cos(t), np.sin(t)) for t in np.linspace(0.0, 2.0 * pi, 720)])
    for opening, safe in ((smallest - 1e-3, True), (smallest + 1e-3, False)):
        hand = ClosingHand(0.06, 0.244, 0.0, 0.038, 0.7, opening, pi)
        codes = close_disk(hand, disk_surface(0.038), rim).codes
        assert (codes <= Outcome.CAGED.code).all() == safe


def test_a_free_place_allows_a_smaller_opening():
    errors = box(-0.04, -0.02, 0.04, 0.02)
    given = openings_at(region_of, LIMITS, errors, (0.0, 0.12))
    free = openings_anywhere(region_of, LIMITS, errors)
    assert free.smallest > given.smallest
    assert openings_at(region_of, LIMITS, errors, free.at).smallest == pytest.approx(free.smallest, abs=2e-3)


def test_what_is_too_large_has_no_opening():
    assert openings_at(region_of, LIMITS, box(-1, -1, 1, 1), (0.0, 0.12)).smallest is None
    assert openings_anywhere(region_of, LIMITS, box(-1, -1, 1, 1)).at is None


def test_the_allowed_error_is_largest_for_the_open_hand():
    found = widest_opening(region_of, LIMITS)
    assert found.allowed == pytest.approx(0.1102, abs=2e-4)
    assert 0.0 < found.angle < 1.0
    assert widest_opening(lambda _: EMPTY, LIMITS) is None


def test_two_intervals_of_openings_are_both_found():
    def region(angle):
        return MultiPolygon([box(-1, -1, 1, 1)]) if 0.5 <= angle <= 1.0 or 2.0 <= angle <= 2.5 else EMPTY

    works = openings_at(region, (0.0, 3.0), box(-0.1, -0.1, 0.1, 0.1), (0.0, 0.0)).works
    assert np.array(works) == pytest.approx(np.array([(0.5, 1.0), (2.0, 2.5)]), abs=2e-4)
