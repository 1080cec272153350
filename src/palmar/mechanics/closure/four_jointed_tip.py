"""Short distal links, Q < t = P - w: disks on the palm that the proximal links touch tangentially and the tips reach.

The elbow is at distance sqrt(R^2 + t^2) from the centre, so the tip reaches the disk if R >= R0 = (t^2 - Q^2)/(2Q). Its
elevation at contact rises steeply from R0, has one maximum and falls; disks at which it is not negative are held.
"""

from __future__ import annotations

from math import atan2, hypot, nan, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.closure.disk_2_2 import Radii
from palmar.mechanics.closure.each_hand import of_each_hand

Floats = NDArray[np.float64]
STEPS = 120
ROUNDING, ROUGHLY = 2.0**-51, 1e-9
MARGIN, SHORTFALL, SLOPE = 0, 1, 2


def tip_roots(w: Floats, p: Floats, q: Floats, alpha: Floats | float = 0.0) -> Radii:
    """Smallest and largest radius (m) with a contact at -alpha or above, for flat arrays; NaN where none or Q >= t."""
    low, high = np.full_like(w, nan), np.full_like(w, nan)
    some = np.flatnonzero((q < p - w) & (q > 0.0))
    hands = w[some], p[some], q[some], np.broadcast_to(alpha, w.shape)[some]
    low[some] = of_each_hand(_smallest, _CALLED, *hands)
    high[some] = of_each_hand(_largest, _CALLED, *hands)
    return Radii(low, high)


def _largest(w: float, p: float, q: float, alpha: float) -> float:
    """Largest radius (m) of one hand, NaN where there is none."""
    top = _highest(w, p, q, alpha)
    return _passing(MARGIN, top, _beyond(w, p, q, alpha), w, p, q, alpha, ROUNDING) if top > 0.0 else nan


def _smallest(w: float, p: float, q: float, alpha: float) -> float:
    """Smallest radius (m) of one hand, NaN where there is none."""
    top, first = _highest(w, p, q, alpha), _first(w, p, q)
    if not top > 0.0 or _value(MARGIN, first, w, p, q, alpha) >= 0.0:
        return first if top > 0.0 else nan
    return _passing(SHORTFALL, first, top, w, p, q, alpha, ROUNDING)


def _highest(w: float, p: float, q: float, alpha: float) -> float:
    """Radius (m) at which the contact is highest, NaN where that is below -alpha."""
    first, last = _first(w, p, q), _beyond(w, p, q, alpha)
    top = _passing(SLOPE, first, max(first, last), w, p, q, alpha, ROUGHLY)
    return top if first < last and _value(MARGIN, top, w, p, q, alpha) >= 0.0 else nan


def _first(w: float, p: float, q: float) -> float:
    """R0, from which on the tip reaches the disk."""
    return (p - w - q) * (p - w + q) / (2.0 * q)


def _beyond(w: float, p: float, q: float, alpha: float) -> float:
    """A radius that no hand of this length holds."""
    return 2.0 * (w + p + q) / (1.0 - sin(alpha))


def _value(which: int, radius: float, w: float, p: float, q: float, alpha: float) -> float:
    """What is searched for where it passes zero: the margin above -alpha, what it lacks, or the elevation's slope."""
    if which == SLOPE:
        return _slope(radius, w, p, q)
    margin = _tip_elevation(radius, w, p, q) + alpha
    return margin if which == MARGIN else -margin


def _tip_elevation(radius: float, w: float, p: float, q: float) -> float:
    """Elevation (rad) of the tip's contact on a disk of ``radius`` (m) on the palm, the proximal link tangent."""
    t = p - w
    return -0.5 * pi + 2.0 * atan2(w, radius) + atan2(t, radius) + _tip_angle(radius, t, q)


def _tip_angle(radius: float, tangent: float, q: float) -> float:
    """Angle (rad) at the disk's centre between elbow and tip; ``tangent`` is the elbow's distance to the contact.

    From the three sides of the triangle, by half the angle, which keeps its digits where the tip points at the centre.
    """
    elbow = hypot(radius, tangent)
    low = (q + radius - elbow) * (q - radius + elbow)
    high = (radius + elbow - q) * (radius + elbow + q)
    return 2.0 * atan2(sqrt(max(low, 0.0)), sqrt(max(high, 0.0)))


def _slope(radius: float, w: float, p: float, q: float) -> float:
    """Sign of the elevation's derivative by R: the derivative times a positive factor."""
    t = p - w
    elbow_2 = radius**2 + t**2
    excess = t**2 - q**2
    under = 4.0 * radius**2 * elbow_2 - (2.0 * radius**2 + excess) ** 2
    turning = (excess * (2.0 * radius**2 + t**2) - 2.0 * radius**2 * t**2) / (radius * elbow_2)
    return turning - sqrt(max(under, 0.0)) * (2.0 * w / (w**2 + radius**2) + t / elbow_2)


def _passing(
    which: int, low: float, high: float, w: float, p: float, q: float, alpha: float, within: float
) -> float:  # fmt: skip
    """Where a value passes from >= 0 at low to below 0 at high: secants of the Illinois rule, every fourth step halves.

    The place counts as found within a share of ``high``.
    """
    at_low, at_high = _value(which, low, w, p, q, alpha), _value(which, high, w, p, q, alpha)
    for step in range(STEPS):
        if not high - low > within * high:
            break
        fall = at_low - at_high
        secant = low + (high - low) * at_low / fall if fall != 0.0 else high
        place = secant if low < secant < high and step % 4 < 3 else 0.5 * (low + high)
        value = _value(which, place, w, p, q, alpha)
        if value >= 0.0:
            low, at_low, at_high = place, value, 0.5 * at_high
        else:
            high, at_high, at_low = place, value, 0.5 * at_low
    return low


_CALLED = (_highest, _first, _beyond, _value, _tip_elevation, _tip_angle, _slope, _passing)
"""What the functions of one hand call."""
