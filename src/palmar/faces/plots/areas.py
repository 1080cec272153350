"""Planar sets as bands of colour, and the legend that explains them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path
from shapely import LinearRing, MultiPolygon
from shapely.geometry.polygon import orient

from palmar.faces.plots.sheet import MARGIN, MM, Sheet
from palmar.faces.plots.style import NORMAL, SMALL_SIZE, Role

AREA_LEVEL = 1.0
LEGEND_ROW = 5.0


@dataclass(frozen=True)
class Band:
    """How one kind of set is drawn, and its line of the legend."""

    role: Role
    words: str
    level: float
    filled: bool = True
    dashes: Any = "-"

    @property
    def look(self) -> dict[str, Any]:
        """The patch's properties."""
        return {
            "facecolor": self.role.fill if self.filled else "none",
            "edgecolor": self.role.line,
            "linewidth": NORMAL,
            "linestyle": self.dashes,
        }


def draw_area(axes: Axes, area: MultiPolygon, band: Band) -> None:
    """A set in m, holes left open."""
    if not area.is_empty:
        axes.add_patch(PathPatch(area_path(area), zorder=AREA_LEVEL + 0.1 * band.level, **band.look))


def area_path(area: MultiPolygon) -> Path:
    """The set's rings in mm as one path; outlines counter-clockwise, holes clockwise."""
    rings = [ring for polygon in map(orient, area.geoms) for ring in (polygon.exterior, *polygon.interiors)]
    return Path.make_compound_path(*map(_closed, rings))


def legend(page: Sheet, at: tuple[float, float], bands: Sequence[Band], *, columns: int = 2) -> None:
    """One swatch and line of words for each band, row by row downwards from (x, y) mm on the paper."""
    width, height = page.size
    for i, band in enumerate(bands):
        x = at[0] + (i % columns) * 0.5 * (width - 2.0 * MARGIN)
        low = at[1] - (i // columns + 1) * LEGEND_ROW + 0.8
        place, size = (x / width, low / height), (7.0 / width, 3.0 / height)
        page.figure.add_artist(Rectangle(place, *size, transform=page.figure.transFigure, **band.look))
        page.write((x + 9.0, low + 1.5), band.words, size=SMALL_SIZE, upright="center")


def _closed(ring: LinearRing) -> Path:
    points = MM * np.asarray(ring.coords)
    codes = np.full(len(points), Path.LINETO, dtype=np.uint8)
    codes[0], codes[-1] = Path.MOVETO, Path.CLOSEPOLY
    return Path(points, codes)
