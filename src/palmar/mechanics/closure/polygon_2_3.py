"""The source's any-orientation test for convex polygons: section 2.3.

A polygon counts as holdable however it is turned if the smallest held disk fits inside it and the largest held disk
contains it. The test is a heuristic: it asks nothing of corners and edges. For structural closure it is sound for every
convex polygon as long as D / L <= 1 / sqrt 5; beyond, needles break it, and at D / L = 0.5 a 3 : 1 rectangle does.
With friction no such bound is known.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.optimize import linprog

SOUND_UP_TO = 1.0 / sqrt(5.0)
"""Largest D / L for which the structural test is sound for every convex polygon."""


@dataclass(frozen=True)
class CircleTest:
    """Whether the test passes, whether passing can be relied on (None: not known), and the two circles' radii (m)."""

    passed: bool
    sound: bool | None
    inscribed: float
    enclosing: float


def any_orientation(
    vertices: NDArray[np.float64], radius_min: float, radius_max: float, beta: float, *, structural: bool
) -> CircleTest:
    """The test for convex counter-clockwise ``vertices`` (N, 2) in m, held radii in m, and beta = D / L.

    A hand that holds no disk has radius_min > radius_max: nothing passes.
    """
    inside, around = inscribed_radius(vertices), float(shapely.minimum_bounding_radius(shapely.Polygon(vertices)))
    passed = radius_min <= inside and around <= radius_max
    return CircleTest(passed, beta <= SOUND_UP_TO if structural else None, inside, around)


def inscribed_radius(vertices: NDArray[np.float64]) -> float:
    """Radius (m) of the largest circle inside a convex polygon: the linear programme max r with n_i . c + r <= b_i."""
    size = float(np.ptp(vertices, axis=0).max())
    corners = (vertices - vertices.mean(axis=0)) / size
    edges = np.roll(corners, -1, axis=0) - corners
    normals = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.linalg.norm(edges, axis=1)[:, None]
    heights = np.sum(normals * corners, axis=1)
    table = np.column_stack([normals, np.ones(len(normals))])
    bounds = [(None, None), (None, None), (0.0, None)]
    found = linprog([0.0, 0.0, -1.0], A_ub=table, b_ub=heights, bounds=bounds, method="highs")
    return size * float(np.asarray(found.x)[2])
