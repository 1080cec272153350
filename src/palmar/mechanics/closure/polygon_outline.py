"""A convex polygon turned to many orientations at once, seen by the two fingers.

Everything the left finger sees is what a right finger would see of the mirrored polygon, so a batch of M orientations
is held as 2 M views from the right: first the M of the polygon, then the M of its mirror image.
Elevations are angles (rad) of outward normals above the palm direction: -90 deg points at the palm, +90 deg away.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import pi
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
Bools = NDArray[np.bool_]

FULL_TURN, RIGHT_ANGLE = 2.0 * pi, 0.5 * pi


@dataclass(frozen=True)
class Views:
    """2 M views of a polygon with N corners, each from the side of a finger on the right.

    ``corners`` (2 N, 2) holds the polygon and then its mirror image, both counter-clockwise in their own frame, and
    ``normals`` (2 N,) the directions of the edges after them, ascending; those of the mirror image are raised by a full
    turn, so that one sorted search serves both. A view has the turn ``angle``, the index ``bottom`` of its lowest
    corner, the number ``edges`` of edges from there up to its highest, and the height ``low`` of the lowest one.
    """

    corners: Floats
    normals: Floats
    angle: Floats
    cosine: Floats
    sine: Floats
    mirrored: Bools
    bottom: Indices
    edges: Indices
    low: Floats

    def at(self, index: Indices | Bools) -> Views:
        """Some of the views, indexed as arrays are."""
        return replace(self, **{name: getattr(self, name)[index] for name in _PER_VIEW})

    @property
    def count(self) -> int:
        """Number N of corners."""
        return len(self.normals) // 2

    def corner(self, index: Indices) -> tuple[Floats, Floats]:
        """Place (x, height above the lowest corner) of one corner a view (m)."""
        x, y = self.corners[index, 0], self.corners[index, 1]
        return x * self.cosine - y * self.sine, x * self.sine + y * self.cosine - self.low

    def stepped(self, steps: Indices | int) -> Indices:
        """Corner that lies ``steps`` after the lowest one, counter-clockwise."""
        offset = np.where(self.mirrored, self.count, 0)
        corner: Indices = offset + (self.bottom - offset + steps) % self.count
        return corner

    def support(self, elevation: Floats) -> Indices:
        """Corner that is extreme in the direction of this elevation; of two, the lower one."""
        return _support(self.normals, self.mirrored, elevation - self.angle, "left")

    def elevation(self, edge: Indices) -> Floats:
        """Elevation in [-90, 270) deg of the normal of the edge after corner ``edge``."""
        raised: Floats = np.mod(self.normals[edge] + self.angle + RIGHT_ANGLE, FULL_TURN) - RIGHT_ANGLE
        return raised

    def first_step(self, holds: Callable[[Indices], Bools]) -> Indices:
        """Least number of steps from the lowest corner whose corner fulfils a condition that is first false, then true.

        ``holds`` gets one corner a view; the number is ``edges``, the top, where no lower corner fulfils it.
        """
        low, high = np.zeros_like(self.edges), self.edges.copy()
        for _ in range(int(self.edges.max(initial=0)).bit_length()):
            middle = (low + high) // 2
            true = holds(self.stepped(middle))
            open_ = low < high
            low, high = np.where(open_ & ~true, middle + 1, low), np.where(open_ & true, middle, high)
        return high

    def boundary(self, height: Floats, rounding: float) -> tuple[Floats, Floats]:
        """Right boundary of the polygon grown by ``rounding`` (m), at a height over its lowest corner.

        Returns x (m; -inf below the boundary, where there is nothing to touch) and the elevation of the normal (rad).
        At a corner the normal of the edge above it is given. Heights above the top are not told apart from the top.
        """
        above = self.first_step(lambda edge: self._start(edge, rounding) > height)
        start, end = self.stepped(np.maximum(above - 1, 0)), self.stepped(np.maximum(above, 1))
        elevation = self.elevation(start)
        (x0, y0), (x1, y1) = self.corner(start), self.corner(end)
        along = (height - self._start(start, rounding)) / np.where(y1 > y0, y1 - y0, np.inf)
        x = x0 + np.clip(along, 0.0, 1.0) * (x1 - x0) + rounding * np.cos(elevation)
        below = above == 0
        if rounding > 0.0:
            sine = (height - np.where(below, y0, y1)) / rounding
            on_arc = below | (along > 1.0)
            arc = np.arcsin(np.clip(sine, -1.0, 1.0))
            x = np.where(on_arc, np.where(below, x0, x1) + rounding * np.cos(arc), x)
            elevation = np.where(on_arc, arc, elevation)
            below = below & (sine < -1.0)
        return np.where(below, -np.inf, x), np.where(below, -RIGHT_ANGLE, elevation)

    def _start(self, edge: Indices, rounding: float) -> Floats:
        """Height at which an edge begins."""
        y = self.corner(edge)[1]
        return y + rounding * np.sin(self.elevation(edge)) if rounding > 0.0 else y


_PER_VIEW = ("angle", "cosine", "sine", "mirrored", "bottom", "edges", "low")


def views(vertices: ArrayLike, orientations: ArrayLike) -> Views:
    """Right and left views of a polygon, (N, 2) counter-clockwise in m, turned by each orientation (M,) in rad."""
    outline = np.asarray(vertices, dtype=np.float64)
    own, reflected = _sorted_outline(outline), _sorted_outline(outline[::-1] * np.array([-1.0, 1.0]))
    corners = np.concatenate([own[0], reflected[0]])
    normals = np.concatenate([own[1], reflected[1] + FULL_TURN])
    theta = np.asarray(orientations, dtype=np.float64)
    angle = np.concatenate([theta, -theta])
    mirrored = np.repeat([False, True], len(theta))
    bottom = _support(normals, mirrored, -RIGHT_ANGLE - angle, "right")
    edges = (_support(normals, mirrored, RIGHT_ANGLE - angle, "left") - bottom) % len(outline)
    found = Views(corners, normals, angle, np.cos(angle), np.sin(angle), mirrored, bottom, edges, np.zeros_like(angle))
    return replace(found, low=found.corner(bottom)[1])


def _sorted_outline(outline: Floats) -> tuple[Floats, Floats]:
    edges = np.roll(outline, -1, axis=0) - outline
    directions = np.mod(np.arctan2(-edges[:, 0], edges[:, 1]), FULL_TURN)
    first = int(np.argmin(directions))
    return np.roll(outline, -first, axis=0), np.roll(directions, -first)


def _support(normals: Floats, mirrored: Bools, direction: Floats, side: Literal["left", "right"]) -> Indices:
    count = len(normals) // 2
    within = np.mod(direction, FULL_TURN)
    within = np.where(within < FULL_TURN, within, 0.0)  # the remainder of a tiny negative number rounds up
    offset = np.where(mirrored, count, 0)
    place = np.searchsorted(normals, within + np.where(mirrored, FULL_TURN, 0.0), side=side)
    index: Indices = offset + (place - offset) % count
    return index
