"""The pre-image of three closing tips: one ring of three horns, each between two curves along which a tip loses the disk."""

from __future__ import annotations

from math import acos, cos, pi, sin

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, Point, Polygon

from palmar.geometry.planar_set import EMPTY, areal, grown
from palmar.mechanics.pushing.drag import drag_table
from palmar.mechanics.pushing.pressure_cells import PRESSURE_EXPONENT
from palmar.mechanics.pushing.slider import disk_slider
from palmar.mechanics.pushing.three_tips import AXES, CAGE, WITHIN, Drift, drift, leans, ways
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.support import Pressure
from palmar.models.three_tips import ThreeTips
from palmar.regions.region import Model, Region

Floats = NDArray[np.float64]
SIDE, ARC = 160, 48
"""Points on one side of a horn, and on its end."""
ALONG = 1.5
"""What the chords' distance from the curve between points, found at one place of each, is multiplied with."""


def tips_drag(radius: float, pressure: Pressure) -> Floats:
    """The drag table (``mechanics.pushing.drag``) of a disk of ``radius`` (m) whose weight is spread like this."""
    return drag_table(disk_slider(radius, PRESSURE_EXPONENT[pressure]).surface, radius)


def tips_region(tips: ThreeTips, radius: float, friction: float, pressure: Pressure = Pressure.UNIFORM) -> Region:
    """From where the tips catch a disk of ``radius`` (m): in the end it is between them, caged or held.

    Exact for the stated model; the ring given lies inside the region by less than ``flattening``.
    """
    rho = radius + tips.tip_radius
    caging = CAGE * rho
    table = drift(tips_drag(radius, pressure) if friction > 0.0 else None, friction)
    reason = None
    if tips.open_radius <= rho:
        reason = "the open tips leave no room for the disk"
    elif tips.closed_radius >= caging:
        reason = "the tips stop before their gaps are narrower than the disk"
    if reason is not None:
        return _region(EMPTY, EMPTY, friction, 0.0, reason)
    centre, flattening = _ring(table, rho, tips.open_radius)
    whole, more = grown(centre, radius, 1e-3 * radius)
    return _region(centre, whole, friction, max(flattening, more), None)


def beside_tips(tips: ThreeTips, radius: float, friction: float, pressure: Pressure = Pressure.UNIFORM) -> MultiPolygon:
    """What borders the region at the open tips: the sector of each one's disk of radius rho within which it catches.

    A hand that already stands there without touching has the object outside of these disks, so they may be added to the
    region where it closes at once: polygons then need no room between region and tips.
    """
    rho = radius + tips.tip_radius
    table = drift(tips_drag(radius, pressure) if friction > 0.0 else None, friction)
    if tips.open_radius <= rho or tips.closed_radius >= CAGE * rho:
        return EMPTY
    lean = _end_lean(table, rho, tips.open_radius)
    pieces = []
    for axis in AXES:
        across = np.array([axis[1], -axis[0]])
        at, ahead, aside = tips.open_radius * axis, -2.0 * rho * cos(lean) * axis, 2.0 * rho * sin(lean) * across
        wedge = Polygon([at, at + ahead + aside, at + ahead - aside])
        around = Point(*at).buffer(rho / cos(pi / (4.0 * ARC)), quad_segs=ARC)
        # within the caging circle all of the tips' triangle is either in such a disk or between the tips
        pieces.append(around & (wedge if tips.open_radius > CAGE * rho else Polygon(tips.open_radius * AXES)))
    return areal(shapely.union_all(pieces))


def _end_lean(table: Drift, rho: float, opened: float) -> float:
    """|beta| (rad) up to which a disk that the open tips just touch is caught."""
    if opened <= CAGE * rho:
        return WITHIN - acos(opened / (CAGE * rho))
    return float(leans(table, ways(table, np.array([WITHIN])) + opened / rho - CAGE)[0])


def _region(
    centre: MultiPolygon, whole: MultiPolygon, friction: float, flattening: float, reason: str | None
) -> Region:
    return Region(
        model=Model.EXACT,
        closure=Closure.FRICTIONAL if friction > 0.0 else Closure.STRUCTURAL,
        guarantee=Guarantee.CLOSED_FORM,
        centre=centre,
        contact=EMPTY,
        whole=whole,
        flattening=flattening,
        reason=reason,
        notes=("caught means enclosed: no gap between two tips lets the disk out",),
    )


def _ring(table: Drift, rho: float, opened: float) -> tuple[MultiPolygon, float]:
    """The region, and how far (m) its outline may lie inside the true one."""
    caging = CAGE * rho
    if opened <= caging:
        outside = rho / cos(pi / (4.0 * ARC))
        tips = shapely.union_all([Point(*(opened * axis)).buffer(outside, quad_segs=ARC) for axis in AXES])
        return areal(Polygon(opened * AXES) - tips), outside - rho
    horn, flattening = _horn(table, rho, opened)
    right = np.stack([AXES[:, 1], -AXES[:, 0]], axis=1)
    turned = [horn[:, :1] * right[k] + horn[:, 1:] * AXES[k] for k in range(3)]
    return areal(Polygon(np.concatenate(turned))), flattening


def _horn(table: Drift, rho: float, opened: float) -> tuple[Floats, float]:
    """(y, t) of one horn, t along the tip's axis, y to its right: right side, around the open tip, left side."""
    beta_end = _end_lean(table, rho, opened)
    ends = np.linspace(beta_end, -beta_end, ARC + 1)
    outside = rho / cos(beta_end / ARC)
    cap = np.stack([outside * np.sin(ends), opened - outside * np.cos(ends)], axis=1)
    u = np.linspace(np.log(np.tan(0.5 * WITHIN)), np.log(np.tan(0.5 * beta_end)), 2 * SIDE + 1)
    side = _side(table, rho, 2.0 * np.arctan(np.exp(u)))
    points, between = side[::2], side[1::2]
    step, off = np.diff(points, axis=0), between - points[:-1]
    sag = np.abs(step[:, 0] * off[:, 1] - step[:, 1] * off[:, 0]) / np.hypot(step[:, 0], step[:, 1])
    narrower = 1.0 - ALONG * float((sag / between[:, 0]).max())
    half = np.concatenate([points[:-1], cap[: ARC // 2]]) * [narrower, 1.0]
    ring = np.concatenate([half, cap[ARC // 2 : ARC // 2 + 1], half[:0:-1] * [-1.0, 1.0]])
    return ring, max((1.0 - narrower) * rho, outside - rho)


def _side(table: Drift, rho: float, beta: Floats) -> Floats:
    """(y, t) of starts that the tip has at exactly 30 degrees when the disk is caged; touched at beta."""
    way = rho * (ways(table, beta) - ways(table, np.array([WITHIN])))
    found: Floats = np.stack([rho * np.sin(beta), CAGE * rho + way - rho * np.cos(beta)], axis=1)
    return found
