"""Bang-bang touch-down: work and energy, small steps, and no other torque programme that is quicker."""

import numpy as np
import pytest

from palmar.mechanics.impact.touch_down_4_3_2 import ramps, rate_at, together, touch_down
from palmar.mechanics.impact.touch_down_case import touch_down_programme
from palmar.models.case_file import parse_case

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


@pytest.mark.parametrize("most", [np.inf, 2.0, 0.8])
@pytest.mark.parametrize("angle", [0.02, 0.5, 1.4])
def test_ramps_cover_the_angle_and_meet_the_closed_form(most: float, angle: float) -> None:
    """Pieces of constant rate: their way is the angle, they end at the arrival's rate, no slower than the closed form."""
    arrival, acceleration = 0.3, 5.0
    pieces = ramps(angle, arrival, acceleration, most, 8)
    assert pieces[-1] == (np.inf, min(arrival, most))
    times, rates = np.array(pieces[:-1]).T
    assert (times * rates).sum() == pytest.approx(angle, rel=1e-12)
    assert rates.max() <= most
    closed = touch_down(angle, arrival, acceleration, 1.0)
    if most >= closed.peak:
        assert times.sum() == pytest.approx(float(closed.time), rel=1e-12)
    else:
        assert times.sum() > closed.time
    # Within a ramp the rate changes by the acceleration.
    middle = np.cumsum(times) - 0.5 * times
    steps = np.abs(np.diff(rates) / np.diff(middle))
    assert steps.max() == pytest.approx(acceleration, rel=1e-9) or len(steps) == 0


def test_both_fingers_make_one_programme() -> None:
    rows = together([(1.0, 0.5), (np.inf, 0.1)], [(0.4, 0.2), (0.9, 0.3), (np.inf, 0.0)])
    assert [row[1] for row in rows] == [(0.5, 0.2), (0.5, 0.3), (0.1, 0.3), (0.1, 0.0)]
    assert [row[0] for row in rows] == pytest.approx([0.4, 0.6, 0.3, np.inf])


def test_a_finger_is_slow_as_far_off_as_the_uncertainty() -> None:
    """From where the programme is at the touch rate: the finger's line is R + h + u from the disk's centre."""
    text = (
        "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\nfinger_thickness_mm = 20\n[object]\nradius_mm = 38\n"
        '[support]\nkind = "free"\n[start]\nat_mm = [30, 120]\n[behaviour]\nname = "touch_down"\n'
        "uncertainty_mm = 15\nfinger_acceleration_deg_s2 = 300\ntouch_rate_deg_s = 4\n"
    )
    rows = touch_down_programme(parse_case(text, "test"))
    for finger, side in ((0, 1.0), (1, -1.0)):
        slow = max(k for k, row in enumerate(rows) if row[1][finger] > np.radians(4.0) * 1.001)
        angle = sum(row[0] * row[1][finger] for row in rows[: slow + 1])
        px, py = side * 0.03 - 0.06, 0.12
        away = px * np.sin(angle) - py * np.cos(angle)
        assert abs(away) == pytest.approx(0.038 + 0.010 + 0.015, abs=1e-9)
