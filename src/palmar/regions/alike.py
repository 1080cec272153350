"""Which orientations of an object are the same to a hand: turned copies, and mirror images before a symmetric hand.

A polygon whose outline is its own image after 1/k of a turn about its centre of pressure moves, started at theta and at
theta + 2 pi / k, in the same way. If it is its own mirror image, a point at the angle a going to 2 phi - a, then a motion
from (x, y, theta) has the mirror image from (-x, y, pi - theta - 2 phi). Uniform pressure is as symmetric as the outline;
of other pressures nothing is presumed.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, sin

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.limit_surface import UNIFORM_POLYGON
from palmar.mechanics.pushing.polygon_contacts import Body

Floats = NDArray[np.float64]
ALIKE = 1e-6
"""Shapes and angles that differ by no more than this (reaches, rad) are the same: as little as the error of a stride."""


@dataclass(frozen=True)
class Different:
    """Orientations (rad) that stand for all that were asked for, and whether those are their own mirror images."""

    thetas: Floats
    mirrored: bool


def different_orientations(body: Body, centre: tuple[float, float], thetas: Floats, symmetric_hand: bool) -> Different:
    """Of ``thetas`` (rad) those at which the object differs; ``centre``: of pressure, in the object's frame (m).

    With ``mirrored``, which needs a hand with mirror symmetry, what is caught at all of them is symmetric about the y axis.
    """
    if body.surface.kind != UNIFORM_POLYGON:
        return Different(thetas, False)
    central = hypot(*centre) <= ALIKE * body.reach
    period = 2.0 * pi / (_turns(body) if central else 1)
    kept = thetas[_first_of_each(_classes(thetas, period))] if central else thetas
    mirrored = symmetric_hand and any(
        (central or _on_axis(body, centre, axis)) and _closed(_classes(kept, period), pi - kept - axis, period)
        for axis in _axes(body)
    )
    return Different(np.sort(kept), mirrored)


def _classes(thetas: Floats, period: float) -> Floats:
    """Angles up to whole periods, those just short of one as 0."""
    rest: Floats = np.mod(thetas, period)
    rest[period - rest <= ALIKE] = 0.0
    return rest


def _first_of_each(classes: Floats) -> NDArray[np.intp]:
    """Where each value stands first, in the order of the values."""
    order = np.argsort(classes, kind="stable")
    first: NDArray[np.intp] = order[np.diff(classes[order], prepend=-np.inf) > ALIKE]
    return first


def _closed(classes: Floats, images: Floats, period: float) -> bool:
    apart = np.abs(np.mod(images[:, None] - classes[None, :] + 0.5 * period, period) - 0.5 * period)
    return bool((apart.min(axis=1) <= ALIKE).all())


def _turns(body: Body) -> int:
    """The largest k for which the outline is its own image after 1/k of a turn."""
    corners = body.vertices
    for k in range(len(corners), 1, -1):
        if len(corners) % k == 0:
            c, s = cos(2.0 * pi / k), sin(2.0 * pi / k)
            turned = corners @ np.array([[c, s], [-s, c]])
            if _same(turned, np.roll(corners, -(len(corners) // k), axis=0), body.reach):
                return k
    return 1


def _axes(body: Body) -> list[float]:
    """The angles 2 phi of all mirror axes, at phi, through the centre of pressure."""
    corners, found = body.vertices, []
    for j in range(len(corners)):
        double = float(np.arctan2(corners[0, 1], corners[0, 0]) + np.arctan2(corners[j, 1], corners[j, 0]))
        if _same(_mirrored(corners, double), np.roll(corners[::-1], j + 1, axis=0), body.reach):
            found.append(double)
    return found


def _on_axis(body: Body, centre: tuple[float, float], double: float) -> bool:
    point = np.array([centre])
    return _same(_mirrored(point, double), point, body.reach)


def _mirrored(points: Floats, double: float) -> Floats:
    """Points at the angle a -> at the angle ``double`` - a."""
    c, s = cos(double), sin(double)
    image: Floats = points @ np.array([[c, s], [s, -c]])
    return image


def _same(first: Floats, second: Floats, reach: float) -> bool:
    return bool(np.abs(first - second).max() <= ALIKE * reach)
