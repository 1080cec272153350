"""A straight finger about its base joint."""

from __future__ import annotations

from math import acos, asin, atan2, hypot, nan, pi

import numpy as np
from numpy.typing import ArrayLike, NDArray


def last_angle(
    half_palm: ArrayLike, finger_length: ArrayLike, half_thickness: ArrayLike, crossing: bool, limit: float
) -> NDArray[np.float64]:
    """Angle psi (rad) at which closing ends: the round tip rests on the palm, meets the other tip, or the limit."""
    d, length, h = np.broadcast_arrays(
        *(np.asarray(each, float) for each in (half_palm, finger_length, half_thickness))
    )
    last: NDArray[np.float64] = np.minimum(pi - np.arcsin(h / length), limit)
    if crossing:
        return last
    cosine = (h - d) / length
    return np.where(cosine > -1.0, np.minimum(last, np.arccos(np.clip(cosine, -1.0, 1.0))), last)


def touching_angle(half_palm: float, length: float, apart: float, x: float, y: float) -> float:
    """Angle (rad) at which the line of the right finger, opening to closing, comes within ``apart`` (m) of the point (x, y).

    With its side or its tip; NaN where it does not, or is so near at any angle.
    """
    square = (x - half_palm) ** 2 + y * y
    reach = hypot(x - half_palm, y)
    if reach <= apart or reach > length + apart:
        return nan
    bearing = atan2(y, x - half_palm)
    if square - apart * apart <= length * length:
        return bearing - asin(apart / reach)
    return bearing - acos((length * length + square - apart * apart) / (2.0 * length * reach))
