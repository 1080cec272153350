"""How high fingers may push an object on a table before it tips over instead of sliding.

While it slides, the table holds it back at its base with mu_t m g and, if it speeds up at a, inertia at its centre of mass.
A push at height z balances both, so it is m (mu_t g + a). About the leading edge, at the distance s ahead of the pressure's
centre at rest, which lies below the centre of mass, the weight m g s keeps it down; tipping begins where

    z (mu_t g + a) = g s + a z_m,

z_m being the height of the centre of mass. Taking z_m as 0 errs to the safe side. On the way there the pressure's
centre runs ahead, by mu_t z in slow motion.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import ArrayLike

from palmar.mechanics.pushing.inertia import GRAVITY


def toppling_height(edge: float, table_friction: float, acceleration: float = 0.0) -> float:
    """Greatest height (m) of a horizontal push; ``edge`` (m) to the tipping edge, ``acceleration`` (m/s^2) of the object."""
    resistance = table_friction + acceleration / GRAVITY
    return edge / resistance if resistance > 0.0 else inf


def nearest_edge(vertices: ArrayLike, centre: tuple[float, float]) -> float:
    """Least distance (m) of a point from the edges of a convex base (N, 2), counter-clockwise; negative outside of it."""
    corners = np.asarray(vertices, dtype=float)
    along = np.roll(corners, -1, axis=0) - corners
    away = np.asarray(centre) - corners
    depths = (along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]) / np.hypot(along[:, 0], along[:, 1])
    return float(depths.min())
