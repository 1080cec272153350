"""Every number of assumptions.md for the test-bed hand, from its formula and, where one exists, a rival method.

Run it by itself: `python docs/derivations/check_assumptions.py` (about a second).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from shapely import LineString, Point, Polygon, affinity

Floats = NDArray[np.float64]
D, L, R, H = 0.060, 0.244, 0.038, 0.0125  # half palm, finger, disk radius, half finger thickness
MU_TABLE, MU_FINGER, GRAVITY = 0.3, 0.7, 9.80665
RHO = R + H
MM, DEGREE = 1e-3, np.pi / 180
SWEEP = float(np.pi - np.arccos((D - RHO) / L))  # finger angle with the tip at the centred disk's equator


def tip_phase() -> float:
    """Finger turn from the contact reaching the tip until the frictionless disk is centred."""
    beta = np.linspace(0, SWEEP - np.pi / 2, 20001)
    return float(np.trapezoid(1 / (1 + L / RHO * np.sin(beta)), beta))


END = SWEEP - tip_phase()
R0 = L - RHO * END


def region() -> tuple[Floats, Polygon]:
    """The spiral edge of the frictionless region (right half) and that half, closed by a horizontal chord."""
    phi = np.linspace(0, END, 4001)
    r = R0 + RHO * phi
    edge = np.column_stack([D + r * np.cos(phi) - RHO * np.sin(phi), r * np.sin(phi) + RHO * np.cos(phi)])
    joint = np.linspace(np.pi - np.arcsin(R / RHO), np.pi / 2, 200)
    clear = np.column_stack([D + RHO * np.cos(joint), RHO * np.sin(joint)])  # the joint's round end is thick too
    return edge, Polygon([(0, R), *clear, *edge, (0, edge[-1, 1])])


def open_fingers(half: Polygon) -> None:
    """Share of the region lost to pre-opened fingers: formula, and the region clipped."""
    angles = np.linspace(0, END, 200001)
    lost = np.concatenate([[0], np.cumsum((R0 + RHO * angles[:-1]) ** 2 * np.diff(angles))]) / (2 * half.area)
    cut = 30 * DEGREE  # the same loss by clipping: no centre nearer than RHO to the finger's line
    along, across = np.array([np.cos(cut), np.sin(cut)]), np.array([-np.sin(cut), np.cos(cut)])
    foot = np.array([D, 0]) + RHO * across
    slab = Polygon([foot, foot + along, foot + along - across, foot - across])
    clipped = half.intersection(slab).area / half.area
    print(
        f"1 open: area {2 * half.area * 1e6:.0f} mm2, lost {np.interp(DEGREE, angles, lost):.2%} in the first degree,",
        f"{np.interp(cut, angles, lost):.1%} at 30 deg (clipped {clipped:.1%}),",
        f"10% at {np.interp(0.1, lost, angles) / DEGREE:.1f} deg,",
        f"half at {np.interp(0.5, lost, angles) / DEGREE:.1f} deg",
    )
    x, y = -D, 0.120
    touch = np.arctan2(y, x) - np.arcsin(RHO / np.hypot(x, y))
    print(f"       a start at (0, 120) mm is clear of a finger pre-opened up to {touch / DEGREE:.1f} deg")


def equal_speeds() -> None:
    """Offset of the hold at unequal rates: formula, and the touching conditions solved."""
    theta = np.arctan2(R, D) + np.arcsin(RHO / np.hypot(D, R))
    psi, r = np.pi - theta, D * np.cos(theta) + R * np.sin(theta)
    print(
        f"2 speeds: held at psi {psi / DEGREE:.1f} deg, r {r / MM:.1f} mm,",
        f"offset {0.01 * psi * r / (2 * np.sin(psi)) / MM:.3f} mm per 1%,",
        f"hold lost at mismatch {4 / np.pi * np.arccos(RHO / D):.3f}",
    )
    for mismatch in (0.02, 0.1):
        print(f"       pinched on the palm at mismatch {mismatch}: x {pinch(mismatch) / MM:.3f} mm")


def pinch(mismatch: float) -> float:
    """Solve the two exact touching conditions for the offset of a disk on the palm, faster finger at the right."""

    def ratio(x: float) -> float:
        angles = [np.pi - np.arctan2(R, D - side * x) - np.arcsin(RHO / np.hypot(D - side * x, R)) for side in (1, -1)]
        return float(angles[0] / angles[1] - (1 + mismatch / 2) / (1 - mismatch / 2))

    low, high = -(D - RHO) - 0.01, 0.0
    for _ in range(60):
        mid = (low + high) / 2
        low, high = (mid, high) if ratio(mid) > 0 else (low, mid)
    return low


def crossing_and_forces() -> None:
    """Smallest disk between colliding fingers; lifting and pushing forces."""
    theta = np.arccos((D - H) / L)
    print(
        f"3 crossing: smallest held between colliding fingers {D * np.sqrt((L - D) / (L + D)) / MM:.2f} mm (lines),",
        f"{(D * np.sin(theta) - H) / (1 + np.cos(theta)) / MM:.2f} mm (thick); largest {(D - H) / MM:.1f} mm",
    )
    lift = GRAVITY / (2 * MU_FINGER)
    print(
        f"4 light: {lift:.2f} N per finger and kg, {lift * L:.2f} N m at the tip, {1 / (lift * L):.3f} kg per N m;",
        f"pushing {MU_TABLE * GRAVITY:.2f} N per kg, {MU_TABLE * GRAVITY * L:.2f} N m",
    )
    print(f"7 compliance: sliding force over lifting squeeze {2 * MU_FINGER * MU_TABLE:.2f}")


def drift(rate: float) -> float:
    """Run-out beyond the quasi-static one at the end of the spiral: equation of motion, frictionless finger."""
    steps, slide = 20000, MU_TABLE * GRAVITY
    dt = END / rate / steps

    def change(state: Floats) -> Floats:
        r, slip = state
        return np.array([slip + RHO * rate, rate**2 * r - slide * slip / np.hypot(slip, r * rate)])

    state = np.array([R0, 0.0])
    for _ in range(steps):
        state = state + dt * change(state + dt / 2 * change(state))
    return float(state[0] - L)


def quasi_static() -> None:
    """Sliding direction, coasting and drift at three closing rates."""
    slide = MU_TABLE * GRAVITY
    for degrees in (10, 20, 30):
        rate = degrees * DEGREE
        print(
            f"5 quasi-static, {degrees} deg/s: ratio {rate**2 * L / slide:.4f},",
            f"coasting {(rate * L) ** 2 / (2 * slide) / MM:.2f} mm,",
            f"drift {rate**2 * (L**3 - R0**3) / (3 * RHO * slide) / MM:.2f} mm (integrated {drift(rate) / MM:.2f})",
        )
    print(
        f"       1 mm of coasting at {np.sqrt(2 * slide * MM) / L / DEGREE:.1f} deg/s,",
        f"1 mm of drift at {np.sqrt(3 * RHO * slide * MM / (L**3 - R0**3)) / DEGREE:.1f} deg/s",
    )


def orientation(edge: Floats) -> None:
    """Displacement of the region's edges per degree of wrist rotation."""
    moved = affinity.rotate(LineString(edge), 1, origin=(0, 0))
    apart = max(LineString(edge).distance(Point(xy)) for xy in moved.coords[50:-50:50])
    print(
        f"6 orientation, per degree: spiral {max(RHO, D - RHO) * DEGREE / MM:.2f} mm (rotated copy {apart / MM:.2f}),",
        f"open finger {(D + R0) * DEGREE / MM:.2f} mm, fingertip about its joint {L * DEGREE / MM:.2f} mm,",
        f"about the palm centre {(D + L) * DEGREE / MM:.2f} mm",
    )


def main() -> None:
    """Print the numbers in the order of the page."""
    edge, half = region()
    print(f"spiral: sweep {SWEEP / DEGREE:.2f} deg, tip phase {(SWEEP - END) / DEGREE:.2f} deg, R0 {R0 / MM:.1f} mm")
    open_fingers(half)
    equal_speeds()
    crossing_and_forces()
    quasi_static()
    orientation(edge)


if __name__ == "__main__":
    main()
