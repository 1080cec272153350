"""Fingers of two links that curl before they close: the best palm, links and preshape angle of a hand of a given size.

Three proportions: the palm's share of what the reach leaves, the proximal link's share of the finger, the angle. They are
looked for by a scan and then one at a time in steps that are halved, from the best ones of the last size on, until they do
what is asked. Nothing says that a best so found is the best there is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from math import radians

import numpy as np

from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.design_brief import DesignBrief, Limits
from palmar.studies.design.search import Dimensions, half_palms

Shape = tuple[float, float, float]
SCAN: tuple[Shape, ...] = tuple(product((0.1, 0.6), (0.5, 0.75), (radians(20.0), radians(40.0))))
STEPS: Shape = (0.2, 0.12, radians(10.0))
ROUNDS = 4
"""How often steps are halved."""
PROXIMAL, ANGLES = (0.1, 0.95), (radians(1.0), radians(120.0))
"""Least and greatest share of the proximal link, and preshape angle (rad)."""
LINKS = 2


def may_curl(brief: DesignBrief) -> bool:
    """Whether curling is tried: disks to be caught, not felt for, by fingers that may have two links."""
    targets, limits = brief.targets, brief.limits
    catching = targets.radii is not None and targets.error > 0.0 and targets.sensors is None
    return catching and limits.curl and LINKS in limits.links


def curling(preshape: float) -> Behaviour:
    """Curl to that angle (rad), then close."""
    return Behaviour(name=BehaviourName.CURL_AND_CLOSE, preshape=preshape)


@dataclass
class Curled:
    """The best hand of a size; ``slack`` of half palm, proximal and distal link (m) and preshape (rad).

    It need not be worked out where it is no more than its fifth number. ``reach`` (m): no shorter finger will do.
    """

    slack: Callable[[float, float, float, float, float], float]
    limits: Limits
    reach: float
    _last: Shape | None = None

    def best(self, size: float) -> tuple[float, Dimensions]:
        """(slack, (half palm, proximal, distal, preshape)), the first found that does if one does."""
        half = 0.5 * size
        least, most = half_palms(size, self.limits, self.reach)
        if least > most:
            return -np.inf, ()

        def dimensions(shape: Shape) -> tuple[float, float, float, float]:
            d = least + shape[0] * (most - least)
            return d, shape[1] * (half - d), (1.0 - shape[1]) * (half - d), shape[2]

        def ask(shape: Shape, beaten: float) -> float:
            return self.slack(*dimensions(shape), beaten)

        shape, found = self._scanned(ask)
        shape, found = _climbed(shape, found, ask)
        self._last = shape
        return found, dimensions(shape)

    def _scanned(self, ask: Callable[[Shape, float], float]) -> tuple[Shape, float]:
        """The best shape of the last size if it does, else the best of that one and the scan's."""
        shape, found = SCAN[0], -np.inf
        for each in SCAN if self._last is None else (self._last, *SCAN):
            value = ask(each, found)
            if value > found:
                shape, found = each, value
            if each == self._last and found >= 0.0:
                break
        return shape, found


def _climbed(shape: Shape, found: float, ask: Callable[[Shape, float], float]) -> tuple[Shape, float]:
    """From a shape with slack ``found`` to a better one, until it does or no step helps."""
    steps, rounds = STEPS, 0
    asked = {shape}
    while found < 0.0 and rounds < ROUNDS:
        for each in _around(shape, steps):
            if each in asked:
                continue
            asked.add(each)
            value = ask(each, found)
            if value > found:
                shape, found = each, value
                break
        else:
            steps, rounds = (0.5 * steps[0], 0.5 * steps[1], 0.5 * steps[2]), rounds + 1
    return shape, found


def _around(shape: Shape, steps: Shape) -> Iterator[Shape]:
    for k, (low, high) in enumerate(((0.0, 1.0), PROXIMAL, ANGLES)):
        for step in (steps[k], -steps[k]):
            moved = list(shape)
            moved[k] = min(max(shape[k] + step, low), high)
            yield moved[0], moved[1], moved[2]
