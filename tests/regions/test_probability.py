"""Gaussian mass of planar sets against products of normal distribution functions, quadrature and random points."""

from math import exp, pi

import numpy as np
import pytest
import shapely
from scipy.integrate import dblquad
from scipy.special import ndtr
from shapely import MultiPolygon, Polygon, affinity, box

from palmar.models.shipped import open_case
from palmar.regions.best_place import best_place, largest_scale
from palmar.regions.build import build_region
from palmar.regions.probability import chance, edges_of, probability

SLANTED = np.array([[0.5, 0.2], [0.2, 0.3]])


def in_box(bounds, mean, sigmas):
    left, low, right, high = bounds
    across = ndtr((right - mean[0]) / sigmas[0]) - ndtr((left - mean[0]) / sigmas[0])
    return across * (ndtr((high - mean[1]) / sigmas[1]) - ndtr((low - mean[1]) / sigmas[1]))


@pytest.mark.parametrize("mean", [(0.3, 0.4), (-1.0, 0.4), (-1.0, -0.5), (5.0, 7.0), (1.9999, 2.9999)])
def test_a_box_is_a_product_of_normal_distribution_functions(mean):
    bounds, sigmas = (-1.0, -0.5, 2.0, 3.0), (0.7, 1.3)
    found = probability(MultiPolygon([box(*bounds)]), mean, np.diag(np.square(sigmas)))
    assert found == pytest.approx(in_box(bounds, mean, sigmas), abs=1e-13)


def test_a_disk_about_the_mean_is_rayleigh():
    disk = MultiPolygon([shapely.Point(0, 0).buffer(1.5, quad_segs=4000)])
    assert probability(disk, (0.0, 0.0), np.eye(2)) == pytest.approx(1.0 - exp(-(1.5**2) / 2.0), abs=1e-7)


def test_a_slanted_error_against_quadrature_over_a_triangle():
    triangle, mean = Polygon([(0, 0), (2, 0), (0, 1.5)]), (0.4, 0.7)
    inverse, scale = np.linalg.inv(SLANTED), 1.0 / (2.0 * pi * np.sqrt(np.linalg.det(SLANTED)))

    def density(y, x):
        away = np.array([x, y]) - mean
        return scale * np.exp(-0.5 * away @ inverse @ away)

    expected, _ = dblquad(density, 0.0, 2.0, 0.0, lambda x: 1.5 * (1.0 - x / 2.0), epsabs=1e-10)
    assert probability(MultiPolygon([triangle]), mean, SLANTED) == pytest.approx(expected, abs=1e-9)


def test_holes_and_parts_add_up():
    whole, hole = box(-2, -2, 2, 2), box(-0.5, -0.3, 0.2, 0.4)
    far = box(3, 0, 4, 1)
    parts = [probability(MultiPolygon([each]), (0.1, 0.2), SLANTED) for each in (whole, hole, far)]
    together = MultiPolygon([Polygon(whole.exterior, [hole.exterior]), far])
    assert probability(together, (0.1, 0.2), SLANTED) == pytest.approx(parts[0] - parts[1] + parts[2], abs=1e-13)


def test_parts_that_share_an_edge_are_one_set():
    halves = MultiPolygon([box(-1, -1, 0, 1), box(0, -1, 1, 1)])
    whole = MultiPolygon([box(-1, -1, 1, 1)])
    factor = np.linalg.cholesky(SLANTED)
    one, other = (chance(edges_of(each), np.zeros(2), factor) for each in (halves, whole))
    assert one.inside == pytest.approx(other.inside, abs=1e-14)
    assert one.outside == pytest.approx(1.0 - other.inside, abs=1e-14)


def test_turning_and_scaling_set_and_error_together_changes_nothing():
    region = build_region(open_case("testbed_table")[1]).centre
    turn = 3.0 * np.array([[np.cos(0.4), -np.sin(0.4)], [np.sin(0.4), np.cos(0.4)]])
    moved = affinity.affine_transform(region, [*turn[0], *turn[1], 0.0, 0.0])
    covariance = 1e-3 * SLANTED
    one = probability(region, (0.05, 0.1), covariance)
    assert probability(moved, tuple(turn @ (0.05, 0.1)), turn @ covariance @ turn.T) == pytest.approx(one, abs=1e-12)


def test_a_small_loss_keeps_its_digits():
    square = edges_of(MultiPolygon([box(-8, -8, 8, 8)]))
    assert chance(square, np.zeros(2), np.eye(2)).outside == pytest.approx(4.0 * ndtr(-8.0), rel=1e-9)


def test_the_region_of_the_test_bed_against_random_points():
    region = build_region(open_case("testbed_table")[1]).centre
    covariance = np.array([[0.10**2, 0.002], [0.002, 0.06**2]])
    points = np.random.default_rng(5).multivariate_normal((0.1, 0.12), covariance, 1_000_000)
    share = shapely.contains_xy(region, points).mean()
    assert probability(region, (0.1, 0.12), covariance) == pytest.approx(share, abs=4.0 * np.sqrt(0.25 / 1e6))


def test_the_gradient_against_differences():
    edges = edges_of(build_region(open_case("testbed_table")[1]).centre)
    factor, at, step = np.linalg.cholesky(np.array([[0.01, 0.002], [0.002, 0.004]])), np.array([0.1, 0.05]), 1e-6
    for axis in np.eye(2):
        ahead, behind = (chance(edges, at + sign * step * axis, factor).inside for sign in (1.0, -1.0))
        assert chance(edges, at, factor).gradient @ axis == pytest.approx((ahead - behind) / (2.0 * step), abs=1e-7)


def test_the_best_place_is_the_middle_of_a_box_and_no_grid_point_beats_it():
    found = best_place(MultiPolygon([box(0.0, 1.0, 2.0, 5.0)]), np.linalg.cholesky(SLANTED))
    assert found.at == pytest.approx((1.0, 3.0), abs=1e-4)
    region, factor = build_region(open_case("testbed_table")[1]).centre, np.diag([0.05, 0.06])
    best, edges = best_place(region, factor), edges_of(region)
    assert best.at[0] == pytest.approx(0.0, abs=1e-6)
    grid = [(x, y) for x in np.linspace(-0.05, 0.05, 11) for y in np.linspace(0.1, 0.2, 51)]
    assert best.inside >= max(chance(edges, np.array(each), factor).inside for each in grid)


def test_a_small_error_is_best_placed_in_the_inscribed_circle():
    region = build_region(open_case("testbed_table")[1])
    assert best_place(region.centre, 1e-3 * np.eye(2)).at == pytest.approx(region.allowed_error.centre, abs=1e-4)


def test_the_scale_that_leaves_99_percent():
    square = MultiPolygon([box(-1, -1, 1, 1)])
    for wanted in (0.99, 0.999):
        scale = largest_scale(square, 0.1 * np.eye(2), wanted, (0.0, 0.0))
        assert in_box((-1, -1, 1, 1), (0, 0), (0.1 * scale, 0.1 * scale)) == pytest.approx(wanted, abs=1e-5)
        assert largest_scale(square, 0.1 * np.eye(2), wanted, None) == pytest.approx(scale, rel=1e-4)
    assert largest_scale(square, np.eye(2), 0.99, (3.0, 0.0)) is None
