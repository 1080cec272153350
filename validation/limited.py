"""Closure within joint limits beside the brute force of ``tests/reference/slow_limited.py``, for two and three links.

    python3 dev.py validate limited [HANDS [SEED]]

Random hands: lengths, limits, friction 0, 0.3 or 0.5 rad, thickness, fingers that cross or not, every other two-link hand
coupled. Printed: the share of the largest radius that postures chosen at random, the best varied, come to. More than 1 is a
disk that the search has missed.
"""

from __future__ import annotations

import sys
import time
from math import radians
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from palmar.mechanics.closure.closing_links import LimitedHand
from palmar.mechanics.closure.limited import limited_radii
from reference.slow_limited import climbed


def random_hand(links: int, seed: int) -> LimitedHand:
    """A hand of size 1."""
    chance = np.random.default_rng(seed)
    palm, *lengths = (float(each) for each in chance.dirichlet((3.0, 3.0, 2.0, 2.0)[: links + 1]))
    base = float(chance.uniform(0.0, radians(75.0))), float(chance.uniform(radians(95.0), radians(170.0)))
    further = [(float(-chance.uniform(0.0, 0.5)), float(chance.uniform(0.3, 2.0))) for _ in range(links - 1)]
    alpha, half = float(chance.choice([0.0, 0.3, 0.5])), float(chance.uniform(0.0, 0.06))
    crossing, coupling = bool(chance.integers(2)), None
    if links == 2 and seed % 2:
        low, high = further[0]
        coupling = (base[0], float(chance.uniform(low, high)), float(chance.uniform(-1.0, 1.0)))
    return LimitedHand(palm, tuple(lengths), (base, *further), alpha, half, crossing, coupling)


def main(words: list[str]) -> None:
    """Both numbers of links, one line each, and every hand of which more than a rounding was missed."""
    count, seed = (int(words[0]) if words else 100), (int(words[1]) if len(words) > 1 else 0)
    for links in (2, 3):
        begin, shares = time.process_time(), []
        for number in range(seed, seed + count):
            hand = random_hand(links, number)
            found = limited_radii(hand).intervals
            largest, met = (found[-1][1] if found else 0.0), climbed(hand, number)
            shares.append(1.0 if largest == met else met / largest if largest else np.inf)
            if shares[-1] > 1.0 + 1e-5:
                print(f"    hand {number} of {links} links: {met:.6f} met, {largest:.6f} found; {hand}", flush=True)
        low, middle, high = np.quantile(shares, (0.0, 0.5, 1.0))
        spent = time.process_time() - begin
        print(
            f"{links} links, {count} hands: share {low:.4f} to {high:.6f}, middle {middle:.4f} ({spent:.0f} s)",
            flush=True,
        )


if __name__ == "__main__":
    main(sys.argv[1:])
