"""All limit surfaces: exact polygons, cells, points and the ellipsoid; metrics, majorisation, inverse."""

from math import inf

import numpy as np
import pytest

from palmar.geometry.polygon import area_centroid
from palmar.mechanics.pushing import ellipsoid
from palmar.mechanics.pushing.ellipsoid import characteristic_length
from palmar.mechanics.pushing.limit_surface import (
    disk_surface,
    ellipsoid_surface,
    polygon_surface,
    sampled_surface,
    secant_metric,
    tangent_metric,
    twist,
    wrench,
)
from palmar.mechanics.pushing.metric import inverse, times
from palmar.mechanics.pushing.pressure_cells import (
    PressureShape,
    disk_cells,
    leaned,
    polygon_cells,
    shaped,
    triangle_rule,
)

CORNERS = np.array([[-0.03, -0.04], [0.05, -0.03], [0.02, 0.05], [-0.03, 0.04]])
QUAD = CORNERS - area_centroid(CORNERS)
TRIPOD = np.array([[0.05, 0.0], [-0.025, 0.04], [-0.025, -0.04]]), np.full(3, 1.0 / 3.0), np.zeros(3)
SURFACES = {
    "ellipsoid": ellipsoid_surface(0.03),
    "disk": disk_surface(0.05),
    "polygon": polygon_surface(QUAD),
    "cells": sampled_surface(polygon_cells(QUAD, 1.0)),
    "ring": sampled_surface(disk_cells(0.05, inf)),
    "points": sampled_surface(TRIPOD),
}


def full(metric):
    xx, xy, yy, xw, yw, ww = metric
    return np.array([[xx, xy, xw], [xy, yy, yw], [xw, yw, ww]])


def twists(count, seed=0):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(count, 3)) * np.array([1.0, 1.0, 1.0]) * [1, 1, 0] + np.stack(
        [np.zeros(count), np.zeros(count), rng.normal(size=count) * 10.0 ** rng.uniform(-1.0, 3.0, count)], axis=1
    )


def power(surface, nu):
    return float(np.dot(wrench(surface, *nu), nu))


@pytest.mark.parametrize("name", SURFACES)
def test_both_metrics_map_the_motion_to_its_load_and_are_positive_definite(name):
    surface = SURFACES[name]
    for nu in twists(25):
        load = np.array(wrench(surface, *nu))
        for metric in (secant_metric(surface, *nu), tangent_metric(surface, *nu)):
            assert times(metric, *nu) == pytest.approx(load, abs=1e-11)
            assert np.linalg.eigvalsh(full(metric)).min() > 0.0
            assert full(inverse(metric)) @ full(metric) == pytest.approx(np.eye(3), abs=1e-6)


@pytest.mark.parametrize("name", SURFACES)
def test_the_tangent_metric_is_the_hessian_of_half_the_squared_power(name):
    surface = SURFACES[name]
    for nu in twists(10, 1):
        size = np.hypot(nu[0], nu[1]) + 0.03 * abs(nu[2])
        steps = 1e-5 * size * np.array([1.0, 1.0, 1.0 / 0.03])
        columns = []
        for d in np.diag(steps):
            plus, minus = (power(surface, nu + s * d) * np.array(wrench(surface, *(nu + s * d))) for s in (1, -1))
            columns.append((plus - minus) / (2.0 * d.sum()))
        scale = np.outer([1.0, 1.0, 0.03], [1.0, 1.0, 0.03])
        expected = np.array(columns) / power(surface, nu) / scale
        found = full(tangent_metric(surface, *nu)) / scale
        assert found == pytest.approx(expected, abs=1e-4 * np.abs(expected).max())


@pytest.mark.parametrize("name", SURFACES)
def test_the_secant_metric_majorises_the_power(name):
    surface = SURFACES[name]
    pairs = twists(60, 2)
    for old, new in zip(pairs[::2], pairs[1::2], strict=True):
        bound = 0.5 * (new @ full(secant_metric(surface, *old)) @ new + power(surface, old))
        assert power(surface, new) <= bound * (1.0 + 1e-12)


@pytest.mark.parametrize("name", SURFACES)
def test_motion_from_load_reproduces_the_load(name):
    surface = SURFACES[name]
    rng = np.random.default_rng(3)
    for _ in range(25):
        load = rng.normal(size=3) * [1.0, 1.0, surface.length]
        nu = np.array(twist(surface, *load))
        if name != "points":  # three points: most loads turn it about one of them, whose friction is not determined
            assert power(surface, nu) * np.array(wrench(surface, *nu)) == pytest.approx(load, abs=1e-8)
        value = 0.5 * power(surface, nu) ** 2 - nu @ load
        for step in np.vstack((np.eye(3), -np.eye(3))) * [1e-3, 1e-3, 1e-2]:
            assert 0.5 * power(surface, nu + step) ** 2 - (nu + step) @ load >= value - 1e-9


def test_the_ellipsoid_in_closed_form_both_ways():
    c = SURFACES["ellipsoid"].length
    for nu in twists(20, 7):
        load = np.array(ellipsoid.wrench(c, *nu))
        assert load[0] ** 2 + load[1] ** 2 + (load[2] / c) ** 2 == pytest.approx(1.0)
        assert load == pytest.approx(wrench(SURFACES["ellipsoid"], *nu), abs=1e-14)
        assert np.array(ellipsoid.twist(c, *load)) * power(SURFACES["ellipsoid"], nu) == pytest.approx(nu, rel=1e-12)


def test_the_exact_polygon_agrees_with_fine_cells():
    fine = sampled_surface(polygon_cells(QUAD, rings=250, around=1000))
    for nu in twists(12, 4):
        apart = np.array(wrench(SURFACES["polygon"], *nu)) - wrench(fine, *nu)
        assert apart / [1.0, 1.0, 0.05] == pytest.approx(np.zeros(3), abs=5e-6)


def test_the_polygon_with_many_corners_is_the_disk():
    angles = np.arange(2000) * 2.0 * np.pi / 2000
    round_one = polygon_surface(0.05 * np.stack((np.cos(angles), np.sin(angles)), axis=1))
    for nu in twists(6, 5):
        apart = np.array(wrench(round_one, *nu)) - wrench(SURFACES["disk"], *nu)
        assert apart / [1.0, 1.0, 0.05] == pytest.approx(np.zeros(3), abs=5e-6)


@pytest.mark.parametrize("distance", [0.0, 1.0])
def test_centres_of_rotation_on_a_corner_or_an_edge_are_regular(distance):
    cx, cy = (1.0 - 0.5 * distance) * QUAD[1] + 0.5 * distance * QUAD[2]
    exact, near = wrench(SURFACES["polygon"], cy, -cx, 1.0), wrench(SURFACES["polygon"], cy + 1e-9, -cx + 1e-9, 1.0)
    assert exact == pytest.approx(near, abs=1e-6)
    assert np.all(np.isfinite(tangent_metric(SURFACES["polygon"], cy, -cx, 1.0)))


def test_near_and_far_forms_of_the_polygon_meet():
    surface = SURFACES["polygon"]
    turn = 1.0 / (60.0 * surface.length)
    inside, outside = (np.array(wrench(surface, 0.6, 0.8, turn * side)) for side in (1.0 + 1e-9, 1.0 - 1e-9))
    assert (inside - outside) / [1.0, 1.0, surface.length] == pytest.approx(np.zeros(3), abs=1e-10)


def test_cells_converge_faster_than_points():
    def error(rings, spread):
        points, weights, spreads = disk_cells(0.05, 0.0, rings, 4 * rings)
        surface = sampled_surface((points, weights, spread * spreads))
        apart = [
            np.subtract(wrench(surface, *nu), wrench(SURFACES["disk"], *nu)) for nu in twists(200, 6) * [1, 1, 0.1]
        ]
        return float(np.sqrt(np.mean((np.array(apart) / [1.0, 1.0, 0.05]) ** 2)))

    assert error(6, 1.0) < 2e-3
    assert error(6, 1.0) < 0.6 * error(6, 0.0)
    assert np.log2(error(6, 1.0) / error(12, 1.0)) > 1.5


def test_characteristic_lengths():
    points, weights, _ = disk_cells(0.05, rings=60, around=240)
    assert characteristic_length(points, weights) == pytest.approx(2.0 / 3.0 * 0.05, rel=1e-4)
    assert SURFACES["ring"].length == pytest.approx(0.05, rel=2e-3)
    for exponent in (-1.0, 1.0, 4.0):
        ideal = 0.05 * (exponent + 2.0) / (exponent + 3.0)
        assert sampled_surface(disk_cells(0.05, exponent, 24, 96)).length == pytest.approx(ideal, rel=2e-3)
    assert wrench(SURFACES["polygon"], 0.0, 0.0, 1.0)[2] == pytest.approx(SURFACES["polygon"].length, rel=1e-12)


def test_the_triangle_rule_is_exact_to_the_fifth_degree():
    points, weights, _ = triangle_rule(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))
    x, y = points.T
    assert weights.sum() == pytest.approx(1.0)
    assert weights @ (x**3 * y**2) == pytest.approx(2.0 * 6 * 2 / 5040, abs=1e-15)  # 2 a! b! / (a + b + 2)!


def test_leaned_and_shaped_pressure():
    cells = polygon_cells(QUAD)
    points, weights, _ = leaned(cells, (0.004, -0.002))
    assert weights @ points == pytest.approx([0.004, -0.002], abs=1e-12)
    assert weights.min() > 0.0
    ends = shaped(disk_cells(0.05), PressureShape(stretch=3.0), 0.05)
    assert ends[1].sum() == pytest.approx(1.0)
    assert ends[1] @ ends[0][:, 0] ** 2 > 3.0 * (ends[1] @ ends[0][:, 1] ** 2)


@pytest.mark.parametrize("part", [0.0, 0.5, 0.9, 0.93])
def test_pressure_leans_nearly_to_the_rim(part):
    for angle in (0.0, 0.1, 2.0):
        goal = part * 0.05 * np.array([np.cos(angle), np.sin(angle)])
        points, weights, _ = leaned(disk_cells(0.05, 0.0, 8, 32), goal)
        assert weights @ points == pytest.approx(goal, abs=1e-12)
        assert weights.min() >= 0.0


@pytest.mark.parametrize("part", [0.96, 1.0, 2.0, 1e6])
def test_a_centre_outside_the_cells_is_refused(part):
    for cells in (disk_cells(0.05, 0.0, 8, 32), polygon_cells(QUAD)):
        with pytest.raises(ValueError, match="too far out"):
            leaned(cells, (part * 0.05, 0.0))
