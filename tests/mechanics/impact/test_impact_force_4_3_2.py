"""Impact forces: known factors, momentum, and the equation of motion integrated."""

from math import exp, inf, pi, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from palmar.mechanics.impact import impact_force_4_3_2 as force

M, V, K = 0.3, 0.8, 5e3
ZETAS = (0.0, 0.1, 0.3, 0.49, 0.5, 0.7, 0.999, 1.0, 1.001, 2.5)


def integrated(zeta: float, power: float = 1.0) -> tuple[float, float, float, float, float]:
    """Peak force, duration, speed after, greatest compression and impulse, by small steps until the force is gone."""
    c = 2.0 * zeta * sqrt(K * M)

    def pressed(deep, rate):
        return K * max(deep, 0.0) ** power + c * rate

    def motion(_, state):
        f = pressed(state[0], state[1])
        return [state[1], -f / M, f]

    def gone(t, state):
        pulling = np.sign(state[0]) * K * abs(state[0]) ** power + c * state[1]
        return pulling if t > 1e-9 else 1.0

    gone.terminal, gone.direction = True, -1
    done = solve_ivp(motion, (0.0, 1.0), [0.0, V, 0.0], events=gone, rtol=1e-10, atol=1e-13, max_step=2e-5)
    forces = [pressed(*each) for each in done.y[:2].T]
    return max(forces), float(done.t[-1]), float(done.y[1, -1]), float(done.y[0].max()), float(done.y[2, -1])


@pytest.mark.parametrize("zeta", ZETAS)
def test_against_the_equation_of_motion(zeta):
    peak, duration, after, deep, impulse = integrated(zeta)
    assert force.peak_force(M, V, K, zeta) == pytest.approx(peak, rel=1e-5)
    assert force.contact_duration(M, K, zeta) == pytest.approx(duration, rel=1e-6)
    assert force.restitution(zeta) == pytest.approx(-after / V, rel=1e-6)
    assert force.compression(M, V, K, zeta) == pytest.approx(deep, rel=1e-5)
    assert impulse == pytest.approx(M * V * (1.0 + float(force.restitution(zeta))), rel=1e-6)


def test_known_numbers():
    assert force.peak_force(M, V, K) == pytest.approx(V * sqrt(K * M), rel=1e-14)
    assert force.contact_duration(M, K) == pytest.approx(pi * sqrt(M / K), rel=1e-14)
    assert force.restitution(1.0) == pytest.approx(exp(-2.0), rel=1e-9)
    assert force.peak_factor(0.5) == pytest.approx(1.0), "at zeta = 1/2 the first touch is as hard as the spring alone"
    factor = force.peak_factor(np.linspace(0.0, 0.5, 5001))
    assert factor.min() == pytest.approx(0.8101, abs=1e-4)
    assert np.linspace(0.0, 0.5, 5001)[factor.argmin()] == pytest.approx(0.265, abs=2e-3)


def test_hertz_duration_has_its_textbook_factor():
    deep, time = force.power_law_compression(M, V, 1e7), force.power_law_duration(M, V, 1e7)
    assert time * V / deep == pytest.approx(2.9432, abs=1e-4)


@pytest.mark.parametrize("power", [1.0, 1.5, 2.0])
def test_power_laws_against_the_equation_of_motion(power):
    peak, duration, after, deep, _ = integrated(0.0, power)
    assert force.power_law_peak(M, V, K, power) == pytest.approx(peak, rel=1e-5)
    assert force.power_law_compression(M, V, K, power) == pytest.approx(deep, rel=1e-6)
    assert force.power_law_duration(M, V, K, power) == pytest.approx(duration, rel=1e-4)
    assert after == pytest.approx(-V, rel=1e-6)
    assert K * deep ** (power + 1) / (power + 1) == pytest.approx(0.5 * M * V**2, rel=1e-6)


def test_the_spring_is_the_power_law_with_exponent_one():
    assert force.power_law_peak(M, V, K, 1.0) == pytest.approx(force.peak_force(M, V, K), rel=1e-13)
    assert force.power_law_duration(M, V, K, 1.0) == pytest.approx(force.contact_duration(M, K), rel=1e-13)


def test_damping_for_a_restitution_and_back():
    wanted = np.array([1.0, 0.9, 0.5, 0.1, 1e-3])
    assert force.restitution(force.damping_ratio_for(wanted)) == pytest.approx(wanted, rel=1e-9)
    assert np.all(np.diff(force.restitution(np.linspace(0.0, 4.0, 400))) < 0.0)
    assert force.damping_ratio_for(0.0) == inf


@pytest.mark.parametrize("zeta", [0.0, 0.3, 1.4])
def test_a_pad_of_the_stiffness_needed_keeps_to_the_limit(zeta):
    whole = force.stiffness_for(20.0, M, V, zeta)
    assert force.peak_force(M, V, whole, zeta) == pytest.approx(20.0, rel=1e-13)
    pad = force.pad_stiffness(whole, 1e6)
    assert 1.0 / (1.0 / pad + 1e-6) == pytest.approx(whole, rel=1e-12)
    assert force.pad_stiffness(2e6, 1e6) == inf


def test_the_effective_mass_is_that_of_the_impact_impulse():
    """Impulse of an elastic impact with a free rod: 2 M (X w - v), from section 4.1.2."""
    from palmar.mechanics.impact.impact_4_1_2 import finite_finger

    mass, finger, length, x, w = 0.7, 0.9, 0.244, 0.15, 2.0
    after = finite_finger(x, w, -0.4, mass, finger, length, 1.0)
    effective = force.effective_mass(mass, x, finger * length**2 / 3.0)
    assert mass * (after.speed + 0.4) == pytest.approx(2.0 * effective * (x * w + 0.4), rel=1e-13)
    assert force.effective_mass(mass) == mass


@pytest.mark.parametrize(("threshold", "delay"), [(0.0, 0.0), (2.0, 1e-3), (10.0, 4e-3), (2.0, 1.0), (1e9, 0.0)])
def test_letting_go_against_small_steps(threshold, delay):
    """A disk runs into a driven finger that becomes free, mass 0.2 at the contact, some time after the force is felt."""
    free_mass, w = 0.2, sqrt(K / M)
    freed = 1.0 / (1.0 / M + 1.0 / free_mass)
    step, x, vx, y, vy, felt, worst = 2e-6, 0.0, V, 0.0, 0.0, inf, 0.0
    for i in range(round(1.5 * pi / w / step)):
        load = K * max(x - y, 0.0)
        felt = min(felt, i * step) if load >= threshold else felt
        free = i * step >= felt + delay
        vx -= step * load / M
        vy += step * load / free_mass if free else 0.0
        x, y = x + step * vx, y + step * vy
        worst = max(worst, load)
    found = force.triggered_peak(M, freed, V, K, threshold, delay)
    assert found == pytest.approx(worst, rel=2e-3)
    assert V * sqrt(K * freed) * (1 - 1e-12) <= found <= V * sqrt(K * M) * (1 + 1e-12)
