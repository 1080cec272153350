"""Where in a set a Gaussian error does least harm, and how large an error a wanted probability leaves room for."""

from __future__ import annotations

from dataclasses import dataclass
from math import log

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, affinity

from palmar.geometry.planar_set import areal, inscribed_circle
from palmar.regions.probability import Edges, chance, edges_of

Floats = NDArray[np.float64]
SURE = 1e-12
"""A chance of loss below this is rounding: the place counts as the best there is."""
NARROWEST, WIDEST, FINE = 1e-4, 1e4, 1e-5
"""Errors are scaled by factors between the first two, to the relative precision of the third."""


@dataclass(frozen=True)
class Place:
    """A mean (m) and the chances of lying inside the set, and outside it, there."""

    at: tuple[float, float]
    inside: float
    outside: float


def place(edges: Edges, at: tuple[float, float], factor: Floats) -> Place:
    """The chances at a given mean; ``factor`` is the covariance's Cholesky factor (m)."""
    found = chance(edges, np.array(at), factor)
    return Place(at, found.inside, found.outside)


def best_place(region: MultiPolygon, factor: Floats, starts: tuple[tuple[float, float], ...] = ()) -> Place:
    """The mean at which the chance is greatest: BFGS on the logarithm of the chance of loss, from several starts.

    The starts are those given and, for every part of the set, its centroid and the middle of the largest circle inside
    it as the error sees it (whitened); as the error shrinks that middle becomes the answer.
    """
    return _best(edges_of(region), factor, (*_middles(region, factor), *starts))


def _best(edges: Edges, factor: Floats, begins: tuple[tuple[float, float], ...]) -> Place:
    from scipy.optimize import minimize

    def loss(at: Floats) -> tuple[float, Floats]:
        here = chance(edges, factor @ at, factor)
        lost = max(here.outside, SURE)
        return log(lost), -(factor.T @ here.gradient) / lost

    best = max((place(edges, begin, factor) for begin in begins), key=_merit)
    for begin in begins if best.outside > SURE else ():
        # In units of the error, so that steps of one are reasonable.
        result = minimize(loss, np.linalg.solve(factor, begin), jac=True, method="BFGS", options={"gtol": 1e-7})
        x, y = factor @ result.x
        best = max(best, place(edges, (float(x), float(y)), factor), key=_merit)
    return best


def _merit(found: Place) -> float:
    return -found.outside


def _middles(region: MultiPolygon, factor: Floats) -> tuple[tuple[float, float], ...]:
    """For every part of the set the middle of its largest inscribed error ellipse, and its centroid."""
    inverse = np.linalg.inv(factor)
    merged = areal(shapely.union_all(list(region.geoms)))
    points = []
    for part in merged.geoms:
        seen = affinity.affine_transform(part, [*inverse[0], *inverse[1], 0.0, 0.0])
        left, low, right, high = seen.bounds
        middle = factor @ inscribed_circle(MultiPolygon([seen]), 1e-4 * max(right - left, high - low)).centre
        points += [(float(middle[0]), float(middle[1])), (part.centroid.x, part.centroid.y)]
    return tuple(points)


def largest_scale(region: MultiPolygon, factor: Floats, wanted: float, at: tuple[float, float] | None) -> float | None:
    """By what factor the error may grow (or must shrink) until the chance of a catch is just ``wanted``.

    At the given mean, or at the best one for every factor if that is None. None where no error is small enough, or large
    enough. The chance need not fall steadily as the error grows; the answer is the first factor, from below, at which it
    gets too small.
    """
    edges = edges_of(region)
    # A factor leaves the shape of the error as it is, and with it the ellipses' middles.
    begins = (at,) if at is not None else _middles(region, factor)

    def good(scale: float) -> bool:
        nonlocal begins
        if any(place(edges, begin, scale * factor).inside >= wanted for begin in begins):
            return True
        if at is not None:
            return False
        best = _best(edges, scale * factor, begins)
        begins = (best.at,)
        return best.inside >= wanted

    if not good(NARROWEST):
        return None
    low, high = NARROWEST, 2.0 * NARROWEST
    while good(high):
        low, high = high, 2.0 * high
        if high > WIDEST:
            return None
    while high - low > FINE * high:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if good(middle) else (low, middle)
    return low
