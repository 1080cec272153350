"""Motions on true limit surfaces: least power without friction, regularised friction, uniqueness, convergence."""

import numpy as np
import pytest
from scipy.optimize import linprog, minimize, root

from palmar.mechanics.pushing.contact_solve import solve_contacts, workspace
from palmar.mechanics.pushing.limit_surface import (
    disk_surface,
    ellipsoid_surface,
    polygon_surface,
    sampled_surface,
    secant_metric,
    tangent_metric,
    wrench,
)
from palmar.mechanics.pushing.metric import squared
from palmar.mechanics.pushing.motion_solve import JAMMED, NOT_CONVERGED, solve_motion, start_metric
from palmar.mechanics.pushing.pressure_cells import disk_cells, polygon_cells

RADIUS = 0.05
BLOCK = np.array([[0.06, 0.04], [-0.06, 0.04], [-0.06, -0.04], [0.06, -0.04]])
SURFACES = {
    "ellipsoid": ellipsoid_surface(0.03),
    "disk": disk_surface(RADIUS),
    "polygon": polygon_surface(BLOCK),
    "cells": sampled_surface(polygon_cells(BLOCK, 2.0)),
}
SPACE = workspace()
REST = (0.0, 0.0, 0.0)


def solved(surface, contacts, guess=REST):
    contacts = np.atleast_2d(np.asarray(contacts, dtype=float))
    count = solve_motion(surface, contacts, len(contacts), guess, SPACE)
    return count, SPACE.motions[: max(count, 0)].copy()


def random_contacts(rng, count, friction=None):
    bearing = rng.uniform(0.0, 2.0 * np.pi, count)
    normal = bearing + np.pi + 0.5 * rng.normal(size=count)
    contacts = np.zeros((count, 7))
    contacts[:, 0], contacts[:, 1] = RADIUS * np.cos(bearing), RADIUS * np.sin(bearing)
    contacts[:, 2], contacts[:, 3] = np.cos(normal), np.sin(normal)
    contacts[:, 4:6] = rng.normal(size=(count, 2)) + contacts[:, 2:4]
    contacts[:, 6] = rng.choice([0.0, 0.2, 0.5, 1.0], count) if friction is None else friction
    return contacts


def jacobians(contacts):
    rx, ry, nx, ny = contacts[:, :4].T
    return np.stack((nx, ny, rx * ny - ry * nx), axis=1), np.stack((-ny, nx, rx * nx + ry * ny), axis=1)


@pytest.mark.parametrize("friction", [0.0, 0.1, 0.7, 3.0])
@pytest.mark.parametrize("cells", [None, 0.0, 1.0, -1.0])
def test_one_contact_on_the_inside_of_a_link_carries_a_disk_along_the_normal_without_turning_it(friction, cells):
    """Findings 1: the link's material moves along its normal; any pressure centred on the disk will do."""
    surface = SURFACES["disk"] if cells is None else sampled_surface(disk_cells(RADIUS, cells))
    n = np.array([np.cos(0.4), np.sin(0.4)])
    count, motions = solved(surface, [*(-RADIUS * n), *n, *(0.3 * n), friction])
    assert count == 1
    assert motions[0, :3] == pytest.approx([*(0.3 * n), 0.0], abs=1e-12)
    assert motions[0, 3:5] == pytest.approx([1.0, 0.0], abs=1e-9)


@pytest.mark.parametrize("name", SURFACES)
def test_loads_of_every_motion_balance_the_friction_with_the_table(name):
    rng, surface = np.random.default_rng(1), SURFACES[name]
    for count in (1, 2, 3):
        for _ in range(40):
            contacts = random_contacts(rng, count)
            found, motions = solved(surface, contacts)
            assert found != NOT_CONVERGED
            normals, tangents = jacobians(contacts)
            for row in motions:
                total = row[3 : 3 + 2 * count : 2] @ normals + row[4 : 4 + 2 * count : 2] @ tangents
                assert total - wrench(surface, *row[:3]) == pytest.approx(np.zeros(3), abs=1e-7)


@pytest.mark.parametrize("name", ["disk", "polygon"])
def test_without_friction_no_other_motion_that_clears_the_hand_loses_less_power(name):
    cells = disk_cells(RADIUS, 0.0, 40, 160) if name == "disk" else polygon_cells(BLOCK, 0.0, 40, 160)
    (x, y), weights = cells[0].T, cells[1]
    scale = np.array([1.0, 1.0, 1.0 / RADIUS])

    def power(z):
        vx, vy, omega = z * scale
        return weights @ np.hypot(vx - omega * y, vy + omega * x)

    rng, tried = np.random.default_rng(2), 0
    for count in (1, 2, 2, 3, 3):
        contacts = random_contacts(rng, count, 0.0)
        normals = jacobians(contacts)[0]
        speeds = np.sum(contacts[:, 2:4] * contacts[:, 4:6], axis=1)
        possible = linprog(np.zeros(3), -normals, -speeds, bounds=[(None, None)] * 3).status == 0
        found, motions = solved(SURFACES[name], contacts)
        assert found == (1 if possible else JAMMED)
        if possible:
            keep = {"type": "ineq", "fun": lambda z, n=normals, u=speeds: n @ (z * scale) - u}
            best = minimize(
                power, motions[0, :3] / scale + 0.05, constraints=keep, method="SLSQP", options={"ftol": 1e-13}
            )
            assert power(motions[0, :3] / scale) <= best.fun + 1e-5
            assert motions[0, :3] / scale == pytest.approx(best.x, abs=5e-3)
            tried += 1
    assert tried >= 3


def test_the_limit_of_stiff_smooth_contacts_and_many_support_points():
    """A rival that knows no modes: springs for contact, tanh for friction, 3600 points for the table."""
    (x, y), weights = disk_cells(RADIUS, 0.0, 30, 120)[0].T, disk_cells(RADIUS, 0.0, 30, 120)[1]
    scale = np.array([1.0, 1.0, 1.0 / RADIUS])
    rng, compared = np.random.default_rng(3), 0
    while compared < 12:
        contacts = random_contacts(rng, 1 + compared % 2, 0.4)
        count, motions = solved(SURFACES["disk"], contacts)
        if count != 1 or not motions[0, :3].any():
            continue
        normals, tangents = jacobians(contacts)
        un = np.sum(contacts[:, 2:4] * contacts[:, 4:6], axis=1)
        ut = contacts[:, 2] * contacts[:, 5] - contacts[:, 3] * contacts[:, 4]

        def unbalanced(z, softness, normals=normals, tangents=tangents, un=un, ut=ut):
            nu = z * scale
            ux, uy = nu[0] - nu[2] * y, nu[1] + nu[2] * x
            speed = np.sqrt(ux**2 + uy**2 + softness**2)
            table = [weights @ (ux / speed), weights @ (uy / speed), weights @ ((x * uy - y * ux) / speed)]
            press = np.logaddexp(0.0, -(normals @ nu - un) / softness * 2.0) / 2.0
            side = -0.4 * press * np.tanh((tangents @ nu - ut) / softness)
            return (press @ normals + side @ tangents - table) * scale

        z = motions[0, :3] / scale + 0.02 * rng.normal(size=3)
        for softness in (0.3, 0.1, 0.03, 0.01, 0.003, 0.001):
            done = root(unbalanced, z, args=(softness,))
            z = done.x
        assert done.success
        assert z == pytest.approx(motions[0, :3] / scale, abs=2e-2)
        compared += 1


@pytest.mark.parametrize("name", SURFACES)
def test_one_pushing_contact_has_exactly_one_motion(name):
    rng = np.random.default_rng(4)
    for _ in range(300):
        contacts = random_contacts(rng, 1, rng.choice([0.0, 0.5, 2.0, 10.0]))
        if np.dot(contacts[0, 2:4], contacts[0, 4:6]) > 0.01:
            assert solved(SURFACES[name], contacts)[0] == 1


def test_several_motions_are_recognised_and_the_one_nearest_to_the_guess_comes_first():
    c = RADIUS
    contact = [1.5 * c, 1.5 * c, 1.0, 0.0, -0.1, 1.0, 3.0]
    count, motions = solved(SURFACES["disk"], contact)
    assert count == 3
    for row in motions:
        assert solved(SURFACES["disk"], contact, tuple(row[:3]))[1][0, :3] == pytest.approx(row[:3], abs=1e-6)
    assert solved(SURFACES["disk"], [*contact[:6], 0.5])[0] == 1


@pytest.mark.parametrize("name", ["disk", "polygon"])
def test_the_search_for_several_motions_misses_none_that_many_guesses_find(name):
    rng, surface, several = np.random.default_rng(5), SURFACES[name], 0
    for _ in range(120):
        contacts = random_contacts(rng, int(rng.integers(1, 4)), rng.choice([1.0, 2.0, 4.0]))
        contacts[:, 4:6] -= contacts[:, 2:4]
        count, motions = solved(surface, contacts)
        for _ in range(12):
            guess = rng.normal(size=3) * [1.0, 1.0, 1.0 / RADIUS]
            again, others = solved(surface, contacts, tuple(guess))
            assert again == count
            for row in others:
                assert np.abs((motions[:, :3] - row[:3]) * [1.0, 1.0, RADIUS]).max(axis=1).min() < 1e-5
        several += count > 1
    assert several > 5


def test_fingers_that_close_on_each_other_jam():
    left, right = [-RADIUS, 0.0, 1.0, 0.0, 1.0, 0.0, 0.5], [RADIUS, 0.0, -1.0, 0.0, -1.0, 0.0, 0.5]
    assert solved(SURFACES["disk"], [left, right])[0] == JAMMED
    right[4] = 1.0  # the right finger gives way at the same speed
    count, motions = solved(SURFACES["disk"], [left, right])
    assert count == 1 and motions[0, :3] == pytest.approx([1.0, 0.0, 0.0], abs=1e-9)


@pytest.mark.parametrize("name", ["disk", "polygon", "cells"])
def test_passes_with_the_tangent_metric_converge_quadratically_and_with_the_secant_metric_linearly(name):
    surface, rng = SURFACES[name], np.random.default_rng(6)
    most = {tangent_metric: 0, secant_metric: 0}
    for _ in range(150):
        contacts = random_contacts(rng, 1)
        count, motions = solved(surface, contacts)
        if count != 1 or not motions[0, :3].any():
            continue
        for metric_of in most:
            metric, steps = start_metric(surface), []
            for _ in range(120):
                solve_contacts(metric, contacts, 1, SPACE.trial, SPACE.rows)
                nu = SPACE.trial[0, :3].copy()
                metric = metric_of(surface, *nu)
                apart = squared(metric, *(nu - motions[0, :3])) / squared(metric, *nu)
                steps.append(np.sqrt(max(apart, 0.0)))
                if steps[-1] < 1e-7:
                    break
            most[metric_of] = max(most[metric_of], len(steps))
    assert most[tangent_metric] <= 7
    assert 7 < most[secant_metric] <= 60
