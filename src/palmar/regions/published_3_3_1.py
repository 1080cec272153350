"""The source's pre-image of the closing motion on a table: section 3.3.1, equations 3.12 and 3.13.

While a straight finger pushes the disk, the contact runs out along it at R per radian. The construction asks that
the contact reach the fingertip no earlier than the finger needs for the rest of its sweep; its boundary is the
spiral r = R0 + R (phi - phi0) about the finger's base joint, ending at the fingertip, joined to the axis by a chord.

The source subtracts the friction angle from the sweep for the time the disk spends on the fingertip. That step is an
approximation: the structural region is sound, the frictional one is not (docs/derivations/published_region.md).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, cos, pi, sin

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, Polygon, affinity
from shapely.geometry.base import BaseGeometry

from palmar.geometry.planar_set import EMPTY, areal, grown, outline, with_mirror_image
from palmar.geometry.spiral import Spiral


@dataclass(frozen=True)
class Sweep:
    """The construction's numbers: angles in rad, ``r0`` in m; the contact region is r0 + R (phi - phi0), phi0..end."""

    theta: float
    r0: float
    phi0: float
    end: float


def sweep(half_palm: float, finger_length: float, radius: float, friction_angle: float) -> Sweep | None:
    """Numbers of the construction (lengths m, angle rad), None where the finger's end position does not exist."""
    cosine = (half_palm - radius * cos(friction_angle)) / finger_length
    if abs(cosine) > 1.0:
        return None
    theta = acos(cosine)
    reach = finger_length / radius + friction_angle + theta - pi
    r0, phi0 = (radius * reach, 0.0) if reach > 0.0 else (0.0, -reach)
    return Sweep(theta, r0, phi0, pi - theta - friction_angle)


@dataclass(frozen=True)
class PublishedSets:
    """Centre, contact and whole region (both halves, m) and the bound of their flattening error (m)."""

    centre: MultiPolygon
    contact: MultiPolygon
    whole: MultiPolygon
    flattening: float


def published_sets(
    half_palm: float, finger_length: float, radius: float, friction_angle: float, opening: float, tolerance: float
) -> PublishedSets:
    """The three regions for a hand that starts at base angle ``opening`` (rad), flattened to ``tolerance`` (m).

    The polygons lie inside the curves, which bulge outwards everywhere. Starts that overlap the palm or the open
    fingers, or lie behind them, are cut away. The whole region is the centre region grown by the radius.
    """
    numbers = sweep(half_palm, finger_length, radius, friction_angle)
    if numbers is None or numbers.end <= max(numbers.phi0, opening):
        return PublishedSets(EMPTY, EMPTY, EMPTY, 0.0)
    start = max(numbers.phi0, opening)
    along = numbers.r0 - radius * numbers.phi0
    centre_line, centre_bound = Spiral((half_palm, 0.0), along, radius, radius, start, numbers.end).flattened(tolerance)
    contact_line, contact_bound = Spiral((half_palm, 0.0), along, radius, 0.0, start, numbers.end).flattened(tolerance)
    reach = half_palm + finger_length + radius
    centre = areal(shapely.intersection(closed_by_chord(centre_line), in_front(half_palm, opening, radius, reach)))
    contact = areal(shapely.intersection(closed_by_chord(contact_line), in_front(half_palm, opening, 0.0, reach)))
    whole, grown_bound = grown(centre, radius, tolerance)
    return PublishedSets(centre, contact, whole, max(centre_bound + grown_bound, contact_bound))


def closed_by_chord(line: NDArray[np.float64]) -> MultiPolygon:
    """Both halves enclosed by the axis, the boundary curve and the horizontal chord from its end to the axis."""
    bottom = min(float(line[:, 1].min()), 0.0) - 1.0
    right = outline(np.concatenate([line, [[0.0, line[-1, 1]], [0.0, bottom], [line[0, 0], bottom]]]))
    right_half = shapely.box(0.0, bottom, line[:, 0].max() + 1.0, line[:, 1].max() + 1.0)
    return with_mirror_image(shapely.intersection(right, right_half))


def in_front(half_palm: float, opening: float, gap: float, reach: float) -> BaseGeometry:
    """What lies in front of the palm line and of both open fingers' lines, at distance ``gap`` or more."""
    far = 8.0 * reach
    tangent, normal = np.array([cos(opening), sin(opening)]), np.array([-sin(opening), cos(opening)])
    foot = np.array([half_palm, 0.0]) + gap * normal
    near = [foot - far * tangent, foot + far * tangent]
    right = Polygon([*near, near[1] + far * normal, near[0] + far * normal])
    left = affinity.scale(right, xfact=-1.0, origin=(0.0, 0.0))
    return shapely.intersection_all([right, left, shapely.box(-far, gap, far, far)])
