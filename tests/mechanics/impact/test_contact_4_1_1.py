"""Motion in contact: limits the source prints, the balance of energy, and a stiff spring in place of the constraint."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from palmar.mechanics.impact import contact_4_1_1 as contact

RATE, RADIUS, MASS, LENGTH, R0 = 1.7, 0.038, 0.6, 0.244, 0.05
PICKED_UP = RATE * RADIUS
TIMES = np.linspace(0.0, 0.7, 15)


def pressed(start: tuple[float, ...], friction: Callable[[float, float], float], end: float) -> np.ndarray:
    """As ``pressed_and_spun``, the distance alone."""
    return pressed_and_spun(start, friction, end)[0]


def pressed_and_spun(
    start: tuple[float, ...], friction: Callable[[float, float], float], end: float
) -> tuple[np.ndarray, np.ndarray]:
    """Contact distance and spin at TIMES of a disk against a stiff, damped spring on the finger; in the frame of the room.

    ``start``: distance, rate of distance, spin. ``friction(slip, N)`` is the force on the disk along the finger.
    """
    stiff, damped = 4e5, 2.0 * np.sqrt(4e5 * MASS)
    r0, v0, spin0 = start

    def motion(t, state):
        x, y, vx, vy, spin = state
        d, n = np.array([np.cos(RATE * t), np.sin(RATE * t)]), np.array([-np.sin(RATE * t), np.cos(RATE * t)])
        p, v = np.array([x, y]), np.array([vx, vy])
        deep = RADIUS - p @ n
        foot = p - (p @ n) * n
        wall = RATE * (foot @ d)
        force = max(stiff * deep - damped * (v @ n - wall), 0.0) if deep > -1e-3 else 0.0
        along = friction(v @ d + RADIUS * spin, force)
        ax, ay = (force * n + along * d) / MASS
        return [vx, vy, ax, ay, RADIUS * along / (0.5 * MASS * RADIUS**2)]

    # In the room: (r' - R w) along the finger and r w across it.
    given = [r0, RADIUS, v0 - RADIUS * RATE, r0 * RATE, spin0]
    done = solve_ivp(motion, (0.0, end), given, method="LSODA", t_eval=TIMES, rtol=1e-9, atol=1e-11)
    return done.y[0] * np.cos(RATE * done.t) + done.y[1] * np.sin(RATE * done.t), done.y[4]


def test_the_printed_laws_are_those_without_an_initial_speed():
    ratio = contact.frictionless(TIMES, RATE, R0).distance / R0
    assert ratio == pytest.approx(np.cosh(RATE * TIMES), rel=1e-14)
    ratio = contact.rolling(TIMES, RATE, R0).distance / R0
    assert ratio == pytest.approx(np.cosh(RATE * TIMES * (2 / 3) ** 0.5), rel=1e-14)
    slid = contact.sliding(TIMES, RATE, R0, PICKED_UP, 0.0, RADIUS)
    free = contact.frictionless(TIMES, RATE, R0, PICKED_UP)
    assert slid.distance == pytest.approx(free.distance, rel=1e-14)
    assert slid.speed == pytest.approx(free.speed, rel=1e-14)


def test_the_exponents_meet_the_start_and_the_printed_roots():
    c1, c2, m1, m2, offset = contact.sliding_exponents(RATE, R0, 0.11, 0.3, RADIUS)
    assert (c1 + c2 - offset, m1 * c1 + m2 * c2) == pytest.approx((R0, 0.11), rel=1e-14)
    assert m1 < 0.0 < m2
    assert (m1 * m2, m1 + m2) == pytest.approx((-(RATE**2), -2 * 0.3 * RATE), rel=1e-14)


@pytest.mark.parametrize("speed", [PICKED_UP, 0.3])
def test_frictionless_contact_against_a_stiff_spring(speed):
    slow = pressed((R0, speed, 0.0), lambda slip, force: 0.0, TIMES[-1])
    assert contact.frictionless(TIMES, RATE, R0, speed).distance == pytest.approx(slow, rel=2e-4)


def test_rolling_against_a_stiff_spring_with_much_friction():
    speed = 0.1
    spin = RATE - speed / RADIUS
    assert contact.slip(RATE, speed, spin, RADIUS) == pytest.approx(0.0, abs=1e-15)
    assert contact.rolling_friction(RATE, R0, speed, RADIUS) < 5.0
    slow = pressed((R0, speed, spin), lambda slip, force: -force * 5.0 * np.tanh(slip / 1e-4), TIMES[-1])
    assert contact.rolling(TIMES, RATE, R0, speed).distance == pytest.approx(slow, rel=5e-4)


@pytest.mark.parametrize(("spin", "sign"), [(40.0, 1.0), (-60.0, -1.0)])
def test_sliding_against_a_stiff_spring(spin, sign):
    mu, speed = 0.15, 0.12
    start = (R0, speed, spin)
    slow, spun = pressed_and_spun(start, lambda slip, force: -force * mu * np.tanh(slip / 1e-4), TIMES[-1])
    found = contact.sliding(TIMES, RATE, R0, speed, sign * mu, RADIUS)
    spins = contact.sliding_spin(TIMES, RATE, found.distance - R0, spin, sign * mu, RADIUS)
    still = sign * contact.slip(RATE, found.speed, spins, RADIUS) > 0.0
    assert still.sum() >= 5, "the disk slides for a while"
    assert found.distance[still] == pytest.approx(slow[still], rel=5e-4)
    assert spins[still] == pytest.approx(spun[still], rel=2e-3)


def test_the_friction_that_rolling_takes_is_that_of_its_own_acceleration():
    t, dt = np.linspace(0.1, 0.6, 6), 1e-4
    before, (r, v), after = (contact.rolling(t + each, RATE, R0, 0.1) for each in (-dt, 0.0, dt))
    along = (after.distance - 2.0 * r + before.distance) / dt**2 - RATE**2 * r
    needed = np.abs(along) * MASS / contact.normal_force(RATE, v, RADIUS, MASS)
    assert contact.rolling_friction(RATE, r, v, RADIUS) == pytest.approx(needed, rel=1e-5)


def test_the_finger_does_the_work_that_the_disk_gains():
    """Frictionless: the power N w r of the finger is the rate of the disk's kinetic energy."""
    t = np.linspace(0.0, 0.7, 20001)
    r, v = contact.frictionless(t, RATE, R0, PICKED_UP)
    kinetic = 0.5 * MASS * ((v - RADIUS * RATE) ** 2 + (r * RATE) ** 2)
    power = contact.normal_force(RATE, v, RADIUS, MASS) * RATE * r
    work = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(t))])
    assert kinetic - kinetic[0] == pytest.approx(work, rel=1e-7, abs=1e-12)


def test_a_disk_that_does_not_move_along_the_finger_leaves_at_once_and_one_picked_up_stays():
    assert not contact.in_contact(RATE, 0.0, RADIUS)
    assert contact.separation_time(RATE, R0, 0.0, RADIUS, LENGTH) == 0.0
    slow = pressed((R0, 0.0, 0.0), lambda slip, force: 0.0, TIMES[-1])
    drifted = R0 * np.cos(RATE * TIMES) - RADIUS * RATE * TIMES * np.cos(RATE * TIMES)
    drifted += (RADIUS + R0 * RATE * TIMES) * np.sin(RATE * TIMES)
    caught_up = RATE * TIMES > 1.0
    assert slow[~caught_up] == pytest.approx(drifted[~caught_up], rel=1e-6), "it flies straight on"
    assert contact.in_contact(RATE, PICKED_UP, RADIUS)
    pressure = contact.normal_force(RATE, contact.frictionless(TIMES, RATE, R0, PICKED_UP).speed, RADIUS, MASS)
    assert pressure[0] == pytest.approx(MASS * RADIUS * RATE**2)
    assert np.all(np.diff(pressure) > 0.0)


@pytest.mark.parametrize("speed", [0.5 * PICKED_UP, PICKED_UP, 0.4])
def test_contact_ends_at_the_tip(speed):
    times = (
        contact.separation_time(RATE, R0, speed, RADIUS, LENGTH),
        contact.rolling_separation_time(RATE, R0, speed, RADIUS, LENGTH),
        contact.sliding_separation_time(RATE, R0, speed, 0.3, RADIUS, LENGTH),
        contact.sliding_separation_time(RATE, R0, speed, -0.3, RADIUS, LENGTH),
    )
    ends = (
        contact.frictionless(times[0], RATE, R0, speed),
        contact.rolling(times[1], RATE, R0, speed),
        contact.sliding(times[2], RATE, R0, speed, 0.3, RADIUS),
        contact.sliding(times[3], RATE, R0, speed, -0.3, RADIUS),
    )
    assert [float(each.distance) for each in ends] == pytest.approx([LENGTH] * 4, rel=1e-12)
    assert times[3] < times[0] < times[1]
    assert times[0] < times[2]


def test_contact_once_held_is_held_to_the_tip():
    """N does not fall through 0 on the way, for any friction, wherever the disk starts."""
    start, share = np.meshgrid(np.linspace(0.0, 0.9, 10) * LENGTH, np.linspace(0.5, 3.0, 9))
    for mu in (-2.0, -0.3, 0.0, 0.3, 2.0):
        last = contact.sliding_separation_time(RATE, start, share * PICKED_UP, mu, RADIUS, LENGTH)
        for part in np.linspace(0.0, 1.0, 50):
            v = contact.sliding(part * last, RATE, start, share * PICKED_UP, mu, RADIUS).speed
            assert np.all(contact.normal_force(RATE, v, RADIUS, MASS) >= -1e-15)


def test_no_contact_and_nowhere_to_go():
    assert np.all(contact.sliding_separation_time(RATE, [R0, LENGTH], [0.0, 1.0], 0.2, RADIUS, LENGTH) == 0.0)
    assert contact.rolling_friction(RATE, R0, 0.4 * PICKED_UP, RADIUS) == np.inf
