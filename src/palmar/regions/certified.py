"""The pre-image of any closing motion for a disk without friction, certified: nothing is unproven between the starts.

Cells of a quadtree, each with one start that is followed and a ball about it that covers the cell: all starts in the
cell are caught, or none is, or it is halved. What is caught for certain is the inner side, that and the cells left open
the outer side. Mechanics and proof: ``certified_start``, docs/derivations/certified_region.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon
from shapely.geometry.base import BaseGeometry

from palmar.geometry.planar_set import EMPTY, areal, grown, with_mirror_image
from palmar.mechanics.pushing.certified_start import CAUGHT, LOST, certify_all
from palmar.mechanics.pushing.enclosure import closed_from
from palmar.mechanics.pushing.hand_pose import LINK_WIDTH, MOVING, HandMotion, place_links
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.regions.region import Model, Region

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
SHARE = 0.01
"""Default area of the band, over that of the inner side."""
COARSE, MOST_LEVELS, MOST_STARTS = 8, 14, 60_000
"""Cells across the search box in the first pass; how often they may be halved; starts that may be followed."""
SLIVER = 1.0 / 64.0
"""In disk radii: cells so fine are not halved if none has been caught so far."""
ASIDE = 1e-9
"""A start that is moved to where it is valid keeps so far clear, in finger lengths."""
PUSHES = 6
ARC = 64
"""Points on a quarter of the clearance about a link's end."""


@dataclass(frozen=True)
class CertifiedSets:
    """Inner and outer side (m); width (m) of the finest cells; number of starts followed."""

    inner: MultiPolygon
    outer: MultiPolygon
    spacing: float
    starts: int

    def __iter__(self) -> Iterator[MultiPolygon]:
        """Inner and outer side, to be unpacked."""
        return iter((self.inner, self.outer))

    @property
    def share(self) -> float:
        """Area of the band over that of the inner side."""
        inner = float(self.inner.area)
        return (float(self.outer.area) - inner) / inner if inner > 0.0 else np.inf


def certified_sets(
    motion: HandMotion, radius: float, tolerance: float | None = None, share: float = SHARE, threads: int | None = None
) -> CertifiedSets:
    """Inner and outer side of the centres from which ``motion`` catches a disk of ``radius`` (m) without friction.

    Cells are halved until the band between both sides measures at most ``share`` of the inner area or, if a
    ``tolerance`` (m) is given, until no open cell is wider; in any case not beyond ``MOST_STARTS``, nor beyond cells of
    ``SLIVER`` where nothing is caught.
    """
    rows = np.zeros((2 * len(motion.links) + 1, LINK_WIDTH))
    place_links(motion, motion.first, MOVING, MOVING, rows)
    blocked = _blocked(rows, radius, inside=True)
    closed = closed_from(motion, radius)
    cells, width = _first_cells(motion, radius)
    caught: list[Floats] = []
    starts, area = 0, 0.0
    for _ in range(MOST_LEVELS):
        cells = cells[~shapely.contains_properly(blocked, _boxes(cells, width))]
        balls, told = _balls(cells, width, rows, radius, ASIDE * float(motion.links.sum()))
        codes = np.zeros(len(cells), np.int8)
        codes[told] = certify_all(motion, radius, closed, balls[told], threads)
        starts += int(told.sum())
        caught.append(np.column_stack([cells[codes == CAUGHT], np.full((codes == CAUGHT).sum(), width)]))
        area += width * width * float((codes == CAUGHT).sum())
        cells = cells[(codes != CAUGHT) & (codes != LOST)]
        fine = width <= tolerance if tolerance else len(cells) * width * width <= share * area
        fine = fine or (area == 0.0 and width <= SLIVER * radius)
        if fine or len(cells) == 0 or starts + 4 * len(cells) > MOST_STARTS:
            break
        width *= 0.5
        cells = np.concatenate([cells + width * np.array([i, j]) for i in (0, 1) for j in (0, 1)])
    held = np.concatenate(caught)
    return _sides(motion, rows, radius, held, np.column_stack([cells, np.full(len(cells), width)]), width, starts)


def certified_region(
    motion: HandMotion, radius: float, tolerance: float | None = None, share: float = SHARE, threads: int | None = None
) -> Region:
    """``certified_sets`` as a region: the centre region is the inner side."""
    sets = certified_sets(motion, radius, tolerance, share, threads)
    whole, flattening = (EMPTY, 0.0) if sets.inner.is_empty else grown(sets.inner, radius, 1e-3 * radius)
    return Region(
        model=Model.EXACT,
        closure=Closure.STRUCTURAL,
        guarantee=Guarantee.CERTIFIED,
        centre=sets.inner,
        contact=EMPTY,
        whole=whole,
        flattening=flattening,
        reason="no start is certified to be caught" if sets.inner.is_empty else None,
        notes=(f"{sets.starts} starts followed, cells of {1e3 * sets.spacing:.2g} mm at the boundary",),
        outer=sets.outer,
        spacing=sets.spacing,
    )


def _first_cells(motion: HandMotion, radius: float) -> tuple[Floats, float]:
    """Lower left corners (N, 2) and width of cells that cover all that the hand can touch; the right half by symmetry."""
    way = (motion.last - motion.first) * np.array([motion.vx, motion.vy])
    reach = motion.half_palm + float(motion.links.sum()) + radius + motion.half_thickness
    low, high = np.minimum(way, 0.0) - reach, np.maximum(way, 0.0) + reach
    if motion.vx == 0.0:
        low[0] = 0.0
    width = float((high - low).max()) / COARSE
    across, up = np.ceil((high - low) / width - 1e-9).astype(int)
    grid = np.stack(np.meshgrid(np.arange(across), np.arange(up)), axis=-1).reshape(-1, 2)
    return low + width * grid, width


def _balls(cells: Floats, width: float, rows: Floats, radius: float, aside: float) -> tuple[Floats, Bools]:
    """A valid start for each cell with the size of the ball about it that covers the cell; whether one was found."""
    centres = cells + 0.5 * width
    places = centres.copy()
    for _ in range(PUSHES):
        for row in rows:
            gap, normal = _clearance(places, row, radius)
            short = np.maximum(aside - gap, 0.0)
            places += np.where(short > 0.0, short, 0.0)[:, None] * normal
    valid = np.min([_clearance(places, row, radius)[0] for row in rows], axis=0) >= 0.0
    size = np.max([np.hypot(*(cells + width * np.array(at) - places).T) for at in np.ndindex(2, 2)], axis=0)
    return np.column_stack([places, size * (1.0 + 1e-12)]), valid & (size <= 2.0 * width)


def _clearance(places: Floats, row: Floats, radius: float) -> tuple[Floats, Floats]:
    """Gap to a link (N,) and normal from its nearest point (N, 2)."""
    begin, step = row[:2], row[2:4] - row[:2]
    part = np.clip((places - begin) @ step / (step @ step), 0.0, 1.0)
    away = places - begin - part[:, None] * step
    distance = np.hypot(away[:, 0], away[:, 1])
    up = np.array([-step[1], step[0]]) / np.hypot(*step)
    normal = np.where(distance[:, None] > 0.0, away / np.where(distance > 0.0, distance, 1.0)[:, None], up)
    return distance - radius - row[7], normal


def _blocked(rows: Floats, radius: float, inside: bool) -> BaseGeometry:
    """Centres of disks that overlap the hand, flattened to the inside or to the outside."""
    more = 1.0 if inside else 1.0 / np.cos(np.pi / (4.0 * ARC))
    links = [shapely.LineString([row[:2], row[2:4]]).buffer((radius + row[7]) * more, quad_segs=ARC) for row in rows]
    return shapely.union_all(links)


def _boxes(cells: Floats, width: float | Floats) -> NDArray[np.object_]:
    boxes: NDArray[np.object_] = shapely.box(cells[:, 0], cells[:, 1], cells[:, 0] + width, cells[:, 1] + width)
    return boxes


def _sides(
    motion: HandMotion, rows: Floats, radius: float, held: Floats, left_open: Floats, width: float, starts: int
) -> CertifiedSets:
    """Cells -> inner and outer side, valid starts only, both halves."""
    inner = shapely.union_all(_boxes(held[:, :2], held[:, 2])) - _blocked(rows, radius, inside=False)
    both = np.concatenate([held, left_open])
    outer = shapely.union_all(_boxes(both[:, :2], both[:, 2])) - _blocked(rows, radius, inside=True)
    if motion.vx == 0.0:
        return CertifiedSets(with_mirror_image(inner), with_mirror_image(outer), width, starts)
    return CertifiedSets(areal(inner), areal(outer), width, starts)
