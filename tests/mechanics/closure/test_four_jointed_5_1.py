"""Closure of 4-jointed hands: published anchors, what the source has wrong, scale, and brute force."""

import numpy as np
import pytest

from palmar.mechanics.closure.disk_2_2 import structural_radii
from palmar.mechanics.closure.four_jointed_5_1 import CASES, four_jointed_radii
from palmar.mechanics.closure.four_jointed_cradle import folded_radius
from palmar.studies.closure_map import closure_map, grid_map
from reference.slow_closure import Touching, holds

STEP, BESIDE = 1e-6, 1e-9
OPTIMUM = (1.0 + 2.0**0.5) / 4.0


def at(distal, proximal):
    return four_jointed_radii(1.0 - distal - proximal, proximal, distal)


def test_published_maxima():
    best = at(0.25, 0.5)
    for name in ("distal_palm", "distal_proximal", "distal_proximal_palm", "overall"):
        assert getattr(best, name).max == pytest.approx(OPTIMUM, rel=1e-12)
    assert at(0.0, 0.5).proximal_palm.max == pytest.approx(0.5, rel=1e-14)
    assert at(0.25, 0.49).distal_palm.max == pytest.approx(0.60145, abs=5e-6)


def test_the_sources_second_maxima_are_none():
    assert np.isnan(at(0.48, 0.25).distal_proximal.max)
    assert at(0.25, 0.6).distal_proximal.max == pytest.approx(0.5844, abs=5e-5)
    assert at(0.25, 0.55).distal_proximal.max > at(0.25, 0.6).distal_proximal.max


def test_ridge_on_which_the_source_saw_four_maxima():
    ridge = np.array([0.15, 0.2, 0.25, 0.3])
    expected = [0.5891, 0.6, 0.60355, 0.6]
    assert at(ridge, 0.5).distal_proximal_palm.max == pytest.approx(expected, abs=5e-5)
    fine = np.linspace(0.05, 0.45, 401)
    along = at(fine, 0.5).distal_proximal_palm.max
    assert fine[along.argmax()] == pytest.approx(0.25)
    assert np.all(np.diff(along) * (fine[:-1] - 0.2495) < 0.0)


def test_slopes_break_on_the_crease():
    for name in ("distal_palm", "distal_proximal", "distal_proximal_palm"):
        below, middle, above = (getattr(at(0.15, 0.5 + side), name).max for side in (-1e-5, 0.0, 1e-5))
        assert abs((above - middle) - (middle - below)) > 1e-7


@pytest.mark.parametrize("name", [*CASES, "overall"])
def test_every_case_has_one_maximum(name):
    count = 121
    radii = np.nan_to_num(grid_map(count).radius_max[name].reshape(count, count), nan=0.0)
    walled = np.pad(radii, 1)
    around = [walled[1 + i : count + 1 + i, 1 + j : count + 1 + j] for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]
    peaks = np.argwhere((radii > 0.0) & np.all([radii > each + 1e-12 for each in around], axis=0))
    assert (peaks / (count - 1)).tolist() == [[0.5, 0.0 if name == "proximal_palm" else 0.25]]


def test_two_jointed_hand_within():
    w, p = np.array([0.2, 0.4, 0.5]), np.array([0.3, 0.3, 0.3])
    inner, outer = four_jointed_radii(w, p, 0.1).proximal_palm, structural_radii(w, p)
    assert np.array_equal(inner.max, outer.max, equal_nan=True)
    assert np.array_equal(inner.min, outer.min, equal_nan=True)


def test_scale():
    w, p, q = np.random.default_rng(1).dirichlet([1.0, 1.0, 1.0], 300).T
    one, many = four_jointed_radii(w, p, q), four_jointed_radii(137.0 * w, 137.0 * p, 137.0 * q)
    for name in CASES:
        for end in ("min", "max"):
            small, large = getattr(getattr(one, name), end), getattr(getattr(many, name), end)
            assert 137.0 * small == pytest.approx(large, rel=1e-11, abs=1e-11, nan_ok=True)
    assert 137.0 * folded_radius(w, p, q) == pytest.approx(
        folded_radius(137.0 * w, 137.0 * p, 137.0 * q), rel=1e-9, nan_ok=True
    )


def boundary_hands():
    """One hand on each side of every boundary between two formulas, 1e-9 away."""
    pairs = [(0.3, 0.8), (0.45, 0.2)]
    families = [lambda a, b: (a, a + b, b), lambda a, b: (a, a, b), lambda a, b: (2.0**0.5 * a, a, b)]
    families += [lambda a, b: (a, b, a + b), lambda a, b: (a + b, a, b)]
    hands = [np.array(each(a, b)) / sum(each(a, b)) for each in families for a, b in pairs]
    return [hand + BESIDE * side * np.eye(3)[k] for hand in hands for k in range(3) for side in (-1, 1)]


@pytest.mark.parametrize("case", Touching)
def test_brute_force(case):
    hands = np.vstack([np.random.default_rng(7).dirichlet([1.0, 1.0, 1.0], 40), boundary_hands()])
    w, p, q = hands[hands[:, 2] > 0.003].T
    radii = getattr(four_jointed_radii(w, p, q), case.value)
    limits = [(radii.max, 1.0, radii.max - radii.min > 1e-4), (radii.min, -1.0, radii.min > 1e-3)]
    if case is Touching.DISTAL_PROXIMAL:
        limits.append((folded_radius(w, p, q), 1.0, folded_radius(w, p, q) > 2e-3))
    for limit, outward, known in limits:
        some = np.flatnonzero(known & (radii.max - radii.min > 1e-4))
        for side in (-1.0, 1.0):
            verdict = holds(case, limit[some] * (1.0 + side * outward * STEP), w[some], p[some], q[some])
            assert np.array_equal(verdict, np.full(some.size, side < 0.0))


def test_map_points():
    found = closure_map(np.array([0.25, 0.7, 0.0, 0.5]), np.array([0.5, 0.3, 0.5, 0.5]))
    assert found.radius_max["overall"] == pytest.approx([OPTIMUM, np.nan, 0.5, np.nan], nan_ok=True)
    assert found.radius_min["distal_proximal"][0] == 0.0


def test_a_few_hands_are_worked_out_as_many_are():
    rng = np.random.default_rng(3)
    w, p, q = rng.uniform(0.0, 1.0, (3, 40))
    many = folded_radius(w, p, q), four_jointed_radii(w, p, q).distal_proximal.max
    few = [[folded_radius(*each), four_jointed_radii(*each).distal_proximal.max] for each in zip(w, p, q, strict=True)]
    np.testing.assert_allclose(np.array(few, dtype=float).T, np.array(many), rtol=1e-12)
    assert 5 < np.isnan(many[0]).sum() < 35
