"""The probability that a point with a Gaussian error lies in a planar set, exactly, and how it changes with the point.

Whitened by the covariance's Cholesky factor, the error is the unit Gaussian about the origin and the set's polygons stay
polygons. In polar coordinates the radial integral is elementary, so the mass of a polygon is a sum over its edges,

    (1 / 2 pi) sum of the integral over the edge's angles of 1 - exp(-h^2 / (2 cos^2 a)) da,

h being the distance of the edge's line and a the angle from its foot. The first part adds up to the winding number; the
second is Owen's T function, T(h, tan a). Outside a set around the origin lies the sum of the second parts alone: the
probability of a miss keeps its digits however small it is. Gauss's theorem turns the gradient into
integrals of the density along the edges, which are differences of normal distribution functions. Derived in
docs/integrator.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon
from shapely.geometry.polygon import orient

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Edges:
    """Directed edges (N, 2) -> (N, 2) around a set, its inside on their left."""

    begins: Floats
    ends: Floats


@dataclass(frozen=True)
class Chance:
    """Probabilities of lying inside and outside (each to about 1e-13), and the gradient (2,) of the former (1/m)."""

    inside: float
    outside: float
    gradient: Floats


def edges_of(region: MultiPolygon) -> Edges:
    """The outline of a set; parts that share an edge are merged first, so that none is counted twice."""
    merged = shapely.union_all(list(region.geoms))
    rings = [
        np.asarray(ring.coords)
        for part in shapely.get_parts(merged)
        for ring in (orient(part).exterior, *orient(part).interiors)
    ]
    if not rings:
        return Edges(np.empty((0, 2)), np.empty((0, 2)))
    return Edges(np.concatenate([ring[:-1] for ring in rings]), np.concatenate([ring[1:] for ring in rings]))


def chance(edges: Edges, mean: Floats, factor: Floats) -> Chance:
    """The chance that mean + factor g, with g of the unit Gaussian, lies in the set.

    ``mean`` (2,) in m; ``factor`` (2, 2) in m, lower triangular with a positive diagonal: factor factor^T is the covariance.
    """
    from scipy.special import ndtr, owens_t

    inverse = np.linalg.inv(factor)
    begins, ends = (edges.begins - mean) @ inverse.T, (edges.ends - mean) @ inverse.T
    along = ends - begins
    lengths = np.hypot(along[:, 0], along[:, 1])
    begins, ends = begins[lengths > 0.0], ends[lengths > 0.0]
    direction = along[lengths > 0.0] / lengths[lengths > 0.0, None]
    height = begins[:, 0] * direction[:, 1] - begins[:, 1] * direction[:, 0]
    low, high = np.sum(begins * direction, axis=1), np.sum(ends * direction, axis=1)
    off = height != 0.0
    angles = np.arctan2(height * (high - low), height**2 + low * high)
    h, sign = np.abs(height[off]), np.sign(height[off])
    tails = sign * (owens_t(h, high[off] / h) - owens_t(h, low[off] / h))
    outside, around = float(tails.sum()), float(angles[off].sum()) / (2.0 * pi)
    density = np.exp(-0.5 * height**2) / sqrt(2.0 * pi) * (ndtr(high) - ndtr(low))
    outward = np.column_stack((direction[:, 1], -direction[:, 0]))
    gradient = -inverse.T @ (density @ outward)
    inside = float(np.clip(around - outside, 0.0, 1.0))
    # Around a place inside, the angles make one full turn, and what is lost is known without subtracting from one.
    lost = outside if around > 0.75 else 1.0 - inside
    return Chance(inside, float(np.clip(lost, 0.0, 1.0)), gradient)


def probability(region: MultiPolygon, mean: tuple[float, float], covariance: Floats) -> float:
    """The mass of a set (m) under the Gaussian of ``mean`` (m) and 2x2 ``covariance`` (m^2), positive definite."""
    factor: Floats = np.linalg.cholesky(covariance).astype(float)
    return chance(edges_of(region), np.array(mean), factor).inside
