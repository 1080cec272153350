import numpy as np
import pytest
import shapely

from palmar.mechanics.pushing.three_tips import CAGE, allowed_error, drift, ends, frictionless_area, held_radii
from palmar.models.outcome import Outcome
from palmar.models.support import Pressure
from palmar.models.three_tips import ThreeTips
from palmar.regions.three_tips import tips_drag, tips_region

RHO = 0.04


def tips(opened, closed=0.02):
    return ThreeTips(tip_radius=0.01, open_radius=opened, closed_radius=closed)


@pytest.mark.parametrize("opened", [0.043, 0.05, 0.08, 0.4])
def test_area_and_allowed_error_are_the_closed_forms(opened):
    region = tips_region(tips(opened), 0.03, 0.0)
    assert region.area == pytest.approx(frictionless_area(RHO, opened), rel=2e-3) and region.centre.is_valid
    assert region.area <= frictionless_area(RHO, opened)
    assert region.allowed_error.radius == pytest.approx(allowed_error(RHO, opened, 0.02), rel=3e-3)


def test_however_far_it_opens_the_region_stays_below_a_bound():
    assert frictionless_area(1.0, 50.0) == pytest.approx(np.sqrt(3.0) + np.pi / 2.0)
    assert frictionless_area(1.0, CAGE) == pytest.approx(np.sqrt(3.0) - np.pi / 2.0)


@pytest.mark.parametrize("friction", [0.05, 0.5])
def test_the_region_holds_what_the_kernel_catches(friction):
    region = tips_region(tips(0.08), 0.03, friction)
    centres = np.random.default_rng(3).uniform(-0.07, 0.07, (20_000, 2))
    table = drift(tips_drag(0.03, Pressure.UNIFORM), friction)
    codes = ends((0.03, 0.01, 0.08, 0.02), friction, table, centres)
    caught = np.isin(codes, [each.code for each in Outcome if each.caught])
    inside = shapely.contains_xy(region.centre, centres)
    assert not (inside & ~caught).any()
    assert (caught & ~inside).sum() <= 5


def test_friction_adds_and_from_a_little_on_adds_no_more():
    areas = [tips_region(tips(0.08), 0.03, each).area for each in (0.0, 0.06, 0.13, 1.0)]
    assert areas[0] < areas[1] < areas[2] == pytest.approx(areas[3], rel=1e-9)
    smooth, rough = (tips_region(tips(0.08), 0.03, each).centre for each in (0.0, 0.5))
    assert rough.buffer(1e-6).covers(smooth)


def test_all_lengths_scale():
    half = ThreeTips(tip_radius=0.005, open_radius=0.04, closed_radius=0.01)
    assert tips_region(half, 0.015, 0.3).area == pytest.approx(0.25 * tips_region(tips(0.08), 0.03, 0.3).area, rel=1e-9)


def test_tips_that_stop_too_wide_or_start_too_narrow_catch_nothing():
    assert "stop" in tips_region(tips(0.08, 0.047), 0.03, 0.5).reason
    assert "no room" in tips_region(tips(0.039), 0.03, 0.5).reason
    assert held_radii(0.01, 0.08, 0.047)[0] == pytest.approx(0.047 / CAGE - 0.01)
