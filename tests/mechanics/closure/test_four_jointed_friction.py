"""The largest disk of a 4-jointed hand with friction: chapter 2 within it, growth with friction, and brute force."""

import numpy as np
import pytest

from palmar.mechanics.closure.disk_2_2 import frictional_radii
from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
from reference.slow_friction import holds_with_friction


def test_links_of_no_length_leave_the_hand_of_chapter_2():
    d, alpha = np.array([0.3, 1.2]), np.radians(35.0)
    expected = frictional_radii(d, 1.0, alpha).max
    assert expected[1] == pytest.approx(2.054, abs=5e-4)
    assert largest_with_friction(d, 1e-9, 1.0, alpha) == pytest.approx(expected, rel=1e-7)
    assert largest_with_friction(d[1], 0.6, 0.4, alpha) >= expected[1]


def test_growth_from_no_friction():
    w, p, q = np.random.default_rng(3).dirichlet([1.0, 1.0, 1.0], 400).T
    last = plain = largest_with_friction(w, p, q, 0.0)
    known = ~np.isnan(plain)
    for alpha in (1e-9, 0.1, 0.3, 0.6, 1.0):
        rough = largest_with_friction(w, p, q, alpha)
        assert np.all(rough[known] >= last[known] * (1.0 - 1e-12))
        last = rough
    assert largest_with_friction(w, p, q, 1e-9)[known] == pytest.approx(plain[known], rel=1e-6)


def test_brute_force():
    hands = [(0.27, 0.09, 0.64), (0.2, 0.5, 0.3), (0.55, 0.25, 0.2), (0.2, 0.65, 0.15)]
    (w, p, q), alpha = np.array(hands).T, np.array([0.6, 0.3, 0.4, 0.2])
    limit = largest_with_friction(w, p, q, alpha)
    assert holds_with_friction(limit * (1.0 - 1e-3), w, p, q, alpha).all()
    some = slice(2, None)  # a search that finds nothing takes a second a hand
    outside = holds_with_friction(limit[some] * (1.0 + 1e-4), w[some], p[some], q[some], alpha[some])
    assert not outside.any()
