"""Disks a symmetric 4-jointed hand holds without friction: section 5.1, in closed form.

Notation: w half palm width, P proximal and Q distal link, t = P - w, R disk radius; lines, fingers that may cross, base
joints from 0 (open) to pi, links not below the palm line. A case says which links carry the disk on both sides, others
may touch too. Radii are suprema.

Where the distal link is too short to reach the disk tangentially past a proximal link that touches it, Q < t, its
tip touches; the limits on the palm are then roots T of ``tip_elevation``. Derived in docs/derivations/four_jointed.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.closure.disk_2_2 import Radii, structural_radii
from palmar.mechanics.closure.four_jointed_cradle import cradled_radius
from palmar.mechanics.closure.four_jointed_tip import tip_roots

Floats = NDArray[np.float64]
CASES = ("proximal_palm", "distal_palm", "distal_proximal", "distal_proximal_palm")
"""Fields of ``FourJointed``, named for the links that carry the disk."""


@dataclass(frozen=True)
class FourJointed:
    """Radii (m) held in each case, NaN where none is.

    In ``distal_proximal`` the proximal links carry the disk from below. Smaller disks, (0, folded], can be held with the
    proximal links above and the distal ones folded back below them, if the fingers may cross: ``folded_radius``.
    """

    proximal_palm: Radii
    distal_palm: Radii
    distal_proximal: Radii
    distal_proximal_palm: Radii

    @property
    def overall(self) -> Radii:
        """Radii held in any case: one interval."""
        cases = (self.proximal_palm, self.distal_palm, self.distal_proximal, self.distal_proximal_palm)
        low, high = cases[0].min, cases[0].max
        for each in cases[1:]:
            low, high = np.fmin(low, each.min), np.fmax(high, each.max)
        return Radii(low, high)


def four_jointed_radii(half_palm: ArrayLike, proximal: ArrayLike, distal: ArrayLike) -> FourJointed:
    """Radii held in each case of section 5.1 (m); arguments w, P, Q >= 0 in m, broadcast against each other."""
    columns = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (half_palm, proximal, distal)))
    w, p, q = (each.ravel() for each in columns)
    shape = columns[0].shape
    with np.errstate(invalid="ignore", divide="ignore"):
        roots = tip_roots(w, p, q)
        return FourJointed(
            structural_radii(*columns[:2]),
            _shaped(_distal_palm(w, p, q, roots), shape),
            _shaped(_distal_proximal(w, p, q, roots), shape),
            _shaped(_distal_proximal_palm(w, p, q, roots), shape),
        )


def _distal_palm(w: Floats, p: Floats, q: Floats, roots: Radii) -> Radii:
    """The distal link touches at the equator: its tip, or its interior with the proximal link along the palm line."""
    straight = structural_radii(w, p + q)
    tip = 0.5 * (w + q + np.sqrt(2.0 * p**2 - (w - q) ** 2))
    largest = np.select([w >= p + q, q >= w + p, q >= p - w], [straight.max, w + p, tip], roots.max)
    smallest = np.select([w >= p + q, q >= p - w], [straight.min, np.zeros_like(w)], roots.min)
    return _radii(smallest, largest)


def _distal_proximal_palm(w: Floats, p: Floats, q: Floats, roots: Radii) -> Radii:
    """Both links tangent, the distal one at distance t from the elbow; for w > P the elbow touches for both.

    The smallest is the circle in the triangle that the finger closes with the palm line.
    """
    t = p - w
    elbow = structural_radii(w, p)
    tangent = 0.5 * (p + np.sqrt(p**2 + 4.0 * w * t))
    largest = np.select([w > p, q >= t], [elbow.max, tangent], roots.max)
    triangle = np.sqrt(w * t * (q - t) / (w + q))
    smallest = np.select([w > p, q >= t], [elbow.min, triangle], roots.min)
    return _radii(smallest, largest)


def _distal_proximal(w: Floats, p: Floats, q: Floats, roots: Radii) -> Radii:
    """The proximal links lean outwards and carry the disk, the distal ones touch at the equator or above."""
    t = p - w
    tangent = 0.5 * (p + np.sqrt(p**2 + 4.0 * w * t))
    largest = np.where(q >= t, tangent, np.nan)
    short = np.flatnonzero((q < t) & (q > 0.0))
    largest[short] = cradled_radius(w[short], p[short], q[short], roots.max[short])
    return _radii(w, np.where(w >= p, np.nan, largest))


def _radii(smallest: Floats, largest: Floats) -> Radii:
    none = ~(smallest <= largest) | (largest <= 0.0)
    return Radii(np.where(none, np.nan, smallest), np.where(none, np.nan, largest))


def _shaped(radii: Radii, shape: tuple[int, ...]) -> Radii:
    return Radii(radii.min.reshape(shape), radii.max.reshape(shape))
