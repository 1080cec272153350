"""Numbers of validity against the documented ones, closed forms and a pressure offset that is covered."""

from math import degrees, hypot, inf, radians

import pytest

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import Circle
from palmar.mechanics.pushing.inertia import coasting, drift, inertia_ratio, rate_for
from palmar.mechanics.pushing.toppling import nearest_edge, toppling_height
from palmar.models.case_file import parse_case
from palmar.models.closure import Closure
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.regions.exact import settle
from palmar.studies.pace import pace
from palmar.studies.pressure_offset import OffsetEffect, allowed_along_rays, offset_effect
from palmar.studies.validity import edge_contact, validity

TEXT = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nradius_mm = 38\n[support]\nfriction = {}\n"


def structural(name):
    case = settle(open_case(name)[1], Closure.STRUCTURAL)
    return case, build_region(case)


@pytest.mark.parametrize(
    ("rate", "ratio", "coasts", "drifts"),
    [(10, 0.0025, 0.31, 0.69), (20, 0.0101, 1.23, 2.75), (30, 0.0227, 2.77, 6.19)],
)
def test_the_table_of_the_assumptions(rate, ratio, coasts, drifts):
    omega = radians(rate)
    assert inertia_ratio(omega, 0.244, 0.3) == pytest.approx(ratio, abs=6e-5)
    assert 1e3 * coasting(omega, 0.244, 0.3) == pytest.approx(coasts, abs=6e-3)
    assert 1e3 * drift(omega, 0.1645, 0.244, 0.0505, 0.3) == pytest.approx(drifts, abs=6e-3)


def test_they_grow_with_the_square_of_the_rate_and_have_limits():
    assert coasting(2.0, 0.1, 0.3) == pytest.approx(4.0 * coasting(1.0, 0.1, 0.3))
    limit = rate_for(coasting(1.0, 0.1, 0.3), 0.005, 1.0)
    assert coasting(limit, 0.1, 0.3) == pytest.approx(0.005)
    assert inertia_ratio(1.0, 1.0, 0.0) == coasting(1.0, 1.0, 0.0) == drift(1.0, 0.1, 0.2, 0.05, 0.0) == inf


def test_toppling_is_a_balance_of_moments():
    mass, gravity, edge, friction = 2.0, 9.81, 0.03, 0.4
    height = toppling_height(edge, friction)
    assert mass * gravity * friction * height == pytest.approx(mass * gravity * edge)
    assert toppling_height(edge, friction, 9.81) == pytest.approx(edge / 1.4)
    assert toppling_height(edge, 0.0) == inf
    square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    assert nearest_edge(square, (0.0, 0.0)) == pytest.approx(1.0)
    assert nearest_edge(square, (0.75, 0.0)) == pytest.approx(0.25)
    assert nearest_edge(square, (2.0, 0.0)) < 0.0


def test_on_a_link_speed_and_acceleration_have_closed_forms():
    for name, rho in (("testbed_table", 0.038), ("testbed_table_thick", 0.0505)):
        case, region = structural(name)
        found = pace(case, region.centre)
        assert found.push_speed == pytest.approx(0.244, rel=1e-3)
        assert found.push_acceleration == pytest.approx(hypot(0.244, rho), rel=5e-3)


def test_the_outermost_disk_caught_begins_where_it_is_documented():
    for name, r0 in (("testbed_table_thick", 0.1645), ("chapter3_example", 1.17568)):
        case, region = structural(name)
        assert edge_contact(case, case.object.radius, region) == pytest.approx(r0, rel=1e-3)


def test_the_test_bed_is_quasi_static_at_its_rate_and_not_at_three_times_that():
    case, region = structural("testbed_table_thick")
    slow = validity(case, region).quasi_static
    assert slow.holds and slow.verdict == "quasi-static"
    assert 1e3 * slow.drift == pytest.approx(6.19, abs=0.03)
    assert 30.0 < degrees(slow.rate_limit) < 35.0
    fast = case.model_copy(update={"hand": case.hand.model_copy(update={"finger_rate": radians(120.0)})})
    assert "does not apply" in validity(fast, region).quasi_static.verdict


def test_a_smooth_table_never_is_and_a_range_counts_at_its_worst():
    for friction in ("0", '"0..0.5"'):
        case = parse_case(TEXT.format(friction))
        found = validity(case, build_region(case)).quasi_static
        assert not found.holds and found.rate_limit == 0.0 and found.ratio == inf
    case = parse_case(TEXT.format('"0.2..0.5"'))
    low, high = (parse_case(TEXT.format(value)) for value in ("0.2", "0.5"))
    region = build_region(case)
    assert validity(case, region).quasi_static == validity(low, region).quasi_static
    assert validity(case, region).toppling.height == pytest.approx(validity(high, region).toppling.height, rel=1e-3)


def test_the_rays_find_the_allowed_error_of_the_region():
    case = open_case("testbed_table")[1]
    circle = build_region(case).allowed_error
    assert allowed_along_rays(case, circle) == pytest.approx(circle.radius, rel=1e-3)
    wider = Circle(circle.centre, 1.3 * circle.radius)
    assert allowed_along_rays(case, wider) == pytest.approx(circle.radius, rel=0.02)
    assert allowed_along_rays(case, Circle((1.0, 1.0), 0.1)) == 0.0


def test_an_offset_is_judged_by_simulation_or_refused():
    case = open_case("testbed_table")[1]
    circle = build_region(case).allowed_error
    try:
        found = offset_effect(case, circle, 0.005)
    except NotCoveredError as error:
        assert "pressure" in str(error)
    else:
        assert 0.0 < found.allowed <= circle.radius
    assert OffsetEffect(0.002, 0.09, 0.1).lost_per_offset == pytest.approx(5.0)
