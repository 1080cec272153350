"""Short distal links, Q < t = P - w: disks on the palm that the proximal links touch tangentially and the tips reach.

The elbow is at distance sqrt(R^2 + t^2) from the centre, so the tip reaches the disk if R >= R0 = (t^2 - Q^2)/(2Q). Its
elevation at contact rises steeply from R0, has one maximum and falls; disks at which it is not negative are held.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.closure.disk_2_2 import Radii

Floats = NDArray[np.float64]
STEPS = 120
ROUNDING = 2.0**-51


def tip_elevation(radius: Floats, w: Floats, p: Floats, q: Floats) -> Floats:
    """Elevation (rad) of the tip's contact on a disk of ``radius`` (m) on the palm, the proximal link tangent."""
    t = p - w
    return -0.5 * pi + 2.0 * np.arctan2(w, radius) + np.arctan2(t, radius) + tip_angle(radius, t, q)


def tip_angle(radius: Floats, tangent: Floats, q: Floats) -> Floats:
    """Angle (rad) at the disk's centre between elbow and tip; ``tangent`` is the elbow's distance to the contact.

    From the three sides of the triangle, by half the angle, which keeps its digits where the tip points at the centre.
    """
    elbow = np.hypot(radius, tangent)
    low = (q + radius - elbow) * (q - radius + elbow)
    high = (radius + elbow - q) * (radius + elbow + q)
    return np.asarray(2.0 * np.arctan2(np.sqrt(np.maximum(low, 0.0)), np.sqrt(np.maximum(high, 0.0))))


def tip_roots(w: Floats, p: Floats, q: Floats, alpha: Floats | float = 0.0) -> Radii:
    """Smallest and largest radius (m) with a contact at -alpha or above, for flat arrays; NaN where none or Q >= t."""
    low, high = np.full_like(w, np.nan), np.full_like(w, np.nan)
    some = np.flatnonzero((q < p - w) & (q > 0.0))
    w, p, q, alpha = w[some], p[some], q[some], np.broadcast_to(alpha, high.shape)[some]
    t = p - w
    first, last = (t - q) * (t + q) / (2.0 * q), 2.0 * (w + p + q) / (1.0 - np.sin(alpha))
    top = _passing(_slope, first, np.maximum(first, last), (w, p, q), 1e-9)
    held = (first < last) & (_margin(top, w, p, q, alpha) >= 0.0)
    some = some[held]
    w, p, q, alpha, first, last, top = (each[held] for each in (w, p, q, alpha, first, last, top))
    high[some] = _passing(_margin, top, last, (w, p, q, alpha))
    at_first = _margin(first, w, p, q, alpha) >= 0.0
    rising = np.flatnonzero(~at_first)
    first[rising] = _passing(_shortfall, first[rising], top[rising], tuple(x[rising] for x in (w, p, q, alpha)))
    low[some] = first
    return Radii(low, high)


def _margin(radius: Floats, w: Floats, p: Floats, q: Floats, alpha: Floats) -> Floats:
    return tip_elevation(radius, w, p, q) + alpha


def _shortfall(radius: Floats, w: Floats, p: Floats, q: Floats, alpha: Floats) -> Floats:
    return -_margin(radius, w, p, q, alpha)


def _slope(radius: Floats, w: Floats, p: Floats, q: Floats) -> Floats:
    """Sign of the elevation's derivative by R: the derivative times a positive factor."""
    t = p - w
    elbow_2 = radius**2 + t**2
    excess = t**2 - q**2
    under = 4.0 * radius**2 * elbow_2 - (2.0 * radius**2 + excess) ** 2
    turning = (excess * (2.0 * radius**2 + t**2) - 2.0 * radius**2 * t**2) / (radius * elbow_2)
    return turning - np.sqrt(np.maximum(under, 0.0)) * (2.0 * w / (w**2 + radius**2) + t / elbow_2)


def _passing(
    function: Callable[..., Floats], low: Floats, high: Floats, given: tuple[Floats, ...], within: float = ROUNDING
) -> Floats:
    """Where functions pass from >= 0 at low to below 0 at high: secants of the Illinois rule, every fourth step halves.

    Places count as found within a share of ``high``; those found are left out of further steps.
    """
    found, low, high, left = low.copy(), low.copy(), high.copy(), np.arange(low.size)
    at_low, at_high = function(low, *given), function(high, *given)
    for step in range(STEPS):
        open_ = high - low > within * high
        if not open_.all():
            found[left] = low
            left = left[open_]
            low, high, at_low, at_high = (each[open_] for each in (low, high, at_low, at_high))
            given = tuple(each[open_] for each in given)
        if left.size == 0:
            break
        with np.errstate(invalid="ignore", divide="ignore"):
            secant = low + (high - low) * at_low / (at_low - at_high)
        inside = (secant > low) & (secant < high) & (step % 4 < 3)
        place = np.where(inside, secant, 0.5 * (low + high))
        value = function(place, *given)
        true = value >= 0.0
        low, at_low = np.where(true, place, low), np.where(true, value, 0.5 * at_low)
        high, at_high = np.where(true, high, place), np.where(true, 0.5 * at_high, value)
    found[left] = low
    return found
