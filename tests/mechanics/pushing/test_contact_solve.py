"""Contacts on an ellipsoid: the enumeration against linear programs per mode, a convex programme, and symmetry."""

from itertools import product

import numpy as np
import pytest
from scipy.optimize import linprog, minimize

from palmar.mechanics.pushing.contact_solve import solve_contacts, workspace

LENGTH = 0.035
METRIC = (1.0, 0.0, 1.0, 0.0, 0.0, LENGTH**2)
SPACE = workspace()


def solved(contacts, metric=METRIC):
    contacts = np.atleast_2d(np.asarray(contacts, dtype=float))
    count = solve_contacts(metric, contacts, len(contacts), SPACE.motions, SPACE.rows)
    return SPACE.motions[:count].copy()


def random_metric(rng):
    root = rng.normal(size=(3, 3)) * [1.0, 1.0, LENGTH] + np.diag([1.0, 1.0, LENGTH])
    full = root.T @ root + np.diag([0.2, 0.2, 0.2 * LENGTH**2])
    return full, tuple(float(full[i]) for i in ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)))


def random_contacts(rng, count, friction=None):
    bearing = rng.uniform(0.0, 2.0 * np.pi, count)
    normal = bearing + np.pi + 0.5 * rng.normal(size=count)
    contacts = np.zeros((count, 7))
    contacts[:, 0], contacts[:, 1] = 0.05 * np.cos(bearing), 0.05 * np.sin(bearing)
    contacts[:, 2], contacts[:, 3] = np.cos(normal), np.sin(normal)
    contacts[:, 4:6] = rng.normal(size=(count, 2)) + 0.7 * contacts[:, 2:4]
    contacts[:, 6] = rng.choice([0.0, 0.3, 1.0, 2.0], count) if friction is None else friction
    return contacts


def rows_of(contact):
    """Normal and tangential Jacobian and hand speed."""
    rx, ry, nx, ny, ux, uy, _ = contact
    normal, tangent = np.array([nx, ny, rx * ny - ry * nx]), np.array([-ny, nx, rx * nx + ry * ny])
    return normal, tangent, nx * ux + ny * uy, -ny * ux + nx * uy


def by_modes(full, contacts):
    """All motions, one linear program per mode (open, stick, slide left, slide right at each contact)."""
    found = []
    for mode in product("oslr", repeat=len(contacts)):
        if any(kind == "l" and contact[6] == 0.0 for kind, contact in zip(mode, contacts, strict=True)):
            continue
        equal, right, less, bound, rays = [], [], [], [], []
        for kind, contact in zip(mode, contacts, strict=True):
            normal, tangent, un, ut = rows_of(contact)
            mu = contact[6]
            if kind == "o":
                less.append(-normal), bound.append(-un)
                continue
            equal.append(normal), right.append(un)
            if kind == "s":
                if mu == 0.0:
                    break
                equal.append(tangent), right.append(ut)
                rays += [normal + mu * tangent, normal - mu * tangent]
            else:
                sign = 1.0 if kind == "l" else -1.0
                rays.append(normal + sign * mu * tangent)
                if mu > 0.0:
                    less.append(sign * tangent), bound.append(sign * ut)
        else:
            found += vertices(full, equal, right, less, bound, rays)
    distinct = []
    for nu in found:
        if all(np.abs((nu - old) * [1.0, 1.0, LENGTH]).max() > 1e-5 for old in distinct):
            distinct.append(nu)
    return np.array(sorted(distinct, key=tuple)).reshape(-1, 3)


def vertices(full, equal, right, less, bound, rays):
    """The motion of a mode, from a few directions of optimisation; [] if the mode is infeasible."""
    count, scale = len(rays), np.array([1.0, 1.0, 1.0 / LENGTH])
    balance = np.hstack((full * np.outer(scale, scale), -np.array(rays).reshape(-1, 3).T * scale[:, None]))
    rows = np.vstack((balance, *(np.append(row * scale, np.zeros(count)) for row in equal)))
    sides = np.append(np.zeros(3), right)
    limits = np.array([np.append(row * scale, np.zeros(count)) for row in less]) if less else None
    box = [(None, None)] * 3 + [(0.0, None)] * count
    found = []
    for aim in ([1.0, 0.3, -0.7], [-1.0, -0.3, 0.7]):
        done = linprog(np.append(aim, np.zeros(count)), limits, bound or None, rows, sides, box)
        if done.status == 0:
            found.append(done.x[:3] * scale)
    return found


@pytest.mark.parametrize(("count", "problems"), [(1, 30), (2, 30), (3, 8)])
def test_every_motion_is_found_and_no_other(count, problems):
    rng = np.random.default_rng(count)
    several = jammed = 0
    for _ in range(problems):
        full, metric = random_metric(rng)
        contacts = random_contacts(rng, count)
        expected, found = by_modes(full, contacts), solved(contacts, metric)
        ordered = np.array(sorted(found[:, :3], key=tuple)).reshape(-1, 3)
        assert ordered.shape == expected.shape
        assert (ordered - expected) * [1.0, 1.0, LENGTH] == pytest.approx(np.zeros_like(expected), abs=1e-6)
        several, jammed = several + (len(found) > 1), jammed + (len(found) == 0)
    assert count == 1 or jammed > 0


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_without_friction_the_motion_costs_least_of_all_that_clear_the_hand(count):
    rng = np.random.default_rng(10 + count)
    for _ in range(12):
        full, metric = random_metric(rng)
        contacts = random_contacts(rng, count, 0.0)
        rows = [rows_of(contact) for contact in contacts]
        normals, speeds = np.array([row[0] for row in rows]), np.array([row[2] for row in rows])
        possible = linprog(np.zeros(3), -normals, -speeds, bounds=[(None, None)] * 3).status == 0
        found = solved(contacts, metric)
        assert len(found) == (1 if possible else 0)
        if possible:
            scale = np.array([1.0, 1.0, 1.0 / LENGTH])
            best = minimize(
                lambda z, m=full, s=scale: 0.5 * (z * s) @ m @ (z * s),
                found[0, :3] / scale + 0.1 * rng.normal(size=3),
                jac=lambda z, m=full, s=scale: s * (m @ (z * s)),
                constraints={"type": "ineq", "fun": lambda z, n=normals, u=speeds, s=scale: n @ (z * s) - u},
                method="SLSQP",
                options={"ftol": 1e-14, "maxiter": 200},
            )
            assert found[0, :3] / scale == pytest.approx(best.x, abs=2e-5)


def test_loads_balance_stay_in_their_cones_and_open_contacts_carry_none():
    rng = np.random.default_rng(5)
    for _ in range(200):
        count = int(rng.integers(1, 5))
        full, metric = random_metric(rng)
        contacts = random_contacts(rng, count)
        for motion in solved(contacts, metric):
            total = np.zeros(3)
            for contact, load, side in zip(contacts, motion[3::2], motion[4::2], strict=False):
                normal, tangent, un, ut = rows_of(contact)
                gap, slip = normal @ motion[:3] - un, tangent @ motion[:3] - ut
                total += load * normal + side * tangent
                assert gap > -1e-6 and load > -1e-6 and abs(side) <= contact[6] * load + 1e-6
                assert load < 1e-6 or gap < 1e-6
                assert side * slip < 1e-5 * max(1.0, abs(side))
            assert (total - full @ motion[:3]) * [1.0, 1.0, 1.0 / LENGTH] == pytest.approx(np.zeros(3), abs=1e-5)


def test_mirrored_problems_have_mirrored_motions():
    rng = np.random.default_rng(6)
    for _ in range(50):
        contacts = random_contacts(rng, 2)
        mirrored = contacts * [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0]
        here, there = solved(contacts), solved(mirrored)
        assert len(here) == len(there)
        image = np.array(sorted((there[:, :3] * [1.0, -1.0, -1.0]), key=tuple)).reshape(-1, 3)
        assert image == pytest.approx(np.array(sorted(here[:, :3], key=tuple)).reshape(-1, 3), abs=1e-7)


def test_a_contact_that_drags_backwards_under_high_friction_has_three_motions():
    """Hand retreating at 0.1 and passing at 1: the object may stay, be dragged along, or be dragged slipping."""
    c = LENGTH
    motions = solved([2 * c, 2 * c, 1.0, 0.0, -0.1, 1.0, 1.5])
    assert len(motions) == 3
    assert motions[0] == pytest.approx(np.zeros(11))
    sticking = [row for row in motions if np.hypot(row[0] - row[2] * 2 * c + 0.1, row[1] + row[2] * 2 * c - 1.0) < 1e-9]
    assert len(sticking) == 1
    assert len(solved([2 * c, 2 * c, 1.0, 0.0, -0.1, 1.0, 1.2])) == 1


def test_an_edge_flush_on_a_turning_link_moves_with_it_although_its_loads_are_not_unique():
    turn, joint = 0.8, np.array([-0.03, -0.25])
    contacts = np.zeros((2, 7))
    for row, (x, y) in zip(contacts, ((-0.03, -0.02), (-0.03, 0.02)), strict=True):
        lever = np.array([x, y]) - joint
        row[:] = x, y, 1.0, 0.0, -turn * lever[1], turn * lever[0], 1.0
    contacts[:, 4:6] *= -1.0
    motions = solved(contacts)
    assert len(motions) == 1
    assert motions[0, 2] == pytest.approx(-turn)
    assert motions[0, :2] == pytest.approx([-turn * joint[1], turn * joint[0]], abs=1e-9)


def test_opposing_fingers_jam():
    left, right = [-0.05, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0], [0.05, 0.0, -1.0, 0.0, -1.0, 0.0, 0.0]
    assert len(solved([left, right])) == 0
    left[6] = right[6] = 1.0
    assert len(solved([left, right])) == 0


def test_friction_zero_pushes_along_the_normal_only():
    motion = solved([-0.05, 0.01, 1.0, 0.0, 1.0, 5.0, 0.0])[0]
    assert motion[1] == 0.0 and motion[4] == 0.0 and motion[3] > 0.0
    assert motion[0] - motion[2] * 0.01 == pytest.approx(1.0)
