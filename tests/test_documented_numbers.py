"""The numbers in docs/assumptions.md and in the derivations of the table's region, computed anew and looked up there.

Nothing here uses the package: the formulas are written out once more, and rival methods (clipping, root finding, an
equation of motion, quadrature over the disk) stand beside them. A number that changes must change on its page.
"""

from math import acos, asin, atan2, ceil, cos, degrees, hypot, pi, radians, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from shapely import LineString, Point, Polygon, affinity

DOCS = Path(__file__).parents[1] / "docs"


def say(page: str, *phrases: str) -> None:
    """Every phrase stands on the page, wherever its lines break."""
    text = " ".join((DOCS / page).read_text(encoding="utf-8").split())
    assert [phrase for phrase in phrases if phrase not in text] == []


def spiral(d: float, rho: float, r0: float, end: float) -> np.ndarray:
    """Centres of the disks that touch the right finger at r0 + rho phi, 0 <= phi <= end."""
    phi = np.linspace(0, end, 4001)
    r = r0 + rho * phi
    return np.column_stack([d + r * np.cos(phi) - rho * np.sin(phi), r * np.sin(phi) + rho * np.cos(phi)])


def integral(values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Running integral by the trapezoidal rule."""
    return np.concatenate([[0.0], np.cumsum((values[1:] + values[:-1]) / 2 * np.diff(at))])


# The test-bed hand of assumptions.md: half palm, finger, disk, half thickness (m); frictions; gravity.

D, L, R, H = 0.060, 0.244, 0.038, 0.0125
RHO = R + H
MU_TABLE, MU, GRAVITY = 0.3, 0.7, 9.81
SWEEP = pi - acos((D - RHO) / L)
LEAN = np.linspace(0, SWEEP - pi / 2, 20001)
END = SWEEP - float(integral(1 / (1 + L / RHO * np.sin(LEAN)), LEAN)[-1])
R0 = L - RHO * END


@pytest.fixture(scope="module")
def half_region() -> Polygon:
    joint = np.linspace(pi - asin(R / RHO), pi / 2, 200)
    clear = np.column_stack([D + RHO * np.cos(joint), RHO * np.sin(joint)])  # the joint's round end is thick too
    edge = spiral(D, RHO, R0, END)
    return Polygon([(0, R), *clear, *edge, (0, edge[-1, 1])])


def test_open_fingers(half_region: Polygon):
    phi = np.linspace(0, END, 20001)
    lost = integral((R0 + RHO * phi) ** 2, phi) / (2 * half_region.area)
    say(
        "assumptions.md",
        f"$R_0 = {R0 * 1e3:.1f}$ mm",
        f"{round(2e6 * half_region.area, -2):,.0f} mm²".replace(",", " "),
        f"{np.interp(radians(1), phi, lost):.2%} of the region for the first degree",
        f"10% is lost at {degrees(np.interp(0.1, lost, phi)):.1f}°, half at {degrees(np.interp(0.5, lost, phi)):.1f}°",
        f"{degrees(atan2(0.120, -D) - asin(RHO / hypot(D, 0.120))):.1f}° for a disk at (0, 120) mm",
    )
    cut = radians(30)
    along, across = np.array([cos(cut), sin(cut)]), np.array([-sin(cut), cos(cut)])
    foot = np.array([D, 0]) + RHO * across
    clipped = half_region.intersection(Polygon([foot, foot + along, foot + along - across, foot - across])).area
    assert clipped / half_region.area == pytest.approx(np.interp(cut, phi, lost), abs=1e-3)
    say("assumptions.md", f"lost share agrees, {clipped / half_region.area:.1%}", "24% at 30°")


def touching(x: float, faster: float) -> float:
    """Angle of the finger (faster: the right one, +1) that touches a disk on the palm at x."""
    return pi - atan2(R, D - faster * x) - asin(RHO / hypot(D - faster * x, R))


def test_equal_finger_speeds():
    psi = touching(0, 1)
    r = sqrt(D * D + R * R - RHO * RHO)
    say(
        "assumptions.md",
        f"$\\psi = {degrees(psi):.1f}°$ and $r = {r * 1e3:.1f}$ mm",
        f"{10 * psi * r / (2 * sin(psi)):.3f} mm per percent",
        f"\\arccos\\frac{{R + h}}{{D}} = {4 / pi * acos(RHO / D):.2f}",
    )
    for mismatch, digits in ((0.02, 3), (0.10, 2)):
        ratio = (1 + mismatch / 2) / (1 - mismatch / 2)
        x = brentq(lambda x, ratio=ratio: touching(x, 1) / touching(x, -1) - ratio, -(D - RHO) - 0.01, 0)
        say("assumptions.md", f"{-x * 1e3:.{digits}f} mm at {mismatch:.0%}")


def test_fingers_may_cross():
    meeting = acos((D - H) / L)
    say(
        "assumptions.md",
        f"{D * sqrt((L - D) / (L + D)) * 1e3:.1f} mm (lines), "
        f"{(D * sin(meeting) - H) / (1 + cos(meeting)) * 1e3:.1f} mm (thick)",
    )
    corners = np.array(
        [[-D, 0], [D, 0], [0, sqrt(L * L - D * D)]]
    )  # inscribed circle: twice the area over the perimeter
    triangle = Polygon(corners)
    assert 2 * triangle.area / triangle.length == pytest.approx(D * sqrt((L - D) / (L + D)))


def test_light_object_and_compliant_wrist():
    lift = GRAVITY / (2 * MU)
    held = sqrt(D * D + R * R - RHO * RHO)
    say(
        "assumptions.md",
        f"{lift:.1f} N and {lift * L:.2f} N m per kg",
        f"{lift * held:.2f} N m per kg",
        f"= {1 / (lift * L):.3f}\\ \\mathrm{{kg",
        f"= {MU_TABLE * GRAVITY:.1f}$ N per kg, at most {MU_TABLE * GRAVITY * L:.2f} N m per kg",
        f"= {1 / (2 * MU):.2f}$",
        f"$2\\mu\\mu_t = {2 * MU * MU_TABLE:.2f}$",
        f"{lift:.1f} mm for $k = 1$ N/mm",
        f"{MU_TABLE * GRAVITY / 10:.2f} N/mm for a misalignment of 10 mm",
    )


def drift(rate: float) -> float:
    """Run-out beyond the quasi-static one at the end of the spiral, by the equation of motion without finger friction."""
    slide = MU_TABLE * GRAVITY

    def change(_: float, state: np.ndarray) -> list[float]:
        r, slip = state
        return [slip + RHO * rate, rate**2 * r - slide * slip / hypot(slip, r * rate)]

    # stiff: the slip settles within milliseconds
    return float(solve_ivp(change, (0, END / rate), [R0, 0.0], "LSODA", rtol=1e-9, atol=1e-12).y[0, -1]) - L


def test_quasi_static_motion():
    slide = MU_TABLE * GRAVITY
    spread = (L**3 - R0**3) / (3 * RHO * slide)
    for deg in (10, 20, 30):
        rate = radians(deg)
        say(
            "assumptions.md",
            f"| {deg}°/s | {rate**2 * L / slide:.4f} | {(rate * L) ** 2 / (2 * slide) * 1e3:.2f} mm "
            f"| {rate**2 * spread * 1e3:.2f} mm | {drift(rate) * 1e3:.2f} mm |",
        )
    say(
        "assumptions.md",
        f"drift at {degrees(sqrt(1e-3 / spread)):.1f}°/s and by the coasting at "
        f"{degrees(sqrt(2 * slide * 1e-3) / L):.1f}°/s; ten millimetres of drift at {degrees(sqrt(1e-2 / spread)):.0f}",
    )


def test_fixed_wrist_orientation():
    edge = spiral(D, RHO, R0, END)
    turned = affinity.rotate(LineString(edge), 1, origin=(0, 0))
    apart = max(LineString(edge).distance(Point(xy)) for xy in turned.coords[50:-50:50])
    degree = radians(1) * 1e3
    say(
        "assumptions.md",
        f"{max(RHO, D - RHO) * 1e3:.1f} mm per radian or {max(RHO, D - RHO) * degree:.2f} mm per degree",
        f"$D + R_0 = {(D + R0) * 1e3:.1f}$ mm per radian, {(D + R0) * degree:.1f} mm per degree",
        f"{L * degree:.1f} mm per degree about its joint and {(D + L) * degree:.1f} mm",
        f"({apart * 1e3:.2f} mm along the part compared)",
    )


# The example hand of the derivations: half palm 1, line fingers of length 2, disk of radius 0.5.

D1, L1, R1 = 1.0, 2.0, 0.5
ALPHA = radians(35)
STARTS = ((2.3, 0.5), (1.1, 2.0))
"""Promised by the published region, and lost."""


def sweep(alpha: float) -> float:
    return pi - acos((D1 - R1 * cos(alpha)) / L1)


@pytest.fixture(scope="module")
def stick() -> tuple[np.ndarray, np.ndarray]:
    """beta and gamma of a sticking disk (tip_phase.md), the ratio of moment to force by quadrature over the disk."""
    nodes, weights = leggauss(60)
    radius = np.sqrt((nodes + 1) / 2)[:, None]
    angle = (np.arange(120) + 0.5) * pi / 60
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    k = np.linspace(0, 1.6, 161)[:, None, None]
    speed = np.hypot(1 - k * y, k * x)
    force = ((1 - k * y) / speed).mean(2) @ weights
    moment = ((k * x * x - (1 - k * y) * y) / speed).mean(2) @ weights
    gamma = np.arcsin(moment / force)
    return np.arctan(np.tan(gamma) + k.ravel() / np.cos(gamma)), gamma


def tip_turn(
    stick: tuple[np.ndarray, np.ndarray], alpha: float, end: float | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Turn of the finger on the tip and beta, up to ``end`` or to the arrival of the last disk caught."""
    beta = np.linspace(0, sweep(alpha) - pi / 2 + alpha if end is None else end, 4001)
    gamma = np.minimum(np.interp(beta, *stick), alpha)
    return integral(1 / (1 + L1 / R1 * np.sin(beta - gamma) / np.cos(gamma)), beta), beta


@pytest.mark.parametrize("alpha", [0.0, ALPHA])
def test_region_of_the_example(stick: tuple[np.ndarray, np.ndarray], alpha: float):
    a = sweep(alpha)
    turn, beta = tip_turn(stick, alpha)
    psi = a - turn[-1] + turn
    on_tip = np.column_stack(
        [D1 + L1 * np.cos(psi) - R1 * np.sin(psi - beta), L1 * np.sin(psi) + R1 * np.cos(psi - beta)]
    )
    assert on_tip[-1, 0] == pytest.approx(0, abs=1e-12)
    r0, r0_source = L1 - R1 * psi[0], L1 - R1 * (a - alpha)
    source = spiral(D1, R1, r0_source, a - alpha)
    published = Polygon([(0, R1), *source, (0, source[-1, 1])])
    solved = Polygon([(0, R1), *spiral(D1, R1, r0, psi[0]), *on_tip])
    column = 1 if alpha else 0
    rows = {
        "tip phase, solved": f"{degrees(turn[-1]):.3f}°",
        "$A$": f"{degrees(a):.2f}°",
        "$\\theta$": f"{degrees(pi - a):.2f}°",
        "$R_0$, source": f"{r0_source:.4f}",
        "$R_0$, solved": f"{r0:.4f}",
        "area, source": f"{2 * published.area:.3f}",
        "area, solved": f"{2 * solved.area:.3f}",
        "end of the curve, $A - \\alpha$": f"{degrees(a - alpha):.2f}°",
        "area of the centre region, both halves": f"{2 * published.area:.3f}",
    }
    for name, value in rows.items():
        assert cell("derivations/published_region.md", name, column) == value
    lost = 2 * published.difference(solved).area
    said = cell("derivations/published_region.md", "promised but lost", column)
    assert lost < 1e-9 if said == "none" else f"{lost:.3f}" == said
    rows = {
        "$A$": f"{degrees(a):.3f}°",
        "$\\beta_\\mathrm{end}$": f"{degrees(beta[-1]):.3f}°",
        "$\\Delta$": f"{degrees(turn[-1]):.3f}°",
        "$R_0$": f"{r0:.5f}",
        "area, both halves": f"{2 * solved.area:.3f}",
    }
    for name, value in rows.items():
        assert cell("derivations/tip_phase.md", name, column) == value
    kept, gone = (
        float(x) for x in cell("derivations/tip_phase.md", "caught, lost at $y = R$: $x$ =", column).split(",")
    )
    assert kept < D1 + r0 < gone
    if alpha:
        say("derivations/published_region.md", f"$R(\\alpha - \\Delta) = {R1 * (alpha - turn[-1]):.4f}$")
        assert all(published.covers(Point(start)) and not solved.covers(Point(start)) for start in STARTS)


def test_the_two_starts_are_squeezed_out(stick: tuple[np.ndarray, np.ndarray]):
    depths = []
    for x, y in STARTS:
        r = sqrt((x - D1) ** 2 + y * y - R1 * R1)
        turn, beta = tip_turn(stick, ALPHA, radians(89))
        psi = atan2(y, x - D1) - asin(R1 / hypot(x - D1, y)) + (L1 - r) / R1 + turn
        centred = np.interp(0, -(D1 + L1 * np.cos(psi) - R1 * np.sin(psi - beta)), np.arange(len(beta)))
        depths.append(degrees(np.interp(centred, np.arange(len(beta)), beta - psi + pi / 2)))
    say(
        "derivations/published_region.md",
        "press on it {:.1f}° and {:.1f}° below".format(*depths),
        f"within ${ceil(sqrt(L1**2 + R1**2) / 8 * radians(1) ** 2 * 1e6) / 10} \\cdot 10^{{-5}}$ of the curve",
    )


def cell(page: str, row: str, column: int) -> str:
    """Entry of the first table row on the page that begins with ``row``."""
    for line in (DOCS / page).read_text(encoding="utf-8").splitlines():
        if line.startswith(f"| {row} |"):
            return line.strip("| ").split(" | ")[1 + column].strip()
    raise AssertionError(f"{page} has no row {row!r}")


def test_tip_phase_over_friction(stick: tuple[np.ndarray, np.ndarray]):
    turns = [degrees(tip_turn(stick, radians(alpha))[0][-1]) for alpha in (0, 10, 20, 35, 45)]
    slides = [degrees(np.interp(radians(alpha), stick[1], stick[0])) for alpha in (10, 20, 35, 45)]
    even = brentq(lambda alpha: tip_turn(stick, alpha)[0][-1] - alpha, radians(15), radians(25))
    say(
        "derivations/tip_phase.md",
        "| $\\Delta$ | " + " | ".join(f"{turn:.2f}°" for turn in turns) + " |",
        "| slides from $\\beta$ = | " + " | ".join(f"{beta:.2f}°" for beta in slides) + " |",
        f"from $\\alpha = {degrees(even):.2f}°$ ($\\mu = {np.tan(even):.3f}$) upwards",
        f"$(0,\\ {sqrt((L1 + R1) ** 2 - D1**2):.3f})$",
    )
