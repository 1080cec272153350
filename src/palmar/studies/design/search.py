"""The smallest hand with straight fingers that does enough: over proportions by scan and refinement, over size by bisection.

What a hand does is one number, ``slack``, not negative where it is enough. For each size, palm and both fingers, the best
proportion is looked for; the best slack grows with the size, so its zero is the size sought.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import bisect, minimize_scalar

from palmar.models.design_brief import Limits

Slack = Callable[[float, float], float]
"""Half palm, finger (m) -> slack."""
SHARES, NEAR_SHARES = 9, 5
"""Proportions scanned at first, and about the best one of another size."""
NEAR = 0.12
STEPS = 9
"""Of the refinement."""
WITHIN, ROUGHLY = 5e-4, 2e-3
"""Sizes are found to so much of themselves, the latter where proportions are not refined."""
GROWTH = 1.5


@dataclass
class Search:
    """Sizes looked at so far, with the best proportion of each; ``fine`` where proportions are worth refining."""

    slack: Slack
    limits: Limits
    fine: bool = True
    _share: float | None = None
    _known: dict[float, tuple[float, float, float]] = field(default_factory=dict)

    def best(self, size: float) -> tuple[float, float, float]:
        """(slack, half palm, finger), m, of the best hand of this size; slack -inf where the limits leave none."""
        if size not in self._known:
            self._known[size] = self._best(size)
        return self._known[size]

    def smallest(self, low: float, high: float) -> tuple[float, float] | None:
        """Half palm and finger (m) of the smallest hand that does, not below ``low`` nor above ``high``; None: none does."""
        within, low = WITHIN if self.fine else ROUGHLY, min(low, high)
        above = min(low * (1.0 + within), high)
        while self.best(above)[0] < 0.0:
            if above >= high:
                return None
            low, above = above, min(above * GROWTH, high)
        if self.best(low)[0] >= 0.0:
            return self.best(low)[1:]
        bisect(lambda size: 1.0 if self.best(size)[0] >= 0.0 else -1.0, low, above, rtol=within, xtol=within * low)
        enough = min(size for size, (slack, _, _) in self._known.items() if slack >= 0.0 and size >= low)
        return self.best(enough)[1:]

    def _best(self, size: float) -> tuple[float, float, float]:
        half = 0.5 * size
        palm, finger = self.limits.palm_width, self.limits.finger_length
        least = max(0.5 * palm[0], half - finger[1], 1e-3 * half)
        most = min(0.5 * palm[1], half - finger[0], half * (1.0 - 1e-3))
        if least > most:
            return -np.inf, least, half - least
        tried: dict[float, float] = {}

        def lack(share: float) -> float:
            d = min(max(share * half, least), most)
            if d not in tried:
                tried[d] = self.slack(d, half - d)
            return -tried[d]

        shares = self._shares(least / half, most / half)
        found = [lack(share) for share in shares]
        at = int(np.argmin(found))
        if self.fine and len(shares) > 1:
            between = (shares[max(at - 1, 0)], shares[min(at + 1, len(shares) - 1)])
            minimize_scalar(lack, bounds=between, method="bounded", options={"maxiter": STEPS})
        best = max(tried, key=lambda d: tried[d])
        if tried[best] > min(tried.values()):  # else nothing is known of the best proportion yet
            self._share = best / half
        return tried[best], float(best), float(half - best)

    def _shares(self, least: float, most: float) -> list[float]:
        if most - least < 1e-9:
            return [least]
        if self._share is None:
            return [float(each) for each in np.linspace(least, most, SHARES)]
        low, high = max(least, self._share - NEAR), min(most, self._share + NEAR)
        return [float(each) for each in np.linspace(min(low, most), max(high, least), NEAR_SHARES)]
