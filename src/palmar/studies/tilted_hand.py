"""What is left of a region for certain when the wrist is tilted against the cylinder: the source's sensitivity, computed.

Tilted by a, the hand's plane cuts a cylinder of radius R in an ellipse with half axes R and R / cos a, the long one across
the line about which it is tilted; a hand of width w along the axis meets such ellipses shifted by up to (w / 2) tan a that
way. The axis keeps its direction, so the section does not turn.

The starts that are certain need no mechanics but that what is not touched stays (``regions.caging_core``): clear of all
that the fingers sweep, with the whole of the shifted ellipses, until the disk of radius R in the middle plane can no longer
pass between the fingertips. That is a small part of the region. What is left of the whole region is estimated, without a
proof: what both the disks of R and R / cos a, between which the ellipse lies, are caught from, at every shift.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, radians, tan

import numpy as np
from shapely import MultiPolygon, affinity

from palmar.geometry.planar_set import Circle, areal, inscribed_circle
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.support import SupportKind
from palmar.regions.build import build_region
from palmar.regions.caging_core import caging_core

TILTS = tuple(radians(each) for each in (0.0, 5.0, 10.0, 15.0, 20.0))
"""Angles looked at (rad)."""
CORNERS = 48
"""Of the polygon around an ellipse, a multiple of four: it then touches the ellipse at both ends of the short axis."""
FINE = 1e-2
"""Share of the radius to which the largest circle is found."""


@dataclass(frozen=True)
class Tilted:
    """What a hand tilted by ``angle`` (rad) keeps, about the line in its plane, along the palm or ahead, where it is less.

    ``certain``: area (m^2) of the starts that are; ``estimate``: area (m^2) that the region keeps, ``room``: the largest
    circle in that; None in free space, where a region takes too long.
    """

    angle: float
    certain: float
    estimate: float | None
    room: Circle | None


def tilted_hand(case: Case, width: float) -> tuple[Tilted, ...]:
    """For each of ``TILTS`` a hand of a width (m) along the cylinder; empty unless straight fingers close on a disk."""
    if (
        not isinstance(case.object, Disk)
        or case.behaviour.name is not BehaviourName.CLOSE
        or case.support.wall is not None
    ):
        return ()
    return tuple(_tilted(case, case.object, width, angle) for angle in TILTS)


def _tilted(case: Case, disk: Disk, width: float, angle: float) -> Tilted:
    section, last = tilted_section(disk.radius, width, angle), straight_motion(case.hand).last
    sections = (section, tuple((-y, x) for x, y in section))
    cores = [caging_core(case.hand, ConvexPolygon(shape="polygon", vertices=each), last, 0.0, 0.0) for each in sections]
    certain = min(each.area for each in cores)
    if case.support.kind is SupportKind.FREE:
        return Tilted(angle, certain, None, None)
    thicker = case.model_copy(update={"object": disk.model_copy(update={"radius": disk.radius / cos(angle)})})
    both = areal(build_region(case).centre & build_region(thicker).centre)
    shift = 0.5 * width * tan(angle)
    left = min((_shifted(both, *each) for each in ((shift, 0.0), (0.0, shift))), key=lambda each: each.area)
    room = None if left.is_empty else inscribed_circle(left, FINE * disk.radius)
    return Tilted(angle, certain, left.area, room)


def _shifted(region: MultiPolygon, x: float, y: float) -> MultiPolygon:
    """Places (m) that lie in the region as they are, and shifted by (x, y) either way."""
    return areal(region & affinity.translate(region, x, y) & affinity.translate(region, -x, -y))


def tilted_section(radius: float, width: float, angle: float) -> tuple[tuple[float, float], ...]:
    """Corners (m), counter-clockwise, of a polygon around all ellipses that a hand meets, long along x.

    Its largest inner disk is that of the cylinder.
    """
    shift = 0.5 * width * tan(angle)
    normals = 2.0 * pi * np.arange(CORNERS) / CORNERS
    long = radius / cos(angle)
    reach = np.hypot(long * np.cos(normals), radius * np.sin(normals)) + shift * np.abs(np.cos(normals))
    beyond, step = np.roll(reach, -1), 2.0 * pi / CORNERS
    # Each corner is where the tangents with two neighbouring normals meet.
    along = (beyond - reach * cos(step)) / np.sin(step)
    corners = reach * np.stack([np.cos(normals), np.sin(normals)]) + along * np.stack(
        [-np.sin(normals), np.cos(normals)]
    )
    return tuple((float(x), float(y)) for x, y in corners.T)
