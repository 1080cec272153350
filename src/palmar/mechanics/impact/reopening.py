"""When a loop that motors of limited torque have shut about a disk cannot be opened again.

Let t be the torque of each motor, which closes its finger until that has its rate, and U = -t (psi_r + psi_l). No motion
makes the kinetic energy of disk and fingers plus U grow: while a motor turns its finger or is turned back the one loses
what the other gains; a motor at its rate, one that brakes, and one that is at the end of its travel take energy, and so
does an impact. The centre leaves the loop only through a gap of the disk's size between the fingers. So from a sum
psi_r + psi_l on, with the kinetic energy K, the loop stays shut if

    K < t (psi_r + psi_l - w),

w being the largest sum of angles with such a gap. For two motors of one torque there is no better bound: turned both the
same way they give no resistance.
"""

from __future__ import annotations

from functools import lru_cache
from math import pi

import numpy as np

STEPS = 600
"""Of each angle, on the half turn."""


@lru_cache(maxsize=256)
def widest_gap(half_palm: float, length: float, size: float) -> float:
    """A bound from above on psi_r + psi_l (rad) at which straight fingers are 2 ``size`` (m) apart or more.

    On a grid, with what distance and sum can change within a cell.
    """
    step = pi / STEPS
    psi = step * (np.arange(STEPS) + 0.5)
    right, left = np.meshgrid(psi, psi, indexing="ij")
    apart = _distance(half_palm, length, right, left)
    # Within half a step of both angles no point of a finger moves farther than length * step / 2.
    some = (right + left)[apart >= 2.0 * size - length * step]
    return float(some.max()) + step if len(some) else 0.0


def _distance(half_palm: float, length: float, right: np.ndarray, left: np.ndarray) -> np.ndarray:
    """Of the two fingers' lines."""
    a, b = (np.stack([half_palm + length * np.cos(right), length * np.sin(right)]),
            np.stack([-half_palm - length * np.cos(left), length * np.sin(left)]))  # fmt: skip
    p, q = (np.stack([np.full(right.shape, x), np.zeros(right.shape)]) for x in (half_palm, -half_palm))
    apart = np.minimum(
        np.minimum(_to_segment(a, q, b), _to_segment(b, p, a)), np.minimum(_to_segment(p, q, b), _to_segment(q, p, a))
    )
    crossed = (_side(p, a, q) * _side(p, a, b) < 0.0) & (_side(q, b, p) * _side(q, b, a) < 0.0)
    return np.where(crossed, 0.0, apart)


def _to_segment(point: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    along = end - start
    share = np.clip(((point - start) * along).sum(axis=0) / (along**2).sum(axis=0), 0.0, 1.0)
    return np.hypot(*(point - start - share * along))


def _side(start: np.ndarray, end: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Positive to the left of the line from start to end."""
    (ux, uy), (wx, wy) = end - start, point - start
    return ux * wy - uy * wx
