"""Certified regions: against the closed form, against both simulations, and that their bound is needed."""

import math

import numpy as np
import pytest
import shapely

from palmar.mechanics.pushing import certified_start
from palmar.mechanics.pushing.certified_start import CAUGHT, LOST, OPEN, OVERLAPS, certify_all
from palmar.mechanics.pushing.closing_steps import carry_all
from palmar.mechanics.pushing.closing_tables import ClosingHand, build_tables
from palmar.mechanics.pushing.enclosure import closed_from
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.limit_surface import disk_surface
from palmar.mechanics.pushing.polygon_contacts import disk_body
from palmar.models.guarantee import Guarantee
from palmar.regions.certified import certified_region, certified_sets
from palmar.regions.closing_exact import exact_sets
from reference.slow_closing import close_hand
from reference.slow_model import Hand, Object

BENT = (hand_motion(0.4, [0.55, 0.45], offsets=[0.4]), 0.25)
THICK = (hand_motion(0.45, [0.5, 0.5], 0.05, offsets=[0.3], colliding=True), 0.2)
OUTWARDS = (hand_motion(0.5, [0.6, 0.4], offsets=[-0.3], ratios=[0.5]), 0.3)
SLIDING = (hand_motion(0.4, [0.4, 0.3, 0.3], 0.03, first=0.2, offsets=[0.2, 0.3], velocity=(0.1, -0.12)), 0.2)
HANDS = {"bent": BENT, "thick": THICK, "outwards": OUTWARDS, "sliding": SLIDING}


def starts_about(sets, count, rng):
    left, low, right, high = sets.outer.buffer(0.1).bounds
    return np.column_stack([rng.uniform(left, right, count), rng.uniform(low, high, count)])


@pytest.mark.parametrize(
    ("half_palm", "thickness", "radius"), [(0.5, 0.0, 0.25), (0.5, 0.1, 0.2), (1.2, 0.0, 0.6), (0.923, 0.033, 0.219)]
)
def test_a_straight_hand_has_the_closed_form_between_both_sides(half_palm, thickness, radius):
    inner, outer = sets = certified_sets(hand_motion(half_palm, [1.0], thickness), radius, share=0.02)
    closing = ClosingHand(half_palm, 1.0, thickness, radius, 0.0, 0.0, math.pi - math.asin(thickness))
    exact = exact_sets(closing, build_tables(closing, disk_surface(radius), spin=False), 1e-6)
    assert sets.share <= 0.025
    assert (inner - exact.outer).area < 1e-12
    assert (exact.centre - outer).area < 1e-12


@pytest.mark.parametrize("name", HANDS)
def test_fresh_starts_keep_what_is_promised(name):
    motion, radius = HANDS[name]
    sets = certified_sets(motion, radius, share=0.05)
    starts = starts_about(sets, 4000, np.random.default_rng(1))
    inside, outside = shapely.contains_xy(sets.inner, starts), ~shapely.contains_xy(sets.outer, starts)
    codes = carry_all(motion, disk_body(radius, 0.0), starts)[0]
    assert sets.share <= 0.1 and inside.sum() > 300 and outside.sum() > 300
    assert (codes[inside] <= 2).all()
    assert (codes[outside] > 2).all()


def test_the_slow_reference_agrees():
    motion, radius = THICK
    sets = certified_sets(motion, radius, share=0.05)
    starts = starts_about(sets, 400, np.random.default_rng(2))
    inside, outside = shapely.contains_xy(sets.inner, starts), ~shapely.contains_xy(sets.outer, starts)
    end = math.pi - motion.first
    offset, ratio = motion.offsets[0, 1], motion.ratios[0, 1]
    joints = np.array([[motion.first, offset], [math.pi, offset + ratio * end]])
    hand = Hand(
        motion.half_palm, tuple(motion.links), motion.half_thickness, False,
        clock=np.array([motion.first, math.pi]), joints=joints,
    )  # fmt: skip
    for chosen, caught in ((starts[inside][:2], True), (starts[outside][:4], False)):
        for start in chosen:
            outcome = close_hand(hand, Object(radius), 0.0, tuple(start)).outcome
            assert (outcome in ("structural", "frictional", "caged")) == caught or outcome == "invalid"


@pytest.mark.parametrize("name", ["bent", "outwards"])
def test_no_ball_is_certified_that_reaches_over_the_edge(name):
    """Balls about starts near the edge of the region, a little larger than their distance from it."""
    motion, radius = HANDS[name]
    body, closed = disk_body(radius, 0.0), closed_from(motion, radius)
    for height in (radius + 0.15, radius + 0.3):
        low, high = 0.0, 2.0
        for _ in range(40):
            middle = 0.5 * (low + high)
            caught = carry_all(motion, body, np.array([[middle, height]]))[0][0] <= 2
            low, high = (middle, high) if caught else (low, middle)
        away = np.array([1e-3, 1e-2])
        over = np.concatenate(
            [np.column_stack([low + side * away, np.full(2, height), 1.05 * away]) for side in (-1, 1)]
        )
        assert (certify_all(motion, radius, closed, over) == OPEN).all()
        within = over * [1.0, 1.0, 0.1]
        assert certify_all(motion, radius, closed, within).tolist() == [CAUGHT, CAUGHT, LOST, LOST]


def test_what_overlaps_the_open_hand_is_no_start():
    motion, radius = BENT
    assert certify_all(motion, radius, closed_from(motion, radius), np.array([[0.0, 0.1, 0.01]])).tolist() == [OVERLAPS]
    sets = certified_sets(motion, radius, share=0.2)
    assert sets.inner.bounds[1] >= radius - 1e-12


def test_a_region_says_how_far_it_is_to_be_trusted():
    motion, radius = THICK
    region = certified_region(motion, radius, tolerance=0.01)
    assert region.guarantee is Guarantee.CERTIFIED and region.reason is None
    assert region.spacing <= 0.01
    assert 0.0 < region.band < 0.2 * region.area < region.whole.area


def test_nothing_is_caught_that_does_not_fit():
    motion, _ = BENT
    region = certified_region(motion, 1.5)
    assert region.area == 0.0 and region.reason is not None
    assert region.outer.area < 0.01


def test_rows_do_not_depend_on_threads():
    motion, radius = SLIDING
    rng = np.random.default_rng(3)
    starts = np.column_stack([rng.uniform(-0.5, 0.5, 60), rng.uniform(0.2, 1.0, 60), np.full(60, 0.01)])
    closed = closed_from(motion, radius)
    one, two = (certify_all(motion, radius, closed, starts, threads) for threads in (1, 2))
    assert (one == two).all()
    assert set(one.tolist()) <= {OPEN, CAUGHT, LOST, OVERLAPS}
    assert certified_start.ROWS_PER_TASK < 60
