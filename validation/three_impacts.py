"""Soundness of the three-impact regions of free disks, hunted by small steps on random hands.

    python3 dev.py validate three_impacts [corrected|published] [SECONDS] [FROM TO]

Hands: palm from 1/50 to 7/5 of the finger, disks between FROM and TO of the half palm (0.02 and 0.8), held without
friction. Starts: anywhere in the right half, and as many again within a fiftieth of its boundary; each carried by
tests/reference/slow_free_flight.py at five restitutions until the tips stand a disk apart. SECONDS of processor time.
A seed is fixed; every loss is printed.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
import shapely

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from palmar.mechanics.closure.disk_2_2 import structural_radii
from palmar.regions.three_impacts_4_2_1 import three_impact_sets
from reference.slow_free_flight import caught

RESTITUTIONS = (1.0, 0.9, 0.7, 0.4, 0.0)
LENGTH, STEP, EACH = 1.0, 1e-3, 250


def starts_in(region: shapely.Geometry, rng: np.random.Generator) -> np.ndarray:
    """Starts (N, 2) in the right half: some anywhere, some near the boundary."""
    half = shapely.intersection(region, shapely.box(0.0, 0.0, 9.0, 9.0))
    left, low, right, high = half.bounds
    anywhere = np.column_stack([rng.uniform(left, right, 4 * EACH), rng.uniform(low, high, 4 * EACH)])
    edge = shapely.get_coordinates(half.boundary.interpolate(rng.uniform(0.0, half.boundary.length, EACH)))
    inner = np.array(half.representative_point().coords[0])
    edge += (inner - edge) * rng.uniform(1e-4, 0.02, (len(edge), 1))
    anywhere = anywhere[shapely.contains_xy(half, *anywhere.T)][:EACH]
    return np.concatenate([anywhere, edge[shapely.contains_xy(half, *edge.T)]])


def hunt(published: bool, seconds: float, least: float, most: float) -> None:
    """Draw hands until the processor time is used up, and count."""
    rng, begun = np.random.default_rng(1), time.process_time()
    hands, carried, lost = 0, Counter[float](), Counter[float]()
    while time.process_time() - begun < seconds:
        half_palm = float(np.exp(rng.uniform(np.log(0.02), np.log(1.4))))
        radius = float(rng.uniform(least, most)) * half_palm
        if not structural_radii(half_palm, LENGTH).holds(radius):
            continue
        region = three_impact_sets(half_palm, LENGTH, radius, 0.0, 1e-5, published=published).centre
        if region.is_empty:
            continue
        hands, starts = hands + 1, starts_in(region, rng)
        for e in RESTITUTIONS:
            held, _ = caught(starts, half_palm, LENGTH, radius, e, step=STEP)
            carried[e] += len(starts)
            lost[e] += int((~held).sum())
            for x, y in starts[~held]:
                print(f"lost: e {e}, D {half_palm:.4f}, R {radius:.4f}, from ({x:.5f}, {y:.5f})", flush=True)
    print(f"{hands} hands, R/D {least:g} to {most:g}")
    for e in RESTITUTIONS:
        print(f"e = {e}: {carried[e]} starts, {lost[e]} lost")


if __name__ == "__main__":
    words = [*sys.argv[1:], *("corrected", "300", "0.02", "0.8")[len(sys.argv) - 1 :]]
    hunt(words[0] == "published", float(words[1]), float(words[2]), float(words[3]))
