"""Regions from simulated starts: their promise on fresh starts, refinement, orientations, and odd requests."""

from math import pi, radians

import numpy as np
import shapely

from palmar.models.case_file import parse_case
from palmar.models.guarantee import Guarantee
from palmar.regions.disk import disk_sets
from palmar.regions.exact import exact_region
from palmar.studies.simulate import simulate_starts

TEXT = """[hand]
palm_width_mm = 120
finger_links_mm = [244]
[object]
{}
[contact]
friction = {}
[support]
pressure_centre_mm = {}
"""
SQUARE = 'shape = "polygon"\nvertices_mm = [[-28, -28], [28, -28], [28, 28], [-28, 28]]'


def case_of(thing=SQUARE, friction="0.5", offset="[0, 0]"):
    return parse_case(TEXT.format(thing, friction, offset))


def test_fresh_starts_keep_what_a_square_is_promised():
    case = case_of()
    region = exact_region(case, orientations=(0.4, 0.4), spacing=0.012)
    assert region.guarantee is Guarantee.SAMPLED
    assert region.spacing <= 0.012
    assert region.orientations == (0.4, 0.4)
    assert 0.0 < region.certain.area < region.area < region.outer.area
    rng = np.random.default_rng(0)
    starts = np.column_stack([rng.uniform(-0.3, 0.3, 900), rng.uniform(0.0, 0.3, 900), np.full(900, 0.4)])
    caught = simulate_starts(case, starts).codes <= 2
    inside, outside = (
        shapely.contains_xy(region.centre, starts[:, :2]),
        ~shapely.contains_xy(region.outer, starts[:, :2]),
    )
    assert inside.sum() > 200 and outside.sum() > 200
    assert caught[inside].all()
    assert not caught[outside].any()


def test_a_disk_pressed_a_little_off_its_centre_has_almost_the_exact_region():
    disk = "radius_mm = 38"
    exact = disk_sets(case_of(disk), 1e-5)
    region = exact_region(case_of(disk, offset="[0.01, 0]"), spacing=0.012)
    assert exact.outer.buffer(1e-3).contains(region.centre)
    assert region.outer.buffer(1e-3).contains(exact.centre)


def test_all_orientations_leave_less_than_one():
    case = case_of()
    one, some = (exact_region(case, orientations=(0.0, high), spacing=0.024) for high in (0.0, radians(10.0)))
    assert one.outer.contains(some.centre)
    assert some.area < one.area
    assert "3 orientations" in some.notes[0]


def test_a_range_of_friction_is_searched_for_a_polygon():
    ranged = exact_region(case_of(friction='"0.2..0.4"'), spacing=0.03)
    ends = [exact_region(case_of(friction=each), spacing=0.03) for each in ("0.2", "0.4")]
    assert "17 combinations of contact.friction" in ranged.notes[0]
    assert all(each.centre.buffer(1e-9).contains(ranged.centre) for each in ends)


def test_a_range_of_the_pressure_centre_is_not_taken_for_a_centred_one():
    disk = "radius_mm = 38"
    ranged = exact_region(case_of(disk, offset='["-8..8", 0]'), spacing=0.03)
    assert ranged.guarantee is Guarantee.SAMPLED
    assert exact_region(case_of(disk)).outer.buffer(0.01).contains(ranged.centre)
    assert ranged.area < exact_region(case_of(disk, offset="[8, 0]"), spacing=0.03).area + 1e-9


def test_the_region_over_ranges_lies_in_that_of_every_value():
    text = '[hand]\npalm_width_mm = "110..130"\nfinger_links_mm = [244]\n[object]\nradius_mm = "34..40"\n'
    case = parse_case(text)
    region = exact_region(case)
    assert region.guarantee is Guarantee.SAMPLED and not region.centre.is_empty
    rng = np.random.default_rng(1)
    for palm, radius in zip(rng.uniform(0.11, 0.13, 12), rng.uniform(0.034, 0.04, 12), strict=True):
        sets = disk_sets(case.settled([palm, radius]), 1e-5)
        assert sets.outer.buffer(1e-6).contains(region.centre)


def test_a_range_that_empties_the_region_says_for_which_value():
    text = '[hand]\npalm_width_mm = 100\nfinger_links_mm = [100]\n[object]\nradius_mm = "20..400"\n'
    region = exact_region(parse_case(text))
    assert region.centre.is_empty
    assert "for some of the values" in region.reason and "too large" in region.reason


def test_a_full_turn_is_simulated_once():
    region = exact_region(case_of(), orientations=(0.0, 2.0 * pi), spacing=0.1)
    assert "72 orientations 5 deg apart" in region.notes[0]
