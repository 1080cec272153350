"""A polygon and the source's test, drawn: the smallest held disk must fit inside it, the largest must fit around it.

Where the orientations at which it is really held are known, a ring shows on which sides of it the palm may be.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, pi

import shapely
from matplotlib.axes import Axes
from matplotlib.patches import Wedge
from shapely import MultiPolygon, Polygon

from palmar.faces.plots.areas import Band, legend
from palmar.faces.plots.hand import draw_object
from palmar.faces.plots.sheet import MARGIN, MM, Extent, Sheet
from palmar.faces.plots.strokes import DASHES
from palmar.faces.plots.style import FINE, HEADING_SIZE, Role
from palmar.geometry.planar_set import Circle, inscribed_circle
from palmar.models.objects import ConvexPolygon, Disk
from palmar.studies.closure import RadiusRange

LARGEST_SHOWN = 1.6
"""Largest held disk drawn, in multiples of the circle around the polygon."""
RING = (1.10, 1.22)
"""Inner and outer radius of the ring, in multiples of what it goes around."""

LEGEND = 66.0
"""Width (mm) of the legend's column."""

Intervals = Sequence[tuple[float, float]]


STRIP = 62.0
"""Height (mm) of the strip of panels."""

_FIT_INSIDE = Band(Role.SMALLEST, "smallest held disk: must fit inside", 0.0, filled=False)
_FIT_AROUND = Band(Role.LARGEST, "largest held disk: must fit around", 0.0, filled=False)
_CIRCLES = Band(Role.DIMENSION, "the polygon's inscribed and enclosing circles", 0.0, filled=False, dashes=DASHES)
_RING = Band(Role.HELD, "held with the palm on this side", 0.0)


@dataclass(frozen=True)
class CircleTest:
    """What one closure says of the polygon: radii of held disks, and whether it is held at every orientation.

    ``held_at`` are the intervals of orientation (rad) at which it is held, None where they are not known.
    """

    name: str
    radii: RadiusRange | None
    held: bool
    held_at: Intervals | None = None


def draw_circle_tests(page: Sheet, top: float, polygon: ConvexPolygon, tests: Sequence[CircleTest]) -> None:
    """A strip of panels down from ``top`` (mm on the paper), one for each closure, and the legend."""
    page.rule(top)
    page.write((MARGIN, top - 2.0), "However it is turned?", size=HEADING_SIZE, bold=True, upright="top")
    width = (page.size[0] - 2.0 * MARGIN - LEGEND) / len(tests)
    for i, test in enumerate(tests):
        left = MARGIN + i * width
        axes = page.inset(Extent(left + 2.0, top - STRIP + 14.0, left + width - 2.0, top - 8.0), _extent(polygon, test))
        _draw_test(axes, polygon, test)
        middle, verdict = (
            left + 0.5 * width,
            "✓ held at every orientation" if test.held else "✗ not at every orientation",
        )
        role = Role.HELD if test.held else Role.LOST
        page.write((middle, top - STRIP + 8.5), test.name, across="center")
        page.write((middle, top - STRIP + 4.5), verdict, across="center", role=role, bold=True)
    bands = [_FIT_INSIDE, _FIT_AROUND, _CIRCLES]
    bands += [_RING] if any(test.held_at is not None for test in tests) else []
    legend(page, (page.size[0] - MARGIN - LEGEND, top - 8.0), bands, columns=1)


def _extent(polygon: ConvexPolygon, test: CircleTest) -> Extent:
    """The polygon with all circles and the ring."""
    (x, y), radius = enclosing_circle(polygon).centre, RING[1] * _outermost(polygon, test)
    return Extent(x - radius, y - radius, x + radius, y + radius)


def _draw_test(axes: Axes, polygon: ConvexPolygon, test: CircleTest) -> None:
    """The polygon, its inscribed and enclosing circle, the limiting disks about their centres, and the ring."""
    inside, around = inner_circle(polygon), enclosing_circle(polygon)
    draw_object(axes, polygon, (0.0, 0.0), mark=False)
    for circle in (inside, around):
        draw_object(axes, Disk(radius=circle.radius), circle.centre, role=Role.DIMENSION, ghost=True, mark=False)
    if test.radii is not None:
        limits = (
            (test.radii.radius_max, around.centre, Role.LARGEST),
            (test.radii.radius_min, inside.centre, Role.SMALLEST),
        )
        for radius, centre, role in limits:
            if 0.0 < radius <= LARGEST_SHOWN * around.radius:
                draw_object(axes, Disk(radius=radius), centre, role=role, fill=0.0, mark=False)
    if test.held_at is not None:
        _draw_ring(axes, around.centre, _outermost(polygon, test), test.held_at)


def enclosing_circle(polygon: ConvexPolygon) -> Circle:
    """The smallest circle around the polygon (m)."""
    shape = Polygon(polygon.vertices)
    centre = shapely.minimum_bounding_circle(shape).centroid
    return Circle((centre.x, centre.y), float(shapely.minimum_bounding_radius(shape)))


def inner_circle(polygon: ConvexPolygon) -> Circle:
    """The largest circle inside the polygon (m)."""
    shape = Polygon(polygon.vertices)
    circle = inscribed_circle(MultiPolygon([shape]), 1e-6 * shape.length)
    assert circle is not None
    return circle


def _outermost(polygon: ConvexPolygon, test: CircleTest) -> float:
    around = enclosing_circle(polygon).radius
    largest = 0.0 if test.radii is None else test.radii.radius_max
    return max(around, largest) if largest <= LARGEST_SHOWN * around else around


def _draw_ring(axes: Axes, centre: tuple[float, float], radius: float, held_at: Intervals) -> None:
    """Where the palm is, seen from the polygon: below (-90 deg) at orientation 0, turning against the orientation."""
    middle, outer = (MM * centre[0], MM * centre[1]), MM * RING[1] * radius
    width = MM * (RING[1] - RING[0]) * radius
    rings = [(Role.GHOST, 0.0, 360.0)]
    rings += [(Role.HELD, degrees(-0.5 * pi - end), degrees(-0.5 * pi - start)) for start, end in held_at]
    for role, first, last in rings:
        wedge = Wedge(middle, outer, first, last, width=width)
        axes.add_patch(wedge).set(facecolor=role.fill, edgecolor=role.line, linewidth=FINE, zorder=1.0, clip_on=False)
