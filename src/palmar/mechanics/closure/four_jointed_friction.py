"""The largest disk a 4-jointed hand holds with friction: chapter 2's argument for jointed fingers, in closed form.

A contact may lie below the equator by the friction angle alpha. So a disk is held if it lies on the palm and a link
touches at elevation e >= -alpha; or off the palm, if one link touches with |e| <= alpha, alone or beside a proximal link
that is in the way; or as without friction. Each has its largest disk, and the largest of these counts. Notation as in
four_jointed_5_1; derived in docs/derivations/four_jointed.md.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.closure.four_jointed_5_1 import four_jointed_radii
from palmar.mechanics.closure.four_jointed_cradle import cradled_radius
from palmar.mechanics.closure.four_jointed_tip import tip_roots

Floats = NDArray[np.float64]


def largest_with_friction(
    half_palm: ArrayLike, proximal: ArrayLike, distal: ArrayLike, friction_angle: ArrayLike
) -> Floats:
    """Largest radius (m) held with friction angle alpha in [0, pi/2); arguments broadcast, NaN where none is held."""
    given = (half_palm, proximal, distal, friction_angle)
    columns = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in given))
    w, p, q, alpha = (each.ravel() for each in columns)
    with np.errstate(invalid="ignore", divide="ignore"):
        plain = four_jointed_radii(w, p, q).overall.max
        found = [_one_link(w, p, alpha), _distal_on_palm(w, p, q, alpha), _pinched(w, p, alpha)]
        found += [_pinched(w + p, q, alpha), _cradled(w, p, q, alpha)]
        rough = np.fmax.reduce([plain, *found])
    return np.where(alpha > 0.0, rough, plain).reshape(columns[0].shape)


def _one_link(w: Floats, length: Floats, alpha: Floats) -> Floats:
    """On the palm, touched by a straight finger: the joint below the deepest contact, or the tip at it (eq. 2.3)."""
    c, less = np.cos(alpha), 1.0 - np.sin(alpha)
    tip = (w * c + np.sqrt(w**2 * c**2 - 2.0 * less * (w**2 - length**2))) / (2.0 * less)
    return np.where(w <= length, w * c / less, tip)


def _distal_on_palm(w: Floats, p: Floats, q: Floats, alpha: Floats) -> Floats:
    """On the palm, the distal link tangent with its tip at the deepest contact, or as the structural cases say."""
    s, c = np.sin(alpha), np.cos(alpha)
    less, half = 1.0 - s, c * (w + q)
    constant = w**2 + q**2 + 2.0 * w * q * s - p**2
    tip = (half + np.sqrt(half**2 - 2.0 * less * constant)) / (2.0 * less)
    straight, along = _one_link(w, p + q, alpha), (w + p) * c / less
    return np.select([w >= p + q, q >= w + p, q >= p - w], [straight, along, tip], tip_roots(w, p, q, alpha).max)


def _pinched(base: Floats, length: Floats, alpha: Floats) -> Floats:
    """Off the palm, between two links that lean out by alpha from joints on the palm line (equation 2.1)."""
    s, c = np.sin(alpha), np.cos(alpha)
    radius = (base + length * s) / c
    return np.where(length * c + radius * s >= radius, radius, np.nan)


def _cradled(w: Floats, p: Floats, q: Floats, alpha: Floats) -> Floats:
    """Off the palm, the tip at -alpha and the proximal link tangent: short distal links, Q < t."""
    result = np.full_like(w, np.nan)
    some = np.flatnonzero((q < p - w) & (q > 0.0))
    w, p, q, alpha = w[some], p[some], q[some], alpha[some]
    result[some] = cradled_radius(w, p, q, tip_roots(w, p, q, alpha).max, alpha)
    return result
