"""The exact region of disks against the kernel that closes on single starts, and known numbers."""

from math import pi, radians, tan

import numpy as np
import pytest
import shapely

from palmar.errors import NotCoveredError
from palmar.geometry.straight_finger import last_angle
from palmar.mechanics.pushing.closing import close_disk
from palmar.mechanics.pushing.closing_tables import ClosingHand, build_tables
from palmar.mechanics.pushing.limit_surface import disk_surface
from palmar.models.case_file import build_case, parse_case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.regions.closing_exact import exact_sets
from palmar.regions.exact import exact_region
from palmar.regions.region import Model

EXAMPLE = open_case("chapter3_example")[1]


@pytest.mark.parametrize(("angle", "delta", "area"), [(0.0, 10.017, 5.286), (35.0, 25.100, 6.026)])
def test_the_example_of_chapter_3(angle, delta, area):
    hand = ClosingHand(1.0, 2.0, 0.0, 0.5, tan(radians(angle)), 0.0, pi)
    sets = exact_sets(hand, build_tables(hand, disk_surface(0.5), spin=False), 2e-6)
    assert sets.centre.area == pytest.approx(area, rel=1e-3)
    assert sets.centre.area < sets.outer.area < sets.centre.area * (1.0 + 1e-5)
    ((tau, end),) = sets.ways
    sweep = pi - np.arccos((1.0 - 0.5 * np.cos(radians(angle))) / 2.0)
    assert end is None
    assert tau == pytest.approx(sweep - radians(delta), abs=1e-5)
    for x in (2.0 + tau * 0.0, 0.3):
        assert sets.centre.contains(shapely.Point(x, 0.51))


def test_the_edges_on_the_palm_line():
    for friction, inside, outside in ((0.0, 2.1754, 2.1760), (tan(radians(35.0)), 2.2835, 2.2841)):
        hand = ClosingHand(1.0, 2.0, 0.0, 0.5, friction, 0.0, pi)
        sets = exact_sets(hand, build_tables(hand, disk_surface(0.5), spin=False), 2e-6)
        assert sets.centre.contains(shapely.Point(inside, 0.5 + 1e-9))
        assert not sets.outer.intersects(shapely.Point(outside, 0.5 + 1e-9))


def random_hand(rng):
    d, h = rng.uniform(0.15, 1.6), rng.choice([0.0, 0.0, rng.uniform(0.0, 0.15)])
    crossing, first = rng.random() < 0.6, rng.choice([0.0, 0.0, rng.uniform(0.0, 1.5)])
    last = float(last_angle(d, 1.0, h, crossing, rng.choice([pi, pi, rng.uniform(first + 0.1, pi)])))
    radius, friction = rng.uniform(0.03, 1.3) * min(d, 1.2), rng.choice([0.0, rng.uniform(0.0, 1.0)])
    return ClosingHand(d, 1.0, h, radius, friction, first, max(last, first + 0.01))


@pytest.mark.parametrize("seed", range(4))
def test_inside_everything_is_caught_and_outside_nothing(seed):
    rng = np.random.default_rng(seed)
    for _ in range(25):
        hand = random_hand(rng)
        surface = disk_surface(hand.radius)
        tables = build_tables(hand, surface, spin=False)
        sets = exact_sets(hand, tables, 1e-5)
        reach = hand.half_palm + 1.0
        starts = np.column_stack(
            [rng.uniform(-reach, reach, 4000), rng.uniform(hand.radius, 1.0 + 2 * hand.radius, 4000)]
        )
        caught = close_disk(hand, surface, starts, tables).codes <= Outcome.CAGED.code
        assert caught[shapely.contains_xy(sets.centre, starts)].all()
        assert not caught[~shapely.contains_xy(sets.outer.buffer(1e-9), starts)].any()


@pytest.mark.parametrize("half_thickness", [0.0, 0.06])
@pytest.mark.parametrize(("radius", "first"), [(0.03, 0.0), (0.3, 0.4)])
def test_inner_and_outer_side_are_no_farther_apart_than_said(half_thickness, radius, first):
    hand = ClosingHand(0.5, 1.0, half_thickness, radius, 0.6, first, 2.6)
    sets = exact_sets(hand, build_tables(hand, disk_surface(radius), spin=False), 1e-4)
    assert 0.0 < sets.flattening <= 1e-4
    corners = shapely.get_coordinates(shapely.segmentize(sets.outer.boundary, 0.01))
    # Where the boundary meets its mirror image at an angle, the corner moves farther than the lines.
    beside = shapely.points(corners[np.abs(corners[:, 0]) > 0.02])
    assert shapely.distance(beside, sets.centre.boundary).max() <= 2.0 * sets.flattening


def test_the_published_region_promises_what_the_exact_one_does_not_keep():
    exact, published = (build_region(EXAMPLE, model) for model in (Model.EXACT, Model.PUBLISHED))
    for start in ((2.3, 0.5 + 1e-9), (1.1, 2.0)):
        assert published.centre.contains(shapely.Point(start))
        assert not exact.outer.contains(shapely.Point(start))


def test_a_range_of_friction_is_its_lowest_value():
    text = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nradius_mm = 38\n[contact]\nfriction = {}\n"
    ranged, low = (build_region(parse_case(text.format(value))) for value in ('"0.2..0.8"', "0.2"))
    assert ranged.centre.equals(low.centre)
    assert ranged.guarantee is Guarantee.CLOSED_FORM


@pytest.mark.parametrize(
    ("radius", "closure", "said"),
    [(90, Closure.STRUCTURAL, "too large"), (700, Closure.FRICTIONAL, "too large")],
)
def test_an_empty_region_has_a_reason(radius, closure, said):
    text = f"[hand]\npalm_width_mm = 100\nfinger_links_mm = [100]\n[object]\nradius_mm = {radius}\n"
    region = build_region(parse_case(text), closure=closure)
    assert region.centre.is_empty and region.outer.is_empty
    assert said in region.reason


def test_what_no_method_covers_is_refused():
    with pytest.raises(NotCoveredError, match="free"):
        exact_region(open_case("testbed_free")[1])


def test_a_speck_has_its_region_soon_flattened_more_than_asked_and_says_so():
    def region(radius_mm):
        return build_region(
            build_case({"hand": {"palm_width_mm": 120, "finger_links_mm": [100]}, "object": {"radius_mm": radius_mm}})
        )

    small, speck = region(0.1), region(0.005)
    assert small.flattening < 1e-6 < speck.flattening < 5e-4
    assert 0.98 * small.area < speck.area < speck.outer.area < 1.02 * small.area
