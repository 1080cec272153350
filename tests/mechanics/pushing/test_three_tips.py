import numpy as np
import pytest

from palmar.mechanics.pushing.push import Pusher, push
from palmar.mechanics.pushing.slider import disk_slider
from palmar.mechanics.pushing.three_tips import (
    AXES,
    CAGE,
    WITHIN,
    distance_apart,
    drift,
    ends,
    first_touches,
    leans,
    lost_way,
    squeezed_place,
    ways,
)
from palmar.models.outcome import Outcome
from palmar.models.support import Pressure
from palmar.regions.three_tips import tips_drag
from reference.slow_tips import frictionless_ends

RADII = 0.03, 0.01, 0.08, 0.02
RHO = 0.04
SMOOTH = drift(None, 0.0)


def caught(codes):
    return np.isin(codes, [each.code for each in Outcome if each.caught])


def test_a_tip_loses_a_frictionless_disk_after_the_logarithm_of_cot_half_beta():
    beta = np.radians([1e-4, 1.0, 30.0, 89.0])
    np.testing.assert_allclose(ways(SMOOTH, beta), [lost_way(each) for each in beta], rtol=1e-9)
    assert lost_way(WITHIN) == pytest.approx(1.3169578969248166)


@pytest.mark.parametrize("friction", [0.0, 0.05, 0.5])
def test_way_and_lean_are_inverse(friction):
    table = drift(tips_drag(0.03, Pressure.UNIFORM), friction)
    beta = np.geomspace(1e-8, 1.55, 50)
    np.testing.assert_allclose(leans(table, ways(table, beta)), beta, rtol=1e-6)


def test_every_disk_goes_where_small_steps_take_it():
    centres = np.random.default_rng(5).uniform(-0.07, 0.07, (150, 2))
    codes = ends(RADII, 0.0, SMOOTH, centres)
    valid = codes != Outcome.INVALID.code
    inside, last = frictionless_ends(RHO, 0.08, 0.02, centres[valid], 800)
    np.testing.assert_array_equal(caught(codes[valid]), inside)
    assert caught(codes).sum() > 20 and np.abs(last[inside]).max() < 0.004 * RHO


@pytest.mark.parametrize("friction", [0.05, 0.5])
def test_a_tip_with_friction_moves_the_disk_as_the_general_pusher_does(friction):
    table = drift(tips_drag(0.03, Pressure.UNIFORM), friction)
    centres = np.array([[0.004, 0.03], [0.012, 0.02], [-0.001, 0.035]])
    at, beta = first_touches(centres, RHO, 0.08)
    ours = leans(table, ways(table, beta[:, 0]) - (at[:, 0] - CAGE * RHO) / RHO)
    path = np.tile([0.0, 0.08, 0.0, CAGE * RHO], (3, 1))
    poses = push(disk_slider(0.03), Pusher(0.01, friction), np.column_stack([centres, np.zeros(3)]), path).poses
    theirs = np.arctan2(np.abs(poses[:, 0]), CAGE * RHO - poses[:, 1])
    np.testing.assert_allclose(ours, theirs, atol=1e-5)


def test_the_verdict_has_the_symmetry_of_the_triangle():
    centres = np.random.default_rng(6).uniform(-0.07, 0.07, (500, 2))
    table = drift(tips_drag(0.03, Pressure.UNIFORM), 0.4)
    third = np.array([[-0.5, np.sqrt(0.75)], [-np.sqrt(0.75), -0.5]])
    first = ends(RADII, 0.4, table, centres)
    np.testing.assert_array_equal(first, ends(RADII, 0.4, table, centres @ third))
    np.testing.assert_array_equal(first, ends(RADII, 0.4, table, centres * [-1.0, 1.0]))


def test_two_tips_cage_as_their_gap_equals_the_diameter():
    assert distance_apart(CAGE * RHO) == pytest.approx(2.0 * RHO)
    assert squeezed_place(RHO, CAGE * RHO) == pytest.approx(RHO / np.sqrt(3.0))
    assert squeezed_place(RHO, RHO) == pytest.approx(0.0, abs=1e-15)
    narrow, wide = (
        ends((0.03, 0.01, 0.08, CAGE * RHO * each), 0.0, SMOOTH, np.zeros((1, 2))) for each in (0.999, 1.001)
    )
    assert Outcome.from_code(int(narrow[0])) is Outcome.CAGED and Outcome.from_code(int(wide[0])) is Outcome.MISSED


def test_friction_above_tan_30_degrees_lets_a_pair_pinch_every_disk_it_meets_first():
    table = drift(tips_drag(0.03, Pressure.UNIFORM), 0.6)
    off = np.array([[0.004, 0.02], [0.01, -0.01], [0.0, 0.0]])
    pair = ends(RADII, 0.6, table, off)
    assert [Outcome.from_code(int(each)) for each in pair] == [
        Outcome.FRICTIONAL,
        Outcome.FRICTIONAL,
        Outcome.STRUCTURAL,
    ]
    assert (ends(RADII, 0.0, SMOOTH, off) == Outcome.STRUCTURAL.code).all()


def test_the_axes_are_a_third_apart():
    np.testing.assert_allclose(AXES @ AXES.T, 1.5 * np.eye(3) - 0.5, atol=1e-15)
