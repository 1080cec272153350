"""Where a polygon stands when the two fingers of a 2-jointed hand have closed on it."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, isfinite, sin

import numpy as np
from numpy.typing import ArrayLike

from palmar.mechanics.closure.polygon_squeeze import bout, squeeze, touch
from palmar.mechanics.closure.sizing import Grip


@dataclass(frozen=True)
class PolygonPose:
    """Fingers at ``psi`` (rad) touching the polygon whose frame's origin is at ``at`` (m)."""

    psi: float
    at: tuple[float, float]


def squeezed_pose(vertices: ArrayLike, orientation: float, grip: Grip, lift: float = 0.0) -> PolygonPose | None:
    """The polygon (N, 2) in m, turned by ``orientation`` (rad), between the closed fingers, None if they pass it by.

    Its lowest corner is ``lift`` (m) above the palm. Sideways it is where both fingers touch it at the same angle.
    Joint limits and the other finger are left out of account.
    """
    before = bout(vertices, [orientation], grip.half_palm, grip.finger_length, grip.half_thickness)
    height = np.array([lift])
    psi = squeeze(before, height)
    if not isfinite(psi[0]):
        return None
    shift = float(touch(before, psi, height).terms[0, 0])
    outline = np.asarray(vertices, dtype=float)
    lowest = float((outline @ np.array([sin(orientation), cos(orientation)])).min())
    return PolygonPose(float(psi[0]), (shift, lift - lowest))
