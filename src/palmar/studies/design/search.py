"""The smallest hand that does enough: over size by bisection, at each size over its proportions.

What a hand does is one number, ``slack``, not negative where it is enough. The best slack grows with the size, so its zero
is the size sought. Straight fingers have one proportion, looked for by scan and refinement; ``curled`` has the others.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import bisect, minimize_scalar

from palmar.models.design_brief import Limits

Dimensions = tuple[float, ...]
Best = Callable[[float], tuple[float, Dimensions]]
"""Size (m) -> slack and dimensions of the best hand of that size; slack -inf where there is none."""
SHARES, NEAR_SHARES = 9, 5
"""Proportions scanned at first, and about the best one of another size."""
NEAR = 0.12
STEPS = 9
"""Of the refinement."""
WITHIN, ROUGHLY = 5e-4, 2e-3
"""Sizes are found to so much of themselves, the latter where proportions are not refined."""
FIRST_GROWTH, MOST_GROWTH = 0.1, 0.5


def smallest(best: Best, low: float, high: float, within: float, growth: float) -> Dimensions | None:
    """Dimensions of the smallest hand that does, its size not below ``low`` nor above ``high`` (m); None: none does.

    ``growth``: by which share of itself ``low`` is increased first; then by twice as much each time, up to MOST_GROWTH.
    """
    known: dict[float, tuple[float, Dimensions]] = {}

    def enough(size: float) -> bool:
        if size not in known:
            known[size] = best(size)
        return known[size][0] >= 0.0

    low = min(low, high)
    above = min(low * (1.0 + within), high)
    while not enough(above):
        if above >= high:
            return None
        low, above = above, min(above * (1.0 + growth), high)
        growth = min(2.0 * growth, MOST_GROWTH)
    if not enough(low):
        bisect(lambda size: 1.0 if enough(size) else -1.0, low, above, rtol=within, xtol=within * low)
    return known[min(size for size, (slack, _) in known.items() if slack >= 0.0)][1]


def half_palms(size: float, limits: Limits, reach: float = 0.0) -> tuple[float, float]:
    """Least and greatest half palm (m) of a hand of that size whose fingers are at least ``reach`` (m) long."""
    half = 0.5 * size
    palm, finger = limits.palm_width, limits.finger_length
    least = max(0.5 * palm[0], half - finger[1], 1e-3 * half)
    return least, min(0.5 * palm[1], half - max(finger[0], reach), half * (1.0 - 1e-3))


@dataclass
class Straight:
    """The best half palm and finger of a size; ``slack`` of these (m), not worked out where no more than a third number.

    ``fine`` where proportions are worth refining; ``yes_or_no`` where a slack that is not negative says no more than that.
    """

    slack: Callable[[float, float, float], float]
    limits: Limits
    fine: bool = True
    yes_or_no: bool = False
    _share: float | None = None

    def best(self, size: float) -> tuple[float, Dimensions]:
        """(slack, (half palm, finger)), m."""
        half = 0.5 * size
        least, most = half_palms(size, self.limits)
        if least > most:
            return -np.inf, (least, half - least)
        tried: dict[float, float] = {}

        def lack(share: float) -> float:
            d = min(max(share * half, least), most)
            if d not in tried:
                beaten = -np.inf if self.fine else max(tried.values(), default=-np.inf)
                tried[d] = self.slack(d, half - d, beaten)
            return -tried[d]

        for shares in self._scans(least / half, most / half):
            if self.fine:
                _refine(lack, shares)
            else:
                any(lack(share) <= 0.0 and self.yes_or_no for share in shares)
            if max(tried.values()) >= 0.0:
                break
        best = max(tried, key=lambda d: tried[d])
        if tried[best] > min(tried.values()) or tried[best] >= 0.0:  # else nothing is known of the best proportion yet
            self._share = best / half
        return tried[best], (float(best), float(half - best))

    def _scans(self, least: float, most: float) -> list[list[float]]:
        """Shares near to one known to be good, it first where the order matters; then, or where none is known, all over.

        Where each takes a search of its own, the near ones must do.
        """
        if most - least < 1e-9:
            return [[least]]
        wide = [float(each) for each in np.linspace(least, most, SHARES)]
        if self._share is None:
            return [wide]
        known = self._share
        low, high = max(least, known - NEAR), min(most, known + NEAR)
        near = [float(each) for each in np.linspace(min(low, most), max(high, least), NEAR_SHARES)]
        if self.yes_or_no:
            return [sorted(near, key=lambda share: abs(share - known))]
        return [near if self.fine else sorted(near, key=lambda share: abs(share - known)), wide]


def _refine(lack: Callable[[float], float], shares: list[float]) -> None:
    """Ask about all shares, and then between the neighbours of the best."""
    found = [lack(share) for share in shares]
    at = int(np.argmin(found))
    if len(shares) > 1:
        between = (shares[max(at - 1, 0)], shares[min(at + 1, len(shares) - 1)])
        minimize_scalar(lack, bounds=between, method="bounded", options={"maxiter": STEPS})
