"""Closure limits of a disk between two one-link fingers: the formulas of closure_disk.md against brute force.

Run it by itself: `python docs/derivations/check_closure.py`. It prints the worked example of the page and the
largest difference met over random hands, as a multiple of the finger length (here L = 1 throughout).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Limits = tuple[float, float] | None


def structural(D: float, L: float, h: float) -> Limits:
    """Smallest and largest radius held without friction, fingers of half thickness h."""
    E = D - h
    if E <= 0 or 2 * L * L < E * E:
        return None
    root = np.sqrt(2 * L * L - E * E)
    smallest, largest = max(0.0, (E - root) / 2), E if E <= L else (E + root) / 2
    if smallest < h:  # the tip rests on the palm before it comes down to the equator
        gap = D - np.sqrt(L * L - h * h)
        smallest = gap * gap / (4 * h) if gap > 0 else 0.0
    return float(smallest), float(largest)


def frictional(D: float, L: float, h: float, alpha: float) -> Limits:
    """Smallest and largest radius held with the friction angle alpha."""
    s, c = np.sin(alpha), np.cos(alpha)
    middle, square = D * c + h * (1 - s), 2 * (1 - s) * (D * D + h * h - L * L)
    root = np.sqrt(max(0.0, middle**2 - square))
    lower, upper = (np.array([-root, root]) + middle) / (2 * (1 - s)) - h  # the tip at the edge of the cone
    if L + h * (1 + s) / c < D and middle**2 < square:
        return None
    largest = (D + L * s) / c - h if L + h * (1 + s) / c >= D else upper
    gap = D - np.sqrt(L * L - h * h)
    if gap <= 2 * h:  # two tips resting on the palm squeeze the disk between them
        return max(0.0, float(gap - h)), float(largest)
    pointing = (D * D - (L + h) ** 2) / (2 * (L + h))
    within_cone = np.arctan2(pointing, D) <= alpha
    smallest = pointing if within_cone else lower
    tip_height = L * pointing / np.hypot(D, pointing) if within_cone else (lower + h) * (1 - s) - h
    return float(smallest if tip_height >= h else gap * gap / (4 * h)), float(largest)


def contact(psi: Floats, y: Floats, D: float, L: float) -> tuple[Floats, Floats]:
    """Distance of (0, y) from the right finger's joint line, and the upward tilt of that finger's push."""
    along = np.clip(-D * np.cos(psi) + y * np.sin(psi), 0, L)
    x_off, y_off = -D - along * np.cos(psi), y - along * np.sin(psi)
    return np.hypot(x_off, y_off), np.arctan2(y_off, -x_off)


def brute(D: float, L: float, h: float, alpha: float) -> Limits:
    """Scan finger angle and disk height; the radius follows from the distance, the verdict from the tilt."""
    rounding, radii = 1e-9, []  # a contact exactly at the limit counts
    psi = np.linspace(0, np.pi, 2001)[1:-1, None]
    above_palm = (L * np.sin(psi) >= h) | (np.abs(D + L * np.cos(psi)) >= D)
    R = np.linspace(1e-4, 8.0, 2001)[None, :]
    excess = contact(psi, R, D, L)[0] - h - R  # on the palm: the height is the radius
    rows, columns = np.nonzero((excess[:, :-1] * excess[:, 1:] <= 0) & above_palm)
    low, high, angle = R[0, columns], R[0, columns + 1], psi[rows, 0]
    for _ in range(50):
        mid = (low + high) / 2
        below = (contact(angle, low, D, L)[0] - h - low) * (contact(angle, mid, D, L)[0] - h - mid) <= 0
        low, high = np.where(below, low, mid), np.where(below, mid, high)
    tilt = contact(angle, mid, D, L)[1]
    radii.append(mid[(np.abs(tilt) < np.pi / 2) & (tilt <= alpha + rounding)] if len(rows) else mid)
    if alpha > 0:  # off the palm: two opposed fingers, both within the cone
        y = np.linspace(1e-4, 6.0, 3001)[None, :]
        distance, tilt = contact(psi, y, D, L)
        radius = distance - h
        held = (radius > 0) & (radius <= y) & (np.abs(tilt) <= alpha + rounding) & above_palm
        radii.append(radius[held])
    found = np.concatenate(radii)
    return (float(found.min()), float(found.max())) if len(found) else None


def main() -> None:
    """Print the worked example and the largest differences."""
    alpha = np.radians(35)
    print("example, L 1, D 1.2: structural", structural(1.2, 1, 0), "frictional", frictional(1.2, 1, 0, alpha))
    random = np.random.default_rng(1)
    for name, thickest in (("line fingers", 0.0), ("thick fingers", 0.2)):
        worst, verdicts = 0.0, 0
        for _ in range(40):
            D, h, mu = random.uniform(0.3, 1.7), random.uniform(0, thickest), random.uniform(0.05, 1.2)
            for angle in (0.0, float(np.arctan(mu))):
                formula = frictional(D, 1, h, angle) if angle else structural(D, 1, h)
                scanned = brute(D, 1, h, angle)
                verdicts += (formula is None) != (scanned is None)
                if formula and scanned:
                    worst = max(worst, float(np.max(np.abs(np.subtract(formula, scanned)))))
        print(
            f"{name}: 40 hands, with and without friction: difference up to {worst:.4f} L, {verdicts} verdicts differ"
        )


if __name__ == "__main__":
    main()
