"""The uniform disk: closed forms against brute force, its two limits, its derivatives, and motion from load."""

from math import pi

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipe, ellipk

from palmar.mechanics.pushing import uniform_disk
from palmar.mechanics.pushing.limit_surface import disk_surface, twist, wrench

RADIUS = 0.05
SURFACE = disk_surface(RADIUS)
PLACES = [1e-7, 1e-3, 0.1, 0.5, 0.9, 0.999999, 1.0, 1.000001, 1.3, 2.9999, 3.0, 7.0, 50.0]


def mean_distance(h):
    """Mean distance of a point at h from the points of the unit disk, in polar coordinates about that point."""
    if h < 1.0:
        ray = quad(lambda t: (np.sqrt(1.0 - (h * np.sin(t)) ** 2) - h * np.cos(t)) ** 3, 0.0, pi, epsabs=1e-13)[0]
        return 2.0 * ray / (3.0 * pi)
    widest = np.arcsin(1.0 / h)

    def chord(u):  # the angle is widest * sin u, so that the square root at the rim is smooth
        t = widest * np.sin(u)
        half, middle = np.sqrt(max(1.0 - (h * np.sin(t)) ** 2, 0.0)), h * np.cos(t)
        return (6.0 * middle**2 * half + 2.0 * half**3) * np.cos(u) * widest

    return 2.0 * quad(chord, 0.0, pi / 2, epsabs=1e-13)[0] / (3.0 * pi)


@pytest.mark.parametrize("h", PLACES)
def test_power_lost_is_the_mean_distance_from_the_centre_of_rotation(h):
    force, moment, _ = uniform_disk.rates(h, 1.0)
    assert force * h * h + moment == pytest.approx(mean_distance(h), abs=1e-11 * max(h, 1.0))


@pytest.mark.parametrize("h", [0.2, 0.7, 1.5, 2.5])
def test_force_and_moment_equal_the_textbook_integrals(h):
    m = h * h
    if h < 1.0:
        force = 4.0 / (3.0 * pi * h) * ((1.0 + m) * ellipe(m) - (1.0 - m) * ellipk(m))
    else:
        force = 4.0 / (3.0 * pi) * ((m + 1.0) * ellipe(1.0 / m) - (m - 1.0) * ellipk(1.0 / m))
    rate, moment, _ = uniform_disk.rates(h, 1.0)
    assert rate * h == pytest.approx(force, abs=1e-14)
    assert moment == pytest.approx(mean_distance(h) - h * force, abs=1e-11)


def test_force_and_moment_against_sums_over_a_polar_grid():
    n = 1000
    s, t = np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(n) + 0.5) * 2.0 * pi / n)
    x, y, weight = RADIUS * s * np.cos(t), RADIUS * s * np.sin(t), 2.0 * s / n**2
    vx, vy, omega = 0.03, -0.02, 1.7
    ux, uy = vx - omega * y, vy + omega * x
    speed = np.hypot(ux, uy)
    sums = [np.sum(weight * each / speed) for each in (ux, uy, x * uy - y * ux)]
    assert wrench(SURFACE, vx, vy, omega) == pytest.approx(sums, abs=1e-6)


def test_translation_and_rotation():
    assert wrench(SURFACE, 0.3, -0.4, 0.0) == pytest.approx((0.6, -0.8, 0.0), abs=1e-15)
    assert wrench(SURFACE, 0.0, 0.0, -2.0) == pytest.approx((0.0, 0.0, -2.0 / 3.0 * RADIUS), abs=1e-15)


def test_the_two_asymptotes():
    for h in (1e-2, 1e-3):
        force, moment, _ = uniform_disk.rates(h, 1.0)
        assert force * h == pytest.approx(h - h**3 / 8.0, abs=h**5)
        assert moment == pytest.approx(2.0 / 3.0 - h**2 / 2.0, abs=h**4)
        force, moment, _ = uniform_disk.rates(1.0 / h, 1.0)
        assert force / h == pytest.approx(1.0 - h**2 / 8.0, abs=h**4)
        assert moment == pytest.approx(h / 4.0, abs=h**3)


def test_the_load_is_the_gradient_of_the_power_and_does_not_depend_on_speed():
    def power(nu):
        return float(np.dot(wrench(SURFACE, *nu), nu))

    rng = np.random.default_rng(1)
    for _ in range(20):
        nu = rng.normal(size=3) * [1.0, 1.0, 1.0 / RADIUS]
        step = 1e-5 * np.array([1.0, 1.0, 1.0 / RADIUS])
        slope = [(power(nu + d) - power(nu - d)) / (2.0 * d.sum()) for d in np.diag(step)]
        assert wrench(SURFACE, *nu) == pytest.approx(slope, abs=1e-8)
        assert wrench(SURFACE, *(7.0 * nu)) == pytest.approx(wrench(SURFACE, *nu), abs=1e-14)
        larger = np.array(wrench(disk_surface(3.0 * RADIUS), nu[0], nu[1], nu[2] / 3.0))
        assert larger / [1.0, 1.0, 3.0] == pytest.approx(wrench(SURFACE, *nu), abs=1e-14)


def test_secant_ratio_runs_from_two_thirds_to_a_quarter_and_its_iteration_can_diverge():
    h = np.logspace(-5, 5, 2001)
    ratio = np.array([uniform_disk.secant_ratio(each) for each in h])
    assert np.all(np.diff(ratio) < 1e-12)
    assert ratio[[0, -1]] == pytest.approx([2.0 / 3.0, 0.25], abs=1e-9)
    slope = np.gradient(np.log(ratio), np.log(h))
    assert slope.min() == pytest.approx(-1.198, abs=2e-3)  # beyond -1: repelled from h = 0.94
    v, omega = 0.02, 0.9
    fx, _, moment = wrench(SURFACE, v, 0.0, omega)
    assert moment / fx == pytest.approx(uniform_disk.secant_ratio(v / (RADIUS * omega)) * RADIUS**2 * omega / v)


@pytest.mark.parametrize("h", [1e-6, 0.01, 0.5, 0.999, 1.0, 1.001, 4.0, 1e3])
def test_motion_from_load_undoes_load_from_motion(h):
    nu = np.array([0.6 * h * RADIUS, -0.8 * h * RADIUS, 1.0])
    back = np.array(twist(SURFACE, *wrench(SURFACE, *nu)))
    scale = np.dot(wrench(SURFACE, *nu), nu)
    assert back * scale == pytest.approx(nu, rel=1e-9, abs=1e-12 * scale)
