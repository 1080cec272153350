"""Any number of links: agreement with closed forms, the regular polygon, and pi R."""

from math import pi

import numpy as np
import pytest
from scipy.optimize import minimize

from palmar.mechanics.closure.chain import Chain, largest_hold
from palmar.mechanics.closure.disk_2_2 import frictional_radii, structural_radii
from palmar.mechanics.closure.four_jointed_5_1 import four_jointed_radii
from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
from palmar.mechanics.closure.shortest_hand import shortest_hand

EXACT = {"abs": 1e-9, "nan_ok": True}


def radius(*given):
    hold = largest_hold(Chain(*given))
    return float("nan") if hold is None else hold.radius


def test_one_link_is_chapter_2():
    rng = np.random.default_rng(2)
    for _ in range(12):
        (w, length), alpha, h = rng.dirichlet([1.0, 1.0]), rng.uniform(0.05, 1.0), rng.choice([0.0, 0.01])
        assert radius(w, (length,), 0.0, h) == pytest.approx(float(structural_radii(w, length, h).max), **EXACT)
        assert radius(w, (length,), alpha, h) == pytest.approx(
            float(frictional_radii(w, length, alpha, h).max), **EXACT
        )


@pytest.mark.parametrize(
    ("distal", "proximal"), [(0.25, 0.45), (0.1, 0.7), (0.4, 0.15), (0.2, 0.28), (0.6, 0.2), (0.2, 0.2)]
)
def test_two_links_are_the_closed_forms(distal, proximal):
    w, links = 1.0 - distal - proximal, (proximal, distal)
    assert radius(w, links) == pytest.approx(float(four_jointed_radii(w, *links).overall.max), **EXACT)
    assert radius(w, links, 0.4) == pytest.approx(float(largest_with_friction(w, *links, 0.4)), **EXACT)


def test_lengths_of_the_shortest_hands():
    assert shortest_hand(1, 2.0).length == pytest.approx(8.0, rel=1e-14)
    assert shortest_hand(2, 1.0).length == pytest.approx(8.0 * (2.0**0.5 - 1.0), rel=1e-14)
    lengths = [shortest_hand(n, 1.0).length for n in range(1, 200)]
    assert np.all(np.diff(lengths) < 0.0)
    assert lengths[-1] == pytest.approx(pi, rel=1e-5)
    assert lengths[-1] > pi


def test_the_polygon_is_the_best_hand_of_two_links():
    def negative(shares):
        w, p = shares
        found = four_jointed_radii(w, p, 1.0 - w - p).overall.max if w > 0 < p and w + p < 1 else np.nan
        return -float(np.nan_to_num(found))

    best = minimize(
        negative, (0.4, 0.3), method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12, "maxiter": 2000}
    )
    hand = shortest_hand(2, -best.fun)
    assert hand.length == pytest.approx(2.0, rel=1e-5)
    assert best.x == pytest.approx([hand.half_palm, hand.links[0]], abs=1e-3)


def test_no_hand_of_three_links_beside_the_polygon_is_better():
    hand = shortest_hand(3, 1.0)
    lengths = np.array([hand.half_palm, *hand.links])
    assert radius(hand.half_palm, hand.links) == pytest.approx(1.0, abs=1e-9)
    w, *links = lengths + np.array([0.03, -0.01, -0.03, 0.01])
    assert 0.9 < radius(w, tuple(links)) < 1.0
