"""The chance of a catch when the object's place is known up to a Gaussian error, and the hand offset that makes it best."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from palmar.models.guarantee import Guarantee
from palmar.regions.best_place import Place, best_place, largest_scale, place
from palmar.regions.probability import edges_of
from palmar.regions.region import Region

Floats = NDArray[np.float64]
Pair = tuple[float, float]
WANTED = (0.99, 0.999)


@dataclass(frozen=True)
class PoseError:
    """Gaussian error of the object's pose: standard deviations (m) along x and y, their correlation, and of the angle (rad).

    A disk has no angle; an error of the hand's own angle moves the object in the hand frame and belongs to the position.
    """

    sigma: Pair
    correlation: float = 0.0
    sigma_theta: float = 0.0

    @property
    def factor(self) -> Floats:
        """The covariance's Cholesky factor (2, 2), m."""
        x, y = self.sigma
        covariance = self.correlation * x * y
        factor: Floats = np.linalg.cholesky(np.array([[x * x, covariance], [covariance, y * y]])).astype(float)
        return factor


@dataclass(frozen=True)
class Chance:
    """A place (m, hand frame), the chance of a catch there and its bounds (None: unknown), and the chance of a loss.

    ``at_least`` and ``at_most`` enclose the chance: by the region's inner and outer side, or as a confidence interval.
    """

    at: Pair
    probability: float
    loss: float
    at_least: float | None
    at_most: float | None


@dataclass(frozen=True)
class Tolerance:
    """By what factor the error may grow until the chance is just ``wanted``, at the nominal place and at the best one.

    None where no error is small enough.
    """

    wanted: float
    nominal: float | None
    best: float | None


@dataclass(frozen=True)
class Capture:
    """Chances at the nominal and at the best place; moving the hand by ``offset`` (m) puts the object at the best one."""

    error: PoseError
    guarantee: Guarantee
    nominal: Chance
    best: Chance | None
    tolerances: tuple[Tolerance, ...]
    notes: tuple[str, ...] = ()

    @property
    def offset(self) -> Pair | None:
        """The hand's translation (m), along the axes of its frame, that brings the object to the best place."""
        if self.best is None:
            return None
        return self.nominal.at[0] - self.best.at[0], self.nominal.at[1] - self.best.at[1]


def capture_from_region(region: Region, error: PoseError, at: Pair) -> Capture:
    """The chances from a region: its mass under the Gaussian, to about 1e-13."""
    if region.centre.is_empty:
        nothing = Chance(at, 0.0, 1.0, 0.0, 0.0 if region.outer is not None else None)
        return Capture(error, region.guarantee, nothing, None, ())
    factor = error.factor
    nominal = _bounded(region, place(edges_of(region.centre), at, factor), factor)
    best = _bounded(region, best_place(region.centre, factor, (at,)), factor)
    tolerances = tuple(
        Tolerance(
            wanted,
            largest_scale(region.centre, factor, wanted, at),
            largest_scale(region.centre, factor, wanted, None),
        )
        for wanted in WANTED
    )
    return Capture(error, region.guarantee, nominal, best, tolerances)


def _bounded(region: Region, found: Place, factor: Floats) -> Chance:
    """The inner side gives the chance that is promised, the outer side the one that cannot be exceeded."""
    at_most = None
    if region.outer is not None:
        at_most = max(place(edges_of(region.outer), found.at, factor).inside, found.inside)
    return Chance(found.at, found.inside, found.outside, found.inside, at_most)
