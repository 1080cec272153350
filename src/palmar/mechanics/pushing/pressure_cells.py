"""Pressure over a disk or a convex polygon cut into cells, for the sampled limit surface.

The pressure at the fraction s of the way from the centre to the rim is proportional to s^e, e > -2: e = 0 is uniform,
a large e puts the weight on the rim (e = inf exactly), a negative e into the middle. A cell spans a range of s and of
the rim; its weight, centre of mass and covariance are exact, so the sampled surface errs by the third order of the
cell's size away from the centre of rotation. Every result is about the centre given to it.
"""

from __future__ import annotations

from math import inf, pi
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.models.support import Pressure

Floats = NDArray[np.float64]
PRESSURE_EXPONENT = {Pressure.UNIFORM: 0.0, Pressure.RIM: 1.0, Pressure.CENTRE: -1.0}
"""Exponent e of the named distributions."""
REACHED, FLATTEST, STEEPEST = 1e-13, 1e-12, 1e5
"""Distance from the wanted centre that counts as there; cells so nearly on a line, or a lean so steep, as to give up."""
Cells = tuple[Floats, Floats, Floats]
"""Points (N, 2), weights (N,) with sum 1, spreads (N,)."""


def disk_cells(radius: float, exponent: float = 0.0, rings: int = 6, around: int = 24) -> Cells:
    """Cells of a disk of ``radius`` (m) about its centre."""
    mass, mean, square = _ring_moments(exponent, rings)
    angles = (np.arange(around) + 0.5) * (2.0 * pi / around)
    half = pi / around
    shrink = np.sin(half) / half  # the centre of mass of an arc lies inside it
    directions = radius * shrink * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    points = mean[:, None, None] * directions
    weights = np.repeat(mass / around, around)
    spread2 = 0.5 * radius**2 * (square - (mean * shrink) ** 2)
    return points.reshape(-1, 2), weights, np.sqrt(np.repeat(spread2, around))


def polygon_cells(
    vertices: ArrayLike, exponent: float = 0.0, rings: int = 6, around: int = 24, centre: ArrayLike = (0.0, 0.0)
) -> Cells:
    """Cells of a convex polygon, counter-clockwise ``vertices`` (V, 2) in m, about ``centre`` inside it."""
    corners = np.asarray(vertices, dtype=float) - np.asarray(centre, dtype=float)
    edges = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(edges[:, 0], edges[:, 1])
    counts = np.maximum(1, np.rint(around * lengths / lengths.sum()).astype(int))
    which = np.repeat(np.arange(len(counts)), counts)
    index = np.concatenate([np.arange(count) for count in counts])
    middles = corners[which] + ((index + 0.5) / counts[which])[:, None] * edges[which]
    triangles = 0.5 * (corners[:, 0] * edges[:, 1] - corners[:, 1] * edges[:, 0])
    share = (triangles / counts)[which] / triangles.sum()
    mass, mean, square = _ring_moments(exponent, rings)
    points = mean[:, None, None] * middles
    far2 = np.sum(middles**2, axis=1)
    chord2 = (lengths / counts)[which] ** 2 / 12.0
    spread2 = 0.5 * (square[:, None] * (far2 + chord2) - mean[:, None] ** 2 * far2)
    return points.reshape(-1, 2), (mass[:, None] * share).ravel(), np.sqrt(spread2).ravel()


class PressureShape(NamedTuple):
    """Pressure as s^exponent times exp(tilt . z + stretch (zx^2 - zy^2) + skew 2 zx zy), with z = p / size.

    ``tilt`` leans the object, ``stretch`` and ``skew`` carry the weight to the ends of one axis, as under a plate that
    is not flat. All 0: uniform.
    """

    exponent: float = 0.0
    tilt_x: float = 0.0
    tilt_y: float = 0.0
    stretch: float = 0.0
    skew: float = 0.0


def shaped(cells: Cells, shape: PressureShape, size: float) -> Cells:
    """Cells that have the shape's exponent already, with the rest of it; about the same point as before."""
    points, weights, spreads = cells
    x, y = points.T / size
    factors = np.exp(shape.tilt_x * x + shape.tilt_y * y + shape.stretch * (x * x - y * y) + 2.0 * shape.skew * x * y)
    return points, weights * factors / (weights @ factors), spreads


def leaned(cells: Cells, offset: ArrayLike) -> Cells:
    """The pressure multiplied by exp(k . p) so that its centre is at ``offset`` (m); about the same point as before.

    The object leans. k minimises the convex log(sum w exp(k . p)) - k . offset: Newton's method, its step halved until
    that falls. Raises ValueError where the offset does not lie inside the cells' points.
    """
    points, weights, spreads = cells
    goal = np.asarray(offset, dtype=float)
    size = float(np.hypot(points[:, 0], points[:, 1]).max())
    arms, k = (points - goal) / size, np.zeros(2)
    value, tilted = _tilt(arms, weights, k)
    while True:
        miss = tilted @ arms
        spread = (arms * tilted[:, None]).T @ arms - np.outer(miss, miss)
        if float(np.hypot(*miss)) < REACHED:
            return points, tilted, spreads
        if np.linalg.det(spread) <= FLATTEST * np.trace(spread) ** 2 or float(np.hypot(*k)) > STEEPEST:
            break
        step = -np.linalg.solve(spread, miss)
        share, fall = 1.0, float(miss @ step)
        after, tried = _tilt(arms, weights, k + step)
        while after > value + 1e-4 * share * fall + 1e-15 and share > 1e-9:
            share *= 0.5
            after, tried = _tilt(arms, weights, k + share * step)
        if share <= 1e-9:
            break
        k, value, tilted = k + share * step, after, tried
    place = ", ".join(f"{each:.6g}" for each in goal)
    raise ValueError(f"no pressure on the object has its centre at ({place}) m from the middle, which is too far out")


def _tilt(arms: Floats, weights: Floats, k: Floats) -> tuple[float, Floats]:
    """log(sum w exp(k . arm)) and the normalised weights w exp(k . arm)."""
    heights = arms @ k
    top = float(heights.max())
    tilted = weights * np.exp(heights - top)
    total = float(tilted.sum())
    return top + float(np.log(total)), tilted / total


def triangle_rule(vertices: Floats) -> Cells:
    """Points exact for polynomials of degree 5 over the polygon (V, 2) under uniform pressure; spreads 0.

    The rule of Radon on the fan of triangles about the mean of the vertices.
    """
    middle = vertices.mean(axis=0)
    corners = np.stack((np.broadcast_to(middle, vertices.shape), vertices, np.roll(vertices, -1, axis=0)), axis=1)
    root = np.sqrt(15.0)
    near, far = (6.0 - root) / 21.0, (6.0 + root) / 21.0
    inner, outer = (155.0 - root) / 1200.0, (155.0 + root) / 1200.0
    bary = [[1.0 / 3.0] * 3]
    for a in (near, far):
        bary += [[1.0 - 2.0 * a, a, a], [a, 1.0 - 2.0 * a, a], [a, a, 1.0 - 2.0 * a]]
    share = np.array([0.225, inner, inner, inner, outer, outer, outer])
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = 0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
    points = np.einsum("bk,tkx->tbx", np.array(bary), corners).reshape(-1, 2)
    weights = (areas[:, None] / areas.sum() * share).ravel()
    return points, weights, np.zeros(len(weights))


def _ring_moments(exponent: float, rings: int) -> tuple[Floats, Floats, Floats]:
    """Mass, mean of s and mean of s^2 in each ring, for the density s^(exponent + 1) of s in 0..1."""
    if exponent == inf:
        return np.ones(1), np.ones(1), np.ones(1)
    edges = np.linspace(0.0, 1.0, rings + 1)
    power = exponent + 2.0
    mass = np.diff(edges**power)
    mean = np.diff(edges ** (power + 1.0)) * power / (power + 1.0) / mass
    square = np.diff(edges ** (power + 2.0)) * power / (power + 2.0) / mass
    return mass, mean, square
