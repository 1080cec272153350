"""The numbers in docs/derivations/zero_gravity.md, computed anew without the package and looked up there."""

from itertools import pairwise
from math import acos, cos, degrees, pi, sin, sqrt, tan
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar
from shapely import Polygon, box

PAGE = Path(__file__).parents[1] / "docs" / "derivations" / "zero_gravity.md"
D, L, R = 6.0, 24.4, 3.8


def say(*phrases: str) -> None:
    """Every phrase stands on the page, wherever its lines break."""
    text = " ".join(PAGE.read_text(encoding="utf-8").split())
    assert [phrase for phrase in phrases if phrase not in text] == []


def fly(x: float, ut: float, un: float) -> tuple[float, float, float, float]:
    """Turn, distance and velocity in the finger's frame at the next contact, straight from where the centre is."""

    def off(phi: float) -> float:
        return -(x + ut * phi) * sin(phi) + (R + un * phi) * cos(phi) - R

    phi = brentq(off, 1e-6, pi / 2, xtol=1e-14)
    c, s = cos(phi), sin(phi)
    return phi, (x + ut * phi) * c + (R + un * phi) * s, ut * c + un * s, un * c - ut * s


def third(x1: float, sign: float) -> tuple[float, ...]:
    """X3, X2, phi1, phi2 and the velocities about the second impact, 2 X2 + sign u_n after it."""
    phi1, x2, ut, un = fly(x1, 0.0, 2.0 * x1)
    phi2, x3, _, _ = fly(x2, ut, 2.0 * x2 + sign * un)
    return x3, x2, phi1, phi2, ut, un


@pytest.fixture(scope="module", params=[1.0, -1.0], ids=["printed", "corrected"])
def found(request: pytest.FixtureRequest) -> tuple[float, ...]:
    sign = request.param
    x1 = brentq(lambda x: third(x, sign)[0] - L, 0.1, L, xtol=1e-13)
    return sign, x1, *third(x1, sign)


def test_the_construction_and_its_areas(found: tuple[float, ...]):
    sign, x1, _, x2, phi1, phi2, _, _ = found
    end = pi - acos((D - R) / L)
    phi0 = end - phi1 - phi2
    row = " | ".join([f"{x1:.4f}", f"{x2:.4f}", *(f"{degrees(each):.2f}°" for each in (phi1, phi2, phi0))]).replace(
        "-", "−"
    )
    say(row)
    polar = [(x1, phi0), (x2, phi0 + phi1), (L, end)]
    points = np.array([[D + r * cos(phi), r * sin(phi)] for r, phi in polar])
    contacts = np.concatenate([a + (b - a) * np.linspace(0, 1, 800)[:, None] for a, b in pairwise(points)])
    bearing = np.arctan2(contacts[:, 1], contacts[:, 0] - D)
    chords = contacts + R * np.column_stack([-np.sin(bearing), np.cos(bearing)])
    phi = np.linspace(phi0, end, 2000)
    r = np.interp(phi, [each for _, each in polar], [each for each, _ in polar])
    arcs = np.column_stack([D + r * np.cos(phi) - R * np.sin(phi), r * np.sin(phi) + R * np.cos(phi)])
    floor = D - R * tan(phi0 / 2) if phi0 > 0 else D
    areas = []
    for line in (chords, arcs):
        corner = [(floor, R)] if phi0 > 0 else [(line[0, 0], 0.0)]
        half = Polygon([(0.0, -1.0), (corner[0][0], -1.0), *corner, *line, (0.0, line[-1, 1])]).buffer(0)
        areas.append(2 * half.intersection(box(0, R, 99, 99)).area)
    other = "{:.1f}".format
    if sign > 0:
        say(f"has an area of {other(areas[0])} as printed", f"would give {other(areas[1])} and")
    else:
        say(f"{other(areas[0])} with the right sign", f"and {other(areas[1])}.")


def test_the_balance_of_energy(found: tuple[float, ...]):
    sign, _, _, x2, _, _, ut, un = found
    before = (ut**2 + un**2) / 2
    after = (ut**2 + (2 * x2 + sign * un) ** 2) / 2
    work = (2 * x2 + sign * un - un) * x2
    if sign > 0:
        right = (ut**2 + (2 * x2 - un) ** 2) / 2
        say(
            f"| contact at $X'$ | {x2:.3f} |",
            f"| normal velocity before, $u_n$ | {un:.3f} |",
            f"| normal velocity after, as printed | {2 * x2 + un:.3f} |",
            f"| normal velocity after, $2X' - u_n$ | {2 * x2 - un:.3f} |",
            f"| kinetic energy before | {before:.2f} |",
            f"| kinetic energy after, as printed | {after:.2f} |",
            f"| gained, as printed | {after - before:.2f} |",
            f"| work of the finger for that impulse | {work:.2f} |",
            f"| too much, $2X'u_n$ | {2 * x2 * un:.2f} |",
            f"equals the work, {right - before:.2f}, and the disk leaves with {right:.2f}",
        )
        assert after - before - work == pytest.approx(2 * x2 * un, rel=1e-12)
    else:
        assert after - before == pytest.approx(work, rel=1e-12)


def test_damping_and_hertz():
    def peak(zeta: float) -> float:
        t = np.linspace(0, 4, 400001)
        root = sqrt(1 - zeta**2)
        deep = np.exp(-zeta * t) * np.sin(root * t) / root
        rate = np.exp(-zeta * t) * (np.cos(root * t) - zeta * np.sin(root * t) / root)
        return float((deep + 2 * zeta * rate).max())

    best = minimize_scalar(peak, bounds=(0.1, 0.5), method="bounded", options={"xatol": 1e-5})
    say(f"It is least, {best.fun:.3f} of the spring's alone, at $\\zeta = {best.x:.3f}$")
    # x = 1 - y^2 takes the root at the end away.
    duration = 2 * quad(lambda y: 2 * y / sqrt(1 - (1 - y * y) ** 2.5) if y else 2 / sqrt(2.5), 0, 1)[0]
    say(f"the duration ${duration:.3f}\\,\\delta/v$")
