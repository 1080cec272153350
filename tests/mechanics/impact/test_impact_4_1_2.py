"""Single impacts: momentum, energy and restitution to rounding, the limits, and a stiff spring in place of the impact."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from palmar.mechanics.impact import impact_4_1_2 as impact

RNG = np.random.default_rng(11)
X, W, V = RNG.uniform(0.02, 0.24, 400), RNG.uniform(0.1, 5.0, 400), RNG.uniform(-1.0, 0.0, 400)
M, MF, LENGTH = RNG.uniform(0.05, 3.0, 400), RNG.uniform(0.05, 3.0, 400), 0.244
E = RNG.uniform(0.0, 1.0, 400)
INERTIA = MF * LENGTH**2 / 3.0


def test_momentum_and_restitution_hold_to_rounding():
    after = impact.finite_finger(X, W, V, M, MF, LENGTH, E)
    before = INERTIA * W + M * X * V
    assert INERTIA * after.rate + M * X * after.speed == pytest.approx(before, rel=1e-12, abs=1e-12)
    assert after.speed - X * after.rate == pytest.approx(E * (X * W - V), rel=1e-12, abs=1e-12)


def test_an_elastic_impact_keeps_the_energy_and_any_other_loses_the_known_share():
    for e in (1.0, E):
        after = impact.finite_finger(X, W, V, M, MF, LENGTH, e)
        lost = 0.5 * INERTIA * (W**2 - after.rate**2) + 0.5 * M * (V**2 - after.speed**2)
        reduced = M * INERTIA / (INERTIA + M * X**2)
        assert lost == pytest.approx(0.5 * reduced * (1.0 - e**2) * (X * W - V) ** 2, rel=1e-12, abs=1e-12)


def test_a_heavy_finger_is_the_limit_and_does_the_work():
    finite = impact.finite_finger(X, W, V, M, 1e14, LENGTH, E)
    heavy = impact.heavy_finger(X, W, V, E)
    assert finite.speed == pytest.approx(heavy, rel=1e-11, abs=1e-11)
    assert finite.rate == pytest.approx(W, rel=1e-11)
    elastic = impact.heavy_finger(X, W, V, 1.0)
    assert 0.5 * (elastic**2 - V**2) == pytest.approx((elastic - V) * X * W, rel=1e-12, abs=1e-12)


def test_at_rest_the_disk_leaves_at_twice_the_fingers_speed():
    assert impact.at_rest(2.7614, 1.0) == pytest.approx(2 * 2.7614)
    assert impact.at_rest(X, W, E) == pytest.approx((1.0 + E) * X * W)


def test_the_printed_equation_agrees_only_at_rest_and_for_a_heavy_finger():
    printed = impact.finite_finger_published
    assert printed(X, W, 0.0, M, MF, LENGTH, E) == pytest.approx(
        impact.finite_finger(X, W, 0.0, M, MF, LENGTH, E).speed, rel=1e-12
    )
    assert printed(X, W, V, M, 1e14, LENGTH, E) == pytest.approx(impact.heavy_finger(X, W, V, E), rel=1e-9, abs=1e-9)
    # A finger without mass cannot turn a disk round; printed, it does.
    assert printed(0.1, 1.0, -0.5, 1.0, 1e-12, LENGTH, 1.0) == pytest.approx(0.5)
    assert impact.finite_finger(0.1, 1.0, -0.5, 1.0, 1e-12, LENGTH, 1.0).speed == pytest.approx(-0.5)
    gained = 0.5 * M * (printed(X, W, V, M, MF, LENGTH, 1.0) ** 2 - V**2)
    right = impact.finite_finger(X, W, V, M, MF, LENGTH, 1.0)
    assert np.all(gained > 0.5 * M * (right.speed**2 - V**2))


def test_a_restored_rate_is_a_smaller_restitution():
    after = impact.finite_finger(X, W, V, M, MF, LENGTH, E).speed
    seen = impact.restored_restitution(X, M, MF, LENGTH, E)
    away = (after - X * W) / (X * W - V)
    assert np.where(away > 0.0, seen, 0.0) == pytest.approx(np.maximum(away, 0.0), rel=1e-12, abs=1e-12)
    assert np.all((seen >= 0.0) & (seen <= E))
    assert (seen == 0.0).any()
    assert (seen > 0.0).any()


def test_clamped_restitution_is_what_repeated_impacts_come_to():
    """A heavy disk before a light finger whose rate is restored each time ends at the finger's own speed."""
    x, w, v, m, mf, e = 0.2, 1.0, -0.3, 3.0, 0.5, 0.4
    assert impact.restored_restitution(x, m, mf, LENGTH, e) == 0.0
    for _ in range(500):
        v = float(impact.finite_finger(x, w, v, m, mf, LENGTH, e).speed)
        assert v <= x * w + 1e-15
    assert v == pytest.approx(x * w, rel=1e-12)


def test_an_elastic_impact_is_that_of_a_stiff_spring():
    x, w, v, m, mf = 0.15, 2.0, -0.4, 0.7, 0.9
    inertia, stiff = mf * LENGTH**2 / 3.0, 1e6

    def motion(_, state):
        deep, rate, speed = state
        force = max(stiff * deep, 0.0)
        return [x * rate - speed, -x * force / inertia, force / m]

    def parted(_, state):
        return state[0] + 1e-12

    parted.terminal, parted.direction = True, -1
    done = solve_ivp(motion, (0.0, 0.1), [0.0, w, v], events=parted, rtol=1e-11, atol=1e-13, max_step=1e-5)
    after = impact.finite_finger(x, w, v, m, mf, LENGTH, 1.0)
    assert done.t[-1] < 0.1
    assert (done.y[2, -1], done.y[1, -1]) == pytest.approx((float(after.speed), float(after.rate)), rel=1e-8)
