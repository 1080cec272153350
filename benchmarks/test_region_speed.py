"""Regions: one hand after the other."""

import numpy as np
import pytest

from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.closing_tables import ClosingHand, build_tables
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.limit_surface import disk_surface
from palmar.mechanics.pushing.polygon_contacts import polygon_body
from palmar.models.closure import Closure
from palmar.models.shipped import open_case
from palmar.regions.build import build_region, published_region
from palmar.regions.certified import certified_sets
from palmar.regions.closing_exact import exact_sides
from palmar.regions.closing_sampled import sampled_sets

CASE = open_case("testbed_table")[1]
HAND = ClosingHand(0.06, 0.244, 0.0, 0.038, 0.7, 0.0, np.pi)
SURFACE = disk_surface(0.038)


def test_published_region(benchmark):
    benchmark(published_region, CASE, Closure.FRICTIONAL)


@pytest.mark.parametrize("half_thickness", [0.0, 0.0125])
def test_closed_form_sides_with_their_tables(benchmark, half_thickness):
    """Inner and outer side of the centre region to 1e-4 of the finger's length."""
    hand = HAND._replace(half_thickness=half_thickness, last=np.pi - np.arcsin(half_thickness / 0.244))
    benchmark(lambda: exact_sides(hand, build_tables(hand, SURFACE, spin=False), 2.44e-5))


def test_exact_region_with_all_its_sets(benchmark):
    benchmark(build_region, CASE)


def test_sampled_region_of_a_square(benchmark):
    body = polygon_body(np.array([[-0.03, -0.03], [0.03, -0.03], [0.03, 0.03], [-0.03, 0.03]]), 0.7)
    motion = straight_motion(CASE.hand)
    benchmark(sampled_sets, motion, body, (0.0, 0.0), np.array([0.3]), 0.004)


def test_sampled_region_of_a_rectangle_at_all_orientations(benchmark):
    """72 orientations, starts 7.3 mm apart; a rectangle is the same after half a turn and in the mirror."""
    body = polygon_body(np.array([[-0.04, -0.027], [0.04, -0.027], [0.04, 0.027], [-0.04, 0.027]]), 0.7)
    motion, thetas = straight_motion(CASE.hand), np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
    benchmark.pedantic(sampled_sets, (motion, body, (0.0, 0.0), thetas, 0.0075), rounds=5, warmup_rounds=1)


def test_sampled_region_of_an_odd_polygon_at_all_orientations(benchmark):
    """The same without any symmetry."""
    corners = np.array([[-0.035, -0.025], [0.038, -0.03], [0.03, 0.028], [-0.022, 0.033]])
    body = polygon_body(corners - np.array([0.0036, 0.0011]), 0.7)
    motion, thetas = straight_motion(CASE.hand), np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
    benchmark.pedantic(sampled_sets, (motion, body, (0.0, 0.0), thetas, 0.0075), rounds=3, warmup_rounds=1)


def test_certified_region_of_a_bent_hand(benchmark):
    """A band of at most 1 % of the inner area."""
    benchmark.pedantic(certified_sets, (hand_motion(0.06, [0.137, 0.107], 0.0125, offsets=[0.4]), 0.038), rounds=3)
