"""Force feedback through a lagging drive: eigenvalues, the motion integrated, and what the limit means."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from palmar.mechanics.impact import force_feedback_4_3_2 as feedback

MASS, DAMPING, STIFFNESS, LAG = 0.4, 3.0, 2e4, 5e-3
HAND = (MASS, DAMPING, STIFFNESS, LAG)


def test_the_limit_in_its_dimensionless_form():
    rng = np.random.default_rng(1)
    m, b, k, t = np.exp(rng.uniform(-3.0, 3.0, (4, 200)))
    natural = np.sqrt(k / m)
    zeta, lag = b / (2.0 * np.sqrt(k * m)), t * natural
    rest = lag - 2.0 * zeta - 4.0 * zeta**2 * lag
    limit = feedback.gain_limit(m, b, k, t)
    assert np.isinf(limit[rest <= 0.0]).all() and 20 < (rest > 0.0).sum() < 180
    some = rest > 0.0
    assert 1.0 + limit[some] == pytest.approx((lag * (1.0 + 2.0 * zeta * lag) / rest)[some], rel=1e-9)
    light = zeta < 0.5
    slowest = feedback.worst_lag(m, b, k)
    worst = feedback.gain_limit(m[light], b[light], k[light], slowest[light])
    assert worst == pytest.approx(1.0 / (1.0 - 2.0 * zeta[light]) ** 2 - 1.0, rel=1e-9)
    assert np.isinf(slowest[~light]).all() and np.isinf(limit[~light]).all()
    assert np.all(worst <= limit[light] * (1.0 + 1e-9))
    assert feedback.gain_limit(m, 0.0, k, t) == pytest.approx(np.zeros(200))


@pytest.mark.parametrize(("share", "stable"), [(0.999, True), (1.001, False)])
def test_the_roots_cross_at_the_limit(share, stable):
    rng = np.random.default_rng(3)
    for _ in range(100):
        m, b, k, t = np.exp(rng.uniform(-3.0, 3.0, 4))
        gain = share * feedback.gain_limit(m, b, k, t)
        if np.isinf(gain):
            gain = 1e3
            assert np.roots(feedback.characteristic_polynomial(gain, m, b, k, t)).real.max() < 0.0
            continue
        roots = np.roots(feedback.characteristic_polynomial(gain, m, b, k, t))
        assert (roots.real.max() < 0.0) == stable


def test_at_the_limit_the_finger_hammers():
    gain = feedback.gain_limit(*HAND)
    roots = np.roots(feedback.characteristic_polynomial(gain, *HAND))
    fastest = roots[np.abs(roots.real).argmin()]
    assert fastest.real == pytest.approx(0.0, abs=1e-7 * abs(fastest))
    assert abs(fastest.imag) == pytest.approx(float(feedback.hammering(*HAND)), rel=1e-9)


@pytest.mark.parametrize(("share", "grows"), [(0.8, False), (1.2, True)])
def test_against_the_motion_itself(share, grows):
    """Finger, spring, lagging drive and controller integrated as they stand; the swing about the rest grows or dies."""
    gain, wanted = share * float(feedback.gain_limit(*HAND)), 2.0

    def motion(_, state):
        x, v, u = state
        felt = STIFFNESS * x + DAMPING * v
        asked = wanted + gain * (wanted - felt)
        return [v, (u - felt) / MASS, (asked - u) / LAG]

    done = solve_ivp(motion, (0.0, 3.0), [0.0, 0.05, 0.0], rtol=1e-9, atol=1e-12, max_step=1e-3)
    swing = np.abs(STIFFNESS * done.y[0] - wanted)
    early, late = swing[(done.t > 0.5) & (done.t < 1.0)].max(), swing[done.t > 2.5].max()
    assert (late > 2.0 * early) if grows else (late < 0.5 * early)


def test_a_spring_alone_is_no_answer_and_damping_is():
    soft, hard = feedback.gain_limit(MASS, DAMPING, [2e2, 2e6], LAG)
    assert soft > hard, "a soft pad allows more gain at this lag"
    less, more = feedback.gain_limit(MASS, [1.0, 30.0], STIFFNESS, LAG)
    assert more > 30.0 * less
