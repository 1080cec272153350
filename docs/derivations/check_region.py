"""The published region of the example hand against the fingertip phase solved numerically.

Run it by itself: `python docs/derivations/check_region.py` (about ten seconds). Frame and symbols as in
published_region.md; the friction between disk and table is uniform, its limit surface tabulated by quadrature.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from shapely import Polygon

Floats = NDArray[np.float64]
L, D, R = 2.0, 1.0, 0.5


def sweep(alpha: float) -> float:
    """Finger angle A at which a fingertip grips the centred disk alpha below its equator."""
    return float(np.pi - np.arccos((D - R * np.cos(alpha)) / L))


def frame(psi: float) -> tuple[Floats, Floats]:
    """The finger's direction and its pushing normal."""
    along = np.array([np.cos(psi), np.sin(psi)])
    return along, np.array([-along[1], along[0]])


def spin_table() -> tuple[Floats, Floats]:
    """Moment over force times radius of a uniform disk under friction, against rim speed over centre speed."""
    rho = np.sqrt((np.arange(200) + 0.5) / 200)[:, None]
    angle = (np.arange(400) + 0.5) * np.pi / 200
    x, y = rho * np.cos(angle), rho * np.sin(angle)
    spin = np.concatenate([[0.0], np.geomspace(1e-3, 50, 400)])[:, None, None]
    speed = np.hypot(1 - spin * y, spin * x)
    force = ((1 - spin * y) / speed).mean((1, 2))
    moment = ((spin * x * x - (1 - spin * y) * y) / speed).mean((1, 2))
    return spin.ravel(), moment / force


SPIN, LEVER = spin_table()


def centre_velocity(tip_velocity: Floats, normal: Floats, alpha: float) -> Floats:
    """Velocity of the disk's centre under a pushing fingertip: sticking if the cone allows it, else sliding."""
    side = np.array([-normal[1], normal[0]])

    def unbalance(spin: float) -> float:
        velocity = tip_velocity + spin * R * side
        speed = float(np.hypot(*velocity))
        lever = -float(velocity @ side) / speed  # moment of a unit force along the velocity, over R
        return lever - float(np.sign(spin) * np.interp(abs(spin) * R / speed, SPIN, LEVER))

    bound = 5 * L / R
    low, high, at_low = -bound, bound, unbalance(-bound)
    for _ in range(45):
        mid = (low + high) / 2
        value = unbalance(mid)
        low, high, at_low = (low, mid, at_low) if at_low * value <= 0 else (mid, high, value)
    velocity = tip_velocity + low * R * side
    angle = float(np.arctan2(velocity @ side, velocity @ normal))
    if abs(angle) <= alpha:
        return velocity
    edge = normal + np.sign(angle) * np.tan(alpha) * side
    return np.asarray(edge * (tip_velocity @ normal))


def tip_phase(psi: float, alpha: float, step: float = 5e-4) -> tuple[float, float, Floats]:
    """From a contact at r = L until the centre is on the axis: finger angle, upward tilt of the push, path."""
    base = np.array([D, 0.0])

    def rate(angle: float, at: Floats) -> Floats:
        along, across = frame(angle)
        offset = at - base - L * along
        return centre_velocity(L * across, offset / np.hypot(*offset), alpha)

    along, across = frame(psi)
    centre = base + L * along + R * across
    path = [centre]
    while centre[0] > 0:
        middle = centre + step / 2 * rate(psi, centre)
        change = step * rate(psi + step / 2, middle)
        part = min(1.0, float(-centre[0] / change[0]))
        psi, centre = psi + part * step, centre + part * change
        path.append(centre)
        if part < 1:
            break
    offset = centre - base - L * frame(psi)[0]
    return psi, float(np.arctan2(offset[1], -offset[0])), np.array(path)


def latest_loss(alpha: float) -> float:
    """Largest finger angle at r = L from which the disk is still pushed past: the centre arrives with tilt alpha."""
    low, high = np.radians(50), sweep(alpha)
    for _ in range(18):
        mid = (low + high) / 2
        low, high = (mid, high) if tip_phase(mid, alpha)[1] > alpha else (low, mid)
    return float(high)


def spiral(r0: float, end: float) -> Floats:
    """Centres of the disks that touch the right finger at r0 + R phi, 0 <= phi <= end."""
    phi = np.linspace(0, end, 4001)
    r = r0 + R * phi
    return np.column_stack([D + r * np.cos(phi) - R * np.sin(phi), r * np.sin(phi) + R * np.cos(phi)])


def main() -> None:
    """Print the tables of the page."""
    for name, alpha in (("structural", 0.0), ("friction 35 deg", float(np.radians(35)))):
        A = sweep(alpha)
        r0 = L - R * (A - alpha)
        curve = spiral(r0, A - alpha)
        published = Polygon([(0, R), *curve, (0, curve[-1, 1])])
        psi = latest_loss(alpha)
        true_curve = np.concatenate([spiral(L - R * psi, psi), tip_phase(psi, alpha)[2]])
        exact = Polygon([(0, R), *true_curve])
        print(
            f"{name}: sweep {np.degrees(A):.2f} deg, R0 {r0:.4f}, end {np.degrees(A - alpha):.2f} deg,",
            f"area {2 * published.area:.3f}; tip phase {np.degrees(A - psi):.3f} deg, R0 {L - R * psi:.5f},",
            f"area {2 * exact.area:.3f}, promised but lost {2 * published.difference(exact).area:.4f}",
        )
    for start in ((2.3, 0.5), (1.1, 2.0)):
        x, y = start[0] - D, start[1]
        r = float(np.sqrt(x * x + y * y - R * R))
        at_tip = np.arctan2(y, x) - np.arcsin(R / np.hypot(x, y)) + (L - r) / R
        psi, tilt, path = tip_phase(float(at_tip), float(np.radians(35)))
        print(
            f"start {start}: tip at {np.degrees(at_tip):.2f} deg, centred at y {path[-1, 1]:.3f},",
            f"finger {np.degrees(psi):.2f} deg, tilt {np.degrees(tilt):.1f} deg against 35",
        )


if __name__ == "__main__":
    main()
