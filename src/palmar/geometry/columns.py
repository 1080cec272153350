"""The lower boundary of a planar set, as a function of x."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

Floats = NDArray[np.float64]


def edges(shape: BaseGeometry) -> Floats:
    """All straight edges (E, 4) = x, y, x', y' of a set of polygons and lines, x rising along each."""
    parts = shapely.get_parts(shape)
    areas = shapely.get_dimensions(parts) == 2
    lines = np.concatenate([shapely.get_parts(shapely.boundary(parts[areas])), parts[~areas]])
    points, of = shapely.get_coordinates(lines, return_index=True)
    along = of[:-1] == of[1:]
    found = np.concatenate([points[:-1][along], points[1:][along]], axis=1)
    back = found[:, 0] > found[:, 2]
    found[back] = found[back][:, [2, 3, 0, 1]]
    return found


def lowest(lines: Floats, x: Floats) -> Floats:
    """The least y of ``edges`` at each x (N,); inf where there is none."""
    x0, y0, x1, y1 = (lines[:, k, None] for k in range(4))
    here = (x >= x0) & (x <= x1)
    share = np.where(x1 > x0, (x - x0) / np.where(x1 > x0, x1 - x0, 1.0), np.where(y1 < y0, 1.0, 0.0))
    heights = np.where(here, y0 + np.clip(share, 0.0, 1.0) * (y1 - y0), np.inf)
    found: Floats = heights.min(axis=0, initial=np.inf)
    return found


def spans(shape: BaseGeometry) -> list[tuple[float, float]]:
    """The intervals of x over which a set lies."""
    bounds = shapely.bounds(shapely.get_parts(shape))
    joined: list[tuple[float, float]] = []
    for begin, end in sorted((float(each[0]), float(each[2])) for each in bounds):
        if joined and begin <= joined[-1][1]:
            joined[-1] = joined[-1][0], max(end, joined[-1][1])
        else:
            joined.append((begin, end))
    return joined
