"""A straight finger about its base joint."""

from __future__ import annotations

from math import pi

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
