"""Convex polygons given by their vertices."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Points = Sequence[tuple[float, float]]


def checked_convex(vertices: Points) -> tuple[tuple[float, float], ...]:
    """The same polygon counter-clockwise, without repeated and collinear points.

    Raises ValueError with a sentence for the user if fewer than three corners remain or the outline is not convex.
    A corner counts as straight when it stands off its neighbours' line by less than 1e-12 of the polygon's size.
    """
    corners = _without_straight(np.asarray(vertices, dtype=float))
    if len(corners) < 3:
        raise ValueError("must have at least three corners that are not on one line")
    edges = np.roll(corners, -1, axis=0) - corners
    following = np.roll(edges, -1, axis=0)
    turns = np.arctan2(_cross(edges, following), np.sum(edges * following, axis=1))
    once_round = abs(abs(turns.sum()) - 2.0 * pi) < 1e-6
    if not once_round or not (np.all(turns > 0.0) or np.all(turns < 0.0)):
        raise ValueError(f"must be the outline of a convex polygon, corner {_odd_corner(turns)} is not")
    ordered = corners if turns[0] > 0.0 else corners[::-1]
    return tuple((float(x), float(y)) for x, y in ordered)


def area_centroid(vertices: Points) -> tuple[float, float]:
    """Centroid (x, y) of the polygon's area, same unit as the vertices (counter-clockwise or clockwise)."""
    points = np.asarray(vertices, dtype=float)
    origin = points.mean(axis=0)
    here, after = points - origin, np.roll(points - origin, -1, axis=0)
    weights = _cross(here, after)
    centre = origin + ((here + after) * weights[:, None]).sum(axis=0) / (3.0 * weights.sum())
    return float(centre[0]), float(centre[1])


def turned(vertices: Points | Floats, angle: float) -> Floats:
    """Vertices (N, 2) turned by ``angle`` (rad) about the frame's origin."""
    points = np.asarray(vertices, dtype=float)
    cosine, sine = np.cos(angle), np.sin(angle)
    moved: Floats = points @ np.array([[cosine, sine], [-sine, cosine]])
    return moved


def _cross(first: Floats, second: Floats) -> Floats:
    product: Floats = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    return product


def _without_straight(points: Floats) -> Floats:
    """Drop repeated points and points on the line of their neighbours (folded-back spikes stay and fail later)."""
    size = float(np.ptp(points, axis=0).max())
    distinct = points[np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1) > 1e-12 * size]
    if len(distinct) < 3:
        few: Floats = distinct
        return few
    before, after = distinct - np.roll(distinct, 1, axis=0), np.roll(distinct, -1, axis=0) - distinct
    spans = np.linalg.norm(before + after, axis=1)
    offsets = np.abs(_cross(before, after)) / np.maximum(spans, 1e-300)
    straight = (offsets < 1e-12 * size) & (np.sum(before * after, axis=1) > 0.0)
    kept: Floats = distinct[~straight]
    return kept


def _odd_corner(turns: Floats) -> int:
    """Number (from 1) of the first corner, after dropping straight ones, that turns against the majority."""
    against = np.flatnonzero(np.sign(turns) != np.sign(np.median(np.sign(turns)) or turns.sum()))
    return int((against[0] + 1) % len(turns)) + 1 if len(against) else 1
