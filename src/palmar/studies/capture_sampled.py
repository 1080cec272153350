"""The chance of a catch from simulated starts: where the angle of a polygon is uncertain, or no region covers the case.

Integrating simulated regions over the angle is slower and says less: their inner and outer sides are a grid spacing apart.

Starts are independent draws of the error from a seeded generator, so that the exact interval of Clopper and Pearson
holds for the share caught. The best place is sought on coarse starts over the whole hand, smoothed with the
error's own Gaussian, and then judged by fresh draws.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from palmar.models.case import Case
from palmar.models.guarantee import Guarantee
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.studies.capture import Capture, Chance, Pair, PoseError
from palmar.studies.simulate import simulate_starts

Floats = NDArray[np.float64]
DRAWS, COARSE, GRID = 4000, 3000, 41
CONFIDENCE = 0.95
LEAST_SMOOTHING = 0.05
"""In the search, errors below this share of the finger's length are widened to it: coarse starts lie no closer."""


def capture_from_starts(case: Case, error: PoseError, at: Pair, seed: int = 0) -> Capture:
    """The chances at the nominal and at the best place found; raises NotCoveredError where no kernel carries the case."""
    rng = np.random.default_rng(seed)
    nominal = _judged(case, error, at, rng)
    found = _sought(case, error, at, rng)
    best = _judged(case, error, found, rng)
    if best.probability <= nominal.probability:
        best = nominal
    note = (
        f"the chance of a catch is the share of {DRAWS} simulated starts (seed {seed}), its bounds are a "
        f"{100.0 * CONFIDENCE:.0f}% confidence interval; the best place was sought on {COARSE} coarse starts"
    )
    return Capture(error, Guarantee.SAMPLED, nominal, best, (), (note,))


def _judged(case: Case, error: PoseError, at: Pair, rng: np.random.Generator) -> Chance:
    """The share of draws about a place that is caught, with its confidence interval."""
    places = np.array(at) + rng.standard_normal((DRAWS, 2)) @ error.factor.T
    caught = int(_caught(case, places, _angles(case, error, DRAWS, rng)).sum())
    low, high = clopper_pearson(caught, DRAWS)
    return Chance(at, caught / DRAWS, 1.0 - caught / DRAWS, low, high)


def clopper_pearson(hits: int, draws: int, confidence: float = CONFIDENCE) -> Pair:
    """The exact confidence interval of a share: quantiles of beta distributions."""
    from scipy.special import betaincinv

    tail = 0.5 * (1.0 - confidence)
    low = float(betaincinv(hits, draws - hits + 1, tail)) if hits > 0 else 0.0
    high = float(betaincinv(hits + 1, draws - hits, 1.0 - tail)) if hits < draws else 1.0
    return low, high


def _sought(case: Case, error: PoseError, at: Pair, rng: np.random.Generator) -> Pair:
    """The place with the greatest smoothed share of coarse starts caught."""
    hand = case.hand
    reach = 0.0 if isinstance(case.object, Disk) else float(np.linalg.norm(case.object.vertices, axis=1).max())
    wide, high = hand.half_palm + hand.finger_length + reach, hand.finger_length + reach
    places = np.column_stack([rng.uniform(-wide, wide, COARSE), rng.uniform(0.0, high, COARSE)])
    caught = _caught(case, places, _angles(case, error, COARSE, rng))
    widths = np.maximum(error.sigma, LEAST_SMOOTHING * hand.finger_length)
    x, y = (each.ravel() for each in np.meshgrid(np.linspace(-wide, wide, GRID), np.linspace(0.0, high, GRID)))
    candidates = np.column_stack([np.append(x, at[0]), np.append(y, at[1])])
    apart = (candidates[:, None, :] - places[None, :, :]) / widths
    weights = np.exp(-0.5 * np.sum(apart**2, axis=2))
    # Beyond the coarse starts nothing is known to be caught: the full weight of the Gaussian, not the one found, divides.
    full = 2.0 * np.pi * widths[0] * widths[1] * COARSE / (2.0 * wide * high)
    best = candidates[int(np.argmax(weights @ caught / np.maximum(weights.sum(axis=1), full)))]
    return float(best[0]), float(best[1])


def _angles(case: Case, error: PoseError, count: int, rng: np.random.Generator) -> Floats:
    return case.start.theta + error.sigma_theta * rng.standard_normal(count)


def _caught(case: Case, places: Floats, angles: Floats) -> NDArray[np.bool_]:
    codes = simulate_starts(case, np.column_stack([places, angles])).codes
    caught: NDArray[np.bool_] = codes <= Outcome.CAGED.code
    return caught
