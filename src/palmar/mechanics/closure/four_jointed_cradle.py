"""Disks held between the proximal and the distal links of a 4-jointed hand, clear of the palm.

The proximal link leans outwards by lambda and touches the disk at elevation -lambda; s is the distance from there to
the elbow. In the folded hold it leans inwards, beyond the axis, and touches at elevation phi; the distal link, folded
back under the disk, carries it. Both are the same geometry with opposite signs of lean and radius.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
GOLDEN = (5.0**0.5 - 1.0) / 2.0
GOLDEN_STEPS, HALVINGS, NODES = 44, 52, 300
KINKED_STEPS = 70
"""Steps towards a peak that is a kink, where the value is only as good as the place."""


def cradled_radius(w: Floats, p: Floats, q: Floats, on_palm: Floats, alpha: Floats | float = 0.0) -> Floats:
    """Largest radius (m) with the proximal link tangent, leaning outwards, and the distal contact at -alpha.

    For w < P and Q < P - w. Along growing lean the distal link touches with its inside, then with its tip: R grows until
    the tip is the tangent point, and beyond it until it is stationary or the disk comes down to the palm (radius
    ``on_palm``, NaN where the tip cannot come that high on a disk on the palm).
    """
    low = np.broadcast_to(np.asarray(alpha, dtype=float), w.shape)
    first = _bisected(lambda lean: _tangent_lasts(lean, w, p, q, alpha), low, np.full_like(w, 0.5 * pi))
    farthest = _bisected(lambda lean: _under(lean, w, p, q, alpha) >= 0.0, first, np.full_like(w, 0.5 * pi))
    last = np.where(np.isnan(on_palm), farthest, 0.5 * pi - 2.0 * np.arctan2(w, on_palm))
    ends = first, np.maximum(first, last)
    stationary = golden_maximum(lambda lean: _radius_at_tip(lean, w, p, q, alpha), *ends)
    return np.fmax(np.fmax(_radius_at_tip(first, w, p, q, alpha), stationary), on_palm)


def folded_radius(half_palm: ArrayLike, proximal: ArrayLike, distal: ArrayLike) -> Floats:
    """Largest radius (m) of the folded hold, NaN where there is none; it exists for 0 < w < P and 0 < Q < P.

    Every smaller disk can be held so too. Found by a search over the lean: several bounds cross.
    """
    columns = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (half_palm, proximal, distal)))
    w, p, q = (each.ravel() for each in columns)
    result = np.full_like(w, np.nan)
    some = np.flatnonzero(folds(w, p, q))
    if some.size:
        w, p, q = w[some], p[some], q[some]
        first, last = np.arcsin(w / p), np.full_like(w, 0.5 * pi)
        level = np.clip(np.arccos(q / p), first, last)
        found = np.maximum(_folded_peak(first, level, w, p, q), _folded_peak(level, last, w, p, q))
        result[some] = np.where(found > 0.0, found, np.nan)
    return result.reshape(columns[0].shape)


def folds(w: Floats, p: Floats, q: Floats) -> NDArray[np.bool_]:
    """Whether the hand has a folded hold: the elbow passes the axis, and the distal link fits above the palm line."""
    return np.asarray((w > 0.0) & (w < p) & (q > 0.0) & (q < p))


def _folded_peak(low: Floats, high: Floats, w: Floats, p: Floats, q: Floats) -> Floats:
    """Highest of the peaks between two leans: every peak on a grid is refined."""
    shares = np.linspace(0.0, 1.0, NODES + 1)[:, None]
    leans = low + shares * (high - low)
    values = _folded_at(leans, w, p, q)
    walled = np.pad(values, ((1, 1), (0, 0)), constant_values=-np.inf)
    node, hand = np.nonzero((values >= walled[:-2]) & (values >= walled[2:]))
    ends = leans[np.maximum(node - 1, 0), hand], leans[np.minimum(node + 1, NODES), hand]
    w, p, q = w[hand], p[hand], q[hand]
    best: Floats = values.max(axis=0)
    np.maximum.at(best, hand, golden_maximum(lambda lean: _folded_at(lean, w, p, q), *ends, KINKED_STEPS))
    return best


def golden_maximum(
    function: Callable[[Floats], Floats], low: Floats, high: Floats, steps: int = GOLDEN_STEPS
) -> Floats:
    """Largest values met by golden section searches for functions with one peak in [low, high]."""
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = function(left), function(right)
    best = np.fmax(at_left, at_right)
    for _ in range(steps):
        falls = at_left > at_right
        low, high = np.where(falls, low, left), np.where(falls, right, high)
        fresh = np.where(falls, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        value = function(fresh)
        left, right = np.where(falls, fresh, right), np.where(falls, left, fresh)
        at_left, at_right = np.where(falls, value, at_right), np.where(falls, at_left, value)
        best = np.fmax(best, value)
    return best


def _tangent_lasts(lean: Floats, w: Floats, p: Floats, q: Floats, alpha: Floats | float) -> NDArray[np.bool_]:
    """Whether at this lean the distal link is longer than its tangent to a disk that it touches at -alpha."""
    half = 0.5 * (lean - alpha)
    interior = (w + (p - q) * np.sin(lean)) * np.sin(half)
    return np.asarray(q * np.cos(half) * np.cos(lean) >= interior)


def _radius_at_tip(lean: Floats, w: Floats, p: Floats, q: Floats, alpha: Floats | float) -> Floats:
    """Radius touched at -alpha by the tip, and tangentially by the proximal link at this lean."""
    sine, cosine = np.sin(lean), np.cos(lean)
    level = 1.0 - np.sin(alpha) * sine
    share = sine**2 * np.cos(alpha) + cosine * level
    root = np.sqrt(np.maximum(_under(lean, w, p, q, alpha), 0.0))
    return np.asarray(((w + p * sine) * share + sine * root) / (2.0 * level - cosine**2))


def _under(lean: Floats, w: Floats, p: Floats, q: Floats, alpha: Floats | float) -> Floats:
    """What stands under the root: negative where the tip cannot reach that point of any disk."""
    sine = np.sin(lean)
    weight = 1.0 + sine**2 - 2.0 * np.sin(alpha) * sine
    return np.asarray(weight * q**2 - (2.0 * (w + p * sine) * np.sin(0.5 * (lean - alpha)) ** 2) ** 2)


def _bisected(holds: Callable[[Floats], NDArray[np.bool_]], low: Floats, high: Floats) -> Floats:
    """The last place at which a condition that holds at ``low`` still does."""
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        true = holds(middle)
        low, high = np.where(true, middle, low), np.where(true, high, middle)
    return low


def _folded_at(lean: Floats, w: Floats, p: Floats, q: Floats) -> Floats:
    """Largest radius of the folded hold with the proximal contact at elevation ``lean``.

    The palm must clear, R (1 + sin) <= w cos; the distal contact lies at half a turn or beyond, and the distal
    link's end not below the palm line, which is the sharper bound where P cos < Q.
    """
    sine, cosine = np.sin(lean), np.cos(lean)
    clear = w * cosine / (1.0 + sine)
    beyond = p * sine - w
    half = 0.5 * (pi - lean + np.arccos(np.minimum(p * cosine / q, 1.0)))
    below = sine * np.sin(half) - cosine * np.cos(half)
    interior = beyond * np.cos(half) / below
    reached = w - (p - q) * sine
    under = (1.0 + sine**2) * q**2 - (beyond * (1.0 + cosine)) ** 2
    tip = (beyond * (sine**2 - cosine) + sine * np.sqrt(np.maximum(under, 0.0))) / (1.0 + sine**2)
    tip = np.where(under >= 0.0, tip, -1.0)
    return np.minimum(clear, np.where(interior * cosine <= reached, interior, tip))
