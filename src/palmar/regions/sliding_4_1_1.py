"""The capture region of a free disk that stays on the finger and slides along it (section 4.1.1), which the source leaves.

A disk at rest that a finger picks up at X while it is at the angle phi, and does not bounce off (e = 0), is at
r = X cosh tau + R sinh tau when the finger has turned by tau (equation 4.1 with r' = R w at first). Caught is, to be on the
safe side, what is still on the finger when the tips stand 2 R apart, at psi_c = arccos(-(D - R) / L):

    X(phi) = (L - R sinh tau) / cosh tau,   tau = psi_c - phi.

What runs off the tip just before may be caught too. The source discourages such a motion for its exponential growth; the
region is nevertheless larger than that of elastic impacts, if only contacts are inelastic.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from shapely import MultiPolygon, Polygon, affinity, box

from palmar.geometry.planar_set import EMPTY, areal

Floats = NDArray[np.float64]
POINTS = 400


def shut_angle(half_palm: float, length: float, radius: float) -> float:
    """psi_c (rad): the tips stand a disk apart; NaN for hands whose tips never do."""
    cosine = -(half_palm - radius) / length
    return float(np.arccos(cosine)) if abs(cosine) <= 1.0 else float("nan")


def sliding_reach(half_palm: float, length: float, radius: float, angle: ArrayLike) -> Floats:
    """X (m) at the angles of first contact (rad): contacts nearer to the joint than that are caught."""
    tau = shut_angle(half_palm, length, radius) - np.asarray(angle, dtype=float)
    found: Floats = (length - radius * np.sinh(tau)) / np.cosh(tau)
    return found


def sliding_centre(half_palm: float, length: float, radius: float) -> MultiPolygon:
    """Centres (m) at rest before the open hand that are caught so, both halves; its corners lie on the curve."""
    last = shut_angle(half_palm, length, radius)
    if not np.isfinite(last):
        return EMPTY
    angles = np.linspace(0.0, last, POINTS)
    reach = sliding_reach(half_palm, length, radius, angles)
    angles, reach = angles[reach > 0.0], reach[reach > 0.0]
    if len(angles) < 2:
        return EMPTY
    along, normal = np.stack([np.cos(angles), np.sin(angles)]), np.stack([-np.sin(angles), np.cos(angles)])
    line = (reach * along + radius * normal).T + np.array([half_palm, 0.0])
    before = line[line[:, 0] > 0.0]
    ring = [(0.0, radius), (line[0, 0], radius), *map(tuple, before), (0.0, float(before[-1, 1]))]
    clear = box(0.0, radius, half_palm + length, half_palm + length)
    half = areal(Polygon(ring).buffer(0.0) & clear)
    return areal(half | affinity.scale(half, xfact=-1.0, origin=(0.0, 0.0)))
