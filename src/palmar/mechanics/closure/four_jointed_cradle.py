"""Disks held between the proximal and the distal links of a 4-jointed hand, clear of the palm.

The proximal link leans outwards by lambda and touches the disk at elevation -lambda; s is the distance from there to
the elbow. In the folded hold it leans inwards, beyond the axis, and touches at elevation phi; the distal link, folded
back under the disk, carries it. Both are the same geometry with opposite signs of lean and radius.
"""

from __future__ import annotations

from math import acos, asin, atan2, cos, inf, isnan, nan, pi, sin, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.closure.each_hand import of_each_hand

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
    return of_each_hand(_cradled, _CALLED, w, p, q, on_palm, np.full_like(w, alpha))


def folded_radius(half_palm: ArrayLike, proximal: ArrayLike, distal: ArrayLike) -> Floats:
    """Largest radius (m) of the folded hold, NaN where there is none; it exists for 0 < w < P and 0 < Q < P.

    Every smaller disk can be held so too. Found by a search over the lean: several bounds cross.
    """
    columns = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (half_palm, proximal, distal)))
    w, p, q = (each.ravel() for each in columns)
    result = np.full_like(w, nan)
    some = np.flatnonzero(folds(w, p, q))
    found = of_each_hand(_folded, _CALLED, w[some], p[some], q[some])
    result[some] = np.where(found > 0.0, found, nan)
    return result.reshape(columns[0].shape)


def folds(w: Floats, p: Floats, q: Floats) -> NDArray[np.bool_]:
    """Whether the hand has a folded hold: the elbow passes the axis, and the distal link fits above the palm line."""
    return np.asarray((w > 0.0) & (w < p) & (q > 0.0) & (q < p))


def _folded(w: float, p: float, q: float) -> float:
    """``folded_radius`` of one hand, not above 0 where there is none."""
    first = asin(w / p)
    level = min(max(acos(q / p), first), 0.5 * pi)
    return max(_folded_peak(first, level, w, p, q), _folded_peak(level, 0.5 * pi, w, p, q))


def _cradled(w: float, p: float, q: float, on_palm: float, alpha: float) -> float:
    """``cradled_radius`` of one hand."""
    first = _last_tangent(w, p, q, alpha)
    last = _last_reached(first, w, p, q, alpha) if isnan(on_palm) else 0.5 * pi - 2.0 * atan2(w, on_palm)
    stationary = _golden_maximum(False, first, max(first, last), w, p, q, alpha, GOLDEN_STEPS)
    found = max(_radius_at_tip(first, w, p, q, alpha), stationary)
    return found if isnan(on_palm) else max(found, on_palm)


def _folded_peak(low: float, high: float, w: float, p: float, q: float) -> float:
    """Highest of the peaks between two leans: every peak on a grid is refined, and every end of a level stretch."""
    step = (high - low) / NODES
    best = before = -inf
    now = _folded_at(low, w, p, q)
    for k in range(NODES + 1):
        after = _folded_at(low + (k + 1) * step, w, p, q) if k < NODES else -inf
        if now >= max(before, after) and now > min(before, after):
            left, right = low + max(k - 1, 0) * step, low + min(k + 1, NODES) * step
            best = max(best, now, _golden_maximum(True, left, right, w, p, q, 0.0, KINKED_STEPS))
        before, now = now, after
    return best


def _golden_maximum(
    folded: bool, low: float, high: float, w: float, p: float, q: float, alpha: float, steps: int
) -> float:
    """Largest value met by a golden section search for a function of the lean with one peak in [low, high]."""
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = _radius(folded, left, w, p, q, alpha), _radius(folded, right, w, p, q, alpha)
    best = max(at_left, at_right)
    for _ in range(steps):
        if at_left > at_right:
            high, right, at_right = right, left, at_left
            left = high - GOLDEN * (high - low)
            at_left = _radius(folded, left, w, p, q, alpha)
            best = max(best, at_left)
        else:
            low, left, at_left = left, right, at_right
            right = low + GOLDEN * (high - low)
            at_right = _radius(folded, right, w, p, q, alpha)
            best = max(best, at_right)
    return best


def _radius(folded: bool, lean: float, w: float, p: float, q: float, alpha: float) -> float:
    """What is searched for its maximum."""
    return _folded_at(lean, w, p, q) if folded else _radius_at_tip(lean, w, p, q, alpha)


def _last_tangent(w: float, p: float, q: float, alpha: float) -> float:
    """The last lean at which the distal link is longer than its tangent to a disk that it touches at -alpha."""
    low, high = alpha, 0.5 * pi
    for _ in range(HALVINGS):
        lean = 0.5 * (low + high)
        half = 0.5 * (lean - alpha)
        if q * cos(half) * cos(lean) >= (w + (p - q) * sin(lean)) * sin(half):
            low = lean
        else:
            high = lean
    return low


def _last_reached(low: float, w: float, p: float, q: float, alpha: float) -> float:
    """The last lean, from ``low`` on, at which the tip reaches that point of a disk."""
    high = 0.5 * pi
    for _ in range(HALVINGS):
        lean = 0.5 * (low + high)
        if _under(lean, w, p, q, alpha) >= 0.0:
            low = lean
        else:
            high = lean
    return low


def _radius_at_tip(lean: float, w: float, p: float, q: float, alpha: float) -> float:
    """Radius touched at -alpha by the tip, and tangentially by the proximal link at this lean."""
    sine, cosine = sin(lean), cos(lean)
    level = 1.0 - sin(alpha) * sine
    share = sine**2 * cos(alpha) + cosine * level
    root = sqrt(max(_under(lean, w, p, q, alpha), 0.0))
    return ((w + p * sine) * share + sine * root) / (2.0 * level - cosine**2)


def _under(lean: float, w: float, p: float, q: float, alpha: float) -> float:
    """What stands under the root: negative where the tip cannot reach that point of any disk."""
    sine = sin(lean)
    weight = 1.0 + sine**2 - 2.0 * sin(alpha) * sine
    return weight * q**2 - (2.0 * (w + p * sine) * sin(0.5 * (lean - alpha)) ** 2) ** 2


def _folded_at(lean: float, w: float, p: float, q: float) -> float:
    """Largest radius of the folded hold with the proximal contact at elevation ``lean``.

    The palm must clear, R (1 + sin) <= w cos; the distal contact lies at half a turn or beyond, and the distal
    link's end not below the palm line, which is the sharper bound where P cos < Q.
    """
    sine, cosine = sin(lean), cos(lean)
    clear = w * cosine / (1.0 + sine)
    beyond = p * sine - w
    half = 0.5 * (pi - lean + acos(min(p * cosine / q, 1.0)))
    below = sine * sin(half) - cosine * cos(half)
    interior = beyond * cos(half) / below
    if interior * cosine <= w - (p - q) * sine:
        return min(clear, interior)
    under = (1.0 + sine**2) * q**2 - (beyond * (1.0 + cosine)) ** 2
    if under < 0.0:
        return min(clear, -1.0)
    return min(clear, (beyond * (sine**2 - cosine) + sine * sqrt(under)) / (1.0 + sine**2))


_CALLED = (
    _folded_peak, _golden_maximum, _radius, _last_tangent, _last_reached, _radius_at_tip, _under, _folded_at,
)  # fmt: skip
"""What the functions of one hand call."""
