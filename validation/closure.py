"""Closure against brute force: 100 000 pairs of beta and friction angle at R(1 +- 1e-6) of every limit.

    python3 dev.py validate closure [PAIRS]

The reference rotates the fingers until they touch and asks for a balance of forces; it knows none of the formulas.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from palmar.mechanics.closure.disk_2_2 import Radii, frictional_radii, structural_radii
from reference.disk_holding import holds_structurally, holds_with_friction

STEP = 1e-6
HANDS = {"line fingers": (0.0, {}), "thick fingers": (0.3, {}), "thick, colliding": (0.3, {"crossing": False})}


def disagreements(radii: Radii, holds: Callable[[NDArray[np.float64]], NDArray[np.bool_]]) -> tuple[int, int]:
    """(decisions compared, decisions that differ) just inside and just outside both limits."""
    some = ~np.isnan(radii.max) & (radii.max - radii.min > 1e-4 * radii.max)
    compared = differing = 0
    for limit, inward in ((radii.max, -1.0), (radii.min, 1.0)):
        known = some & (limit > 1e-5)
        for side in (1.0, -1.0):
            verdict = holds(np.where(known, limit * (1.0 + side * inward * STEP), 1.0))
            compared += int(known.sum())
            differing += int((verdict != (side > 0.0))[known].sum())
    return compared, differing


def main(pairs: int) -> int:
    """Print the comparison; returns the number of decisions that differ."""
    rng = np.random.default_rng(20261122)
    d, alpha = rng.uniform(0.02, 2.0, pairs), rng.uniform(1e-3, 1.4, pairs)
    total = 0
    for name, (thickest, options) in HANDS.items():
        h = rng.uniform(0.0, thickest, pairs)
        begin = time.perf_counter()
        plain, rough = structural_radii(d, 1.0, h, **options), frictional_radii(d, 1.0, alpha, h, **options)
        fast = time.perf_counter() - begin
        begin = time.perf_counter()
        counts = [
            disagreements(plain, lambda r, h=h, o=options: holds_structurally(r, d, 1.0, h, **o)),
            disagreements(rough, lambda r, h=h, o=options: holds_with_friction(r, d, 1.0, alpha, h, **o)),
        ]
        slow = time.perf_counter() - begin
        total += sum(differing for _, differing in counts)
        for closure, (compared, differing) in zip(("structural", "frictional"), counts, strict=True):
            print(f"{name}, {closure}: {compared} decisions at R(1 +- {STEP:g}), {differing} differ")
        print(f"  closed forms {fast:.3f} s, brute force {slow:.1f} s", flush=True)
    return total


if __name__ == "__main__":
    sys.exit(min(main(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000), 1))
