"""Bang-bang touch-down: work and energy, small steps, and no other torque programme that is quicker."""

import numpy as np
import pytest

from palmar.mechanics.impact.touch_down_4_3_2 import rate_at, touch_down

ANGLE, ARRIVAL, TORQUE, INERTIA = 1.2, 0.3, 0.8, 0.05


def test_from_rest_to_rest_the_torque_reverses_half_way():
    plan = touch_down(ANGLE, 0.0, TORQUE, INERTIA)
    assert plan.switch_angle == pytest.approx(ANGLE / 2)
    assert plan.time == pytest.approx(2.0 * np.sqrt(ANGLE * INERTIA / TORQUE))
    assert plan.switch_time == pytest.approx(plan.time / 2)


@pytest.mark.parametrize("rate", [0.0, 0.9])
def test_the_torques_do_the_work(rate):
    plan = touch_down(ANGLE, ARRIVAL, TORQUE, INERTIA, rate)
    work = TORQUE * (plan.switch_angle - (ANGLE - plan.switch_angle))
    assert work == pytest.approx(0.5 * INERTIA * (ARRIVAL**2 - rate**2), abs=1e-12)
    assert plan.arrival == ARRIVAL


@pytest.mark.parametrize("rate", [0.0, 0.9])
def test_against_small_steps(rate):
    plan = touch_down(ANGLE, ARRIVAL, TORQUE, INERTIA, rate)
    step, angle, w, time = 1e-6, 0.0, rate, 0.0
    while angle < ANGLE:
        w += step * (TORQUE if time < plan.switch_time else -TORQUE) / INERTIA
        angle, time = angle + step * w, time + step
    assert (time, w) == pytest.approx((float(plan.time), ARRIVAL), rel=3e-3)


def test_no_other_programme_is_quicker():
    """Of 200,000 random torque programmes within the limit, none that arrives no faster than allowed is quicker."""
    plan = touch_down(ANGLE, ARRIVAL, TORQUE, INERTIA)
    rng = np.random.default_rng(2)
    steps, count = 400, 200_000
    step = float(plan.time) * rng.uniform(0.8, 1.3, count) / steps
    level = np.clip(rng.normal([1.0, 1.0, -1.0, -1.0], 0.3, (count, 4)), -1.0, 1.0)
    turns = np.sort(rng.uniform(0.0, 1.0, (count, 3)), axis=1)
    angle, w, found = np.zeros(count), np.zeros(count), np.inf
    for i in range(steps):
        torque = level[np.arange(count), (i / steps > turns).sum(axis=1)]
        faster = w + step * TORQUE * torque / INERTIA
        after = angle + 0.5 * step * (w + faster)
        arrived = (angle < ANGLE) & (after >= ANGLE) & (faster >= 0.0) & (faster <= ARRIVAL)
        found = min(found, *(step[arrived] * (i + 1)), np.inf)
        angle, w = after, faster
    assert 0.998 * plan.time < found < 1.1 * plan.time


def test_the_rate_on_the_way_is_that_of_the_plan():
    at = np.linspace(0.0, ANGLE, 101)
    rates = rate_at(at, ANGLE, ARRIVAL, TORQUE, INERTIA, 0.9)
    assert (rates[0], rates[-1]) == pytest.approx((0.9, ARRIVAL))
    slope = np.abs(np.diff(rates**2)) / np.diff(at) / 2.0
    assert np.median(slope) == pytest.approx(TORQUE / INERTIA)
    nearer = rate_at(ANGLE - 0.02, ANGLE, ARRIVAL, TORQUE, INERTIA)
    assert nearer == pytest.approx(np.sqrt(ARRIVAL**2 + 2.0 * TORQUE / INERTIA * 0.02))


def test_too_short_a_way():
    slow = touch_down(0.001, 5.0, TORQUE, INERTIA)
    assert slow.arrival == pytest.approx(np.sqrt(2.0 * 0.001 * TORQUE / INERTIA))
    assert slow.switch_angle == pytest.approx(0.001)
    assert np.isnan(touch_down(0.001, 0.1, TORQUE, INERTIA, 5.0).time)
    both = touch_down([0.001, ANGLE], 0.1, TORQUE, INERTIA, 5.0)
    assert np.isnan(both.time).tolist() == [True, False]
