"""Lines and shapes in panels, in mm of the real thing; nothing is cut off at a panel's edge unless asked for."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.patches import Circle, Patch, Polygon
from numpy.typing import ArrayLike, NDArray

from palmar.faces.plots.style import FINE, NORMAL, Role

Floats = NDArray[np.float64]

DASHES: Any = (0, (5, 2.5))
CENTRE_LINE: Any = (0, (8, 2, 1.5, 2))


def stroke(
    axes: Axes,
    points: ArrayLike,
    role: Role,
    *,
    level: float,
    width: float = FINE,
    dashes: Any = "-",
    round_ends: bool = False,
) -> None:
    """A line through points (N, 2) in mm."""
    ends = "round" if round_ends else "butt"
    x, y = np.asarray(points, dtype=float).T
    axes.plot(
        x, y, color=role.line, linewidth=width, linestyle=dashes, zorder=level, clip_on=False,
        solid_capstyle=ends, dash_capstyle="butt", solid_joinstyle="round",
    )  # fmt: skip


def shape(
    axes: Axes,
    outline: ArrayLike,
    role: Role,
    *,
    level: float,
    width: float = NORMAL,
    fill: float = 1.0,
    dashes: Any = "-",
) -> Patch:
    """A filled polygon (N, 2) in mm; ``fill`` is the fill's opacity."""
    return _added(axes, Polygon(np.asarray(outline, dtype=float)), role, level, width, fill, dashes)


def disc(
    axes: Axes, centre: ArrayLike, radius: float, role: Role, *, level: float, width: float = NORMAL, fill: float = 1.0,
    dashes: Any = "-",
) -> Patch:  # fmt: skip
    """A filled circle, centre (2,) and radius in mm."""
    x, y = np.asarray(centre, dtype=float)
    return _added(axes, Circle((float(x), float(y)), radius), role, level, width, fill, dashes)


def _added(axes: Axes, patch: Patch, role: Role, level: float, width: float, fill: float, dashes: Any) -> Patch:
    patch.set(
        facecolor=to_rgba(role.fill, fill), edgecolor=role.line if width else "none", linewidth=width, linestyle=dashes,
        zorder=level, clip_on=False,
    )  # fmt: skip
    axes.add_patch(patch)
    return patch
