"""Closure of 4-jointed hands against brute force: every limit of 10 000 random hands at R(1 +- 1e-6), and random radii.

    python3 dev.py validate four_jointed [HANDS]

The reference searches over joint angles and the height of the disk and asks for a balance of forces; it knows none of
the formulas. A quarter of the hands lie 1e-9 from the boundaries between two formulas, on either side.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from palmar.mechanics.closure.four_jointed_5_1 import four_jointed_radii
from palmar.mechanics.closure.four_jointed_cradle import folded_radius
from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
from reference.slow_closure import Touching, holds
from reference.slow_friction import holds_with_friction

Floats = NDArray[np.float64]
STEP, BESIDE = 1e-6, 1e-9
SMALLEST = 1e-3
"""Limits and distal links below this share of the hand are left out: the reference's grids do not resolve them."""
BOUNDARIES = {
    "Q = t": lambda w, p: (w, p + w, p),
    "w = P": lambda w, p: (w, w, p),
    "w = sqrt2 P": lambda w, p: (2.0**0.5 * w, w, p),
    "Q = w + P": lambda w, p: (w, p, w + p),
    "w = P + Q": lambda w, p: (w + p, w, p),
}


def random_hands(count: int, rng: np.random.Generator) -> tuple[Floats, Floats, Floats]:
    """(w, P, Q) summing to 1; the last quarter beside a boundary, shifted by 1e-9 in one of them."""
    near = count // 4
    hands = rng.dirichlet([1.0, 1.0, 1.0], count - near)
    for i in range(near):
        first, second = rng.dirichlet([1.0, 1.0])
        hand = np.array(list(BOUNDARIES.values())[i % len(BOUNDARIES)](first, second))
        hand /= hand.sum()
        hand[rng.integers(3)] += rng.choice([-BESIDE, BESIDE])
        hands = np.vstack([hands, hand])
    w, p, q = hands[hands[:, 2] > SMALLEST].T
    return w, p, q


def disagreements(w: Floats, p: Floats, q: Floats, rng: np.random.Generator) -> dict[str, tuple[int, int]]:
    """(decisions, of which differ) at the limits of each case and at random radii."""
    radii, folded = four_jointed_radii(w, p, q), folded_radius(w, p, q)
    found = {}
    for case in Touching:
        each = getattr(radii, case.value)
        limits = [(each.max, 1.0), (each.min, -1.0)]
        wide = each.max - each.min > 1e-4
        pairs = [(limit, outward, wide & (limit > SMALLEST)) for limit, outward in limits]
        if case is Touching.DISTAL_PROXIMAL:
            pairs.append((folded, 1.0, (folded > SMALLEST) & (each.min - folded > 1e-4)))
        compared = differing = 0
        for limit, outward, some in pairs:
            at = np.flatnonzero(some)
            for side in (1.0, -1.0):
                verdict = holds(case, limit[at] * (1.0 + side * outward * STEP), w[at], p[at], q[at])
                compared += at.size
                differing += int((verdict != (side < 0.0)).sum())
        found[f"{case.value}, limits"] = compared, differing
        radius = rng.uniform(2.0 * SMALLEST, 0.65, w.size)
        inside = each.holds(radius)
        if case is Touching.DISTAL_PROXIMAL:
            inside |= radius <= folded
        found[f"{case.value}, random radii"] = w.size, int((holds(case, radius, w, p, q) != inside).sum())
    return found


def with_friction(count: int, rng: np.random.Generator) -> tuple[int, int, int]:
    """(hands, not found held a thousandth inside, found held 1e-4 outside) of the largest radius with friction."""
    (w, p, q), alpha = rng.dirichlet([1.0, 1.0, 1.0], count).T, rng.uniform(0.05, 1.0, count)
    limit = largest_with_friction(w, p, q, alpha)
    known = ~np.isnan(limit)
    w, p, q, alpha, limit = (each[known] for each in (w, p, q, alpha, limit))
    inside = holds_with_friction(limit * (1.0 - 1e-3), w, p, q, alpha)
    some = np.flatnonzero(~inside)  # asked again on a finer grid
    inside[some] = holds_with_friction(limit[some] * (1.0 - 1e-3), w[some], p[some], q[some], alpha[some], 401)
    outside = holds_with_friction(limit * (1.0 + 1e-4), w, p, q, alpha)
    return limit.size, int((~inside).sum()), int(outside.sum())


def main(count: int) -> int:
    """Print the comparison; returns the number of decisions that differ."""
    rng = np.random.default_rng(20261126)
    w, p, q = random_hands(count, rng)
    begin = time.perf_counter()
    found = disagreements(w, p, q, rng)
    for name, (compared, differing) in found.items():
        print(f"{name}: {compared} decisions, {differing} differ")
    print(f"{w.size} hands, {time.perf_counter() - begin:.0f} s")
    begin = time.perf_counter()
    hands, lost, beyond = with_friction(count // 100, rng)
    print(f"with friction: {hands} hands, {lost} not held at R(1 - 1e-3), {beyond} held at R(1 + 1e-4)")
    print(f"{time.perf_counter() - begin:.0f} s")
    return sum(differing for _, differing in found.values()) + lost + beyond


if __name__ == "__main__":
    sys.exit(min(main(int(sys.argv[1]) if len(sys.argv) > 1 else 10_000), 1))
