from math import atan, cos, inf, pi, radians, sin, tan

import numpy as np
import pytest
from scipy.optimize import linprog

from palmar.mechanics.pushing.cylinder_toppling import (
    loads,
    push_heights,
    rim_bands,
    rim_lean,
    steepest_landing,
    toppling_height,
    toppling_slope,
)
from palmar.mechanics.pushing.inertia import GRAVITY
from palmar.mechanics.pushing.toppling import toppling_height as pushed_height

R, MASS = 0.03, 0.2


def greatest_force(table_friction, z, back, angle):
    """By a linear programme: the largest force that two base edges, each within its friction cone, can balance."""
    weight, x = MASS * GRAVITY, R - back
    px, py = sin(angle), -cos(angle)
    # unknown: force, normal and tangential load at the base's edges -R and R; moments about the middle of the base
    balance = [[px, 0, 0, 1, 1], [py, 1, 1, 0, 0], [x * py - z * px, -R, R, 0, 0]]
    cones = [[0, -table_friction, 0, s, 0] for s in (1, -1)] + [[0, 0, -table_friction, 0, s] for s in (1, -1)]
    bounds = [(0, None), (0, None), (0, None), (None, None), (None, None)]
    found = linprog([-1, 0, 0, 0, 0], cones, np.zeros(4), balance, [0.0, weight, 0.0], bounds)
    return inf if found.status == 3 else found.x[0]


@pytest.mark.parametrize("seed", range(12))
def test_loads_are_those_of_a_linear_programme(seed):
    rng = np.random.default_rng(seed)
    table_friction, z, back = rng.uniform(0.1, 0.9), rng.uniform(0.01, 0.2), rng.uniform(0.0, 2 * R)
    angle = rng.uniform(0.1, 1.9)
    given = loads(R, MASS, table_friction, (z, back), angle)
    assert min(given) == pytest.approx(greatest_force(table_friction, z, back, angle), rel=1e-6)


def test_a_smooth_push_topples_above_radius_over_friction():
    heights = push_heights(R, 0.3, 0.5)
    assert heights == pytest.approx((0.085, 0.1, 0.115)) and heights.smooth == pushed_height(R, 0.3)
    assert loads(R, MASS, 0.3, (0.099, 2 * R), pi / 2).first == "slides"
    assert loads(R, MASS, 0.3, (0.101, 2 * R), pi / 2).first == "topples"


@pytest.mark.parametrize("lean", [-0.5, 0.5])
def test_friction_up_or_down_moves_the_height(lean):
    angle = pi / 2 - atan(lean)
    limit = toppling_height(R, 0.3, 2 * R, angle)
    assert limit == pytest.approx(R / 0.3 + R * lean)
    assert loads(R, MASS, 0.3, (limit - 1e-6, 2 * R), angle).first == "slides"
    assert loads(R, MASS, 0.3, (limit + 1e-6, 2 * R), angle).first == "topples"


def test_a_vertical_force_on_the_top_never_topples():
    assert all(loads(R, MASS, 0.5, (0.2, back), 0.0).first == "stands" for back in np.linspace(0.0, 2 * R, 9))
    steep = atan(steepest_landing(R, 0.2, 0.01))
    assert loads(R, MASS, 9.0, (0.2, R - 0.01), steep - 1e-6).topples == inf
    assert loads(R, MASS, 9.0, (0.2, R - 0.01), steep + 1e-6).topples < inf


@pytest.mark.parametrize(("height", "first"), [(0.05, "slides"), (0.12, "topples"), (0.25, "topples")])
def test_a_round_tip_on_the_rim_lands_slides_or_topples(height, first):
    mu, table = 0.2, 0.35
    bands = rim_bands(R, height, 0.01, (mu, table))
    assert R < bands.lands < bands.blocked <= bands.topples

    def at(distance):
        angle = rim_lean(R, 0.01, distance) - atan(mu)
        return loads(R, MASS, table, (height, 2 * R), angle).first if angle > 0.0 else "stands"

    assert at(bands.blocked - 1e-6) == "stands"
    assert at(0.0399) == first
    if 2 * R / height > table and bands.topples < inf:
        assert (at(bands.topples - 1e-6), at(bands.topples + 1e-6)) == ("slides", "topples")


def test_only_cylinders_higher_than_radius_over_friction_topple_at_the_rim():
    assert toppling_slope(R, 0.0999, 0.3) == inf and toppling_slope(R, 0.11, 0.3) == pytest.approx(3.0)
    assert toppling_slope(R, 0.2, 0.3) == pytest.approx(0.3) == toppling_slope(R, 0.2 + 1e-12, 0.3)
    assert tan(radians(45)) == pytest.approx(toppling_slope(R, 2 * R, 1.0))
