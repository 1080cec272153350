"""What the panels of the closure picture show: a disk, the fingers that touch it, and the words below."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi, radians
from typing import cast

import numpy as np

from palmar.faces.plots.hand import finger_points
from palmar.faces.plots.lettering import angle, millimetres
from palmar.faces.plots.sheet import Extent
from palmar.faces.plots.style import Role
from palmar.geometry.polygon import turned
from palmar.geometry.straight_finger import last_angle
from palmar.mechanics.closure.holding_pose import Pose, holding_pose, touching_pose
from palmar.mechanics.closure.polygon_pose import squeezed_pose
from palmar.mechanics.closure.sizing import Grip
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon, Disk, Object
from palmar.studies.closure import RadiusRange

NEGLIGIBLE = 1e-9
"""A smallest radius below this share of the finger stands for none."""
VANISHING = 0.08
"""Radius drawn in its place, as a share of the half palm or the finger, whichever is shorter."""
NEARLY_CLOSED = radians(172.0)
WHOLE, SIDE, HEIGHT = 1.7, 1.25, 1.6
"""In multiples of half palm + finger: the largest radius drawn whole, and what is shown of larger disks."""


@dataclass(frozen=True)
class View:
    """Fingers at ``psi`` (rad), a disk or polygon at ``at`` (m) turned by ``theta`` (rad), and lines of words.

    ``item`` is None where there is no such disk, ``pose`` where a disk is not held, ``verdict`` where the question is
    not put; a disk that stands for ever smaller ones is not ``exact``.
    """

    role: Role
    words: tuple[str, ...]
    psi: float
    item: Object | None = None
    at: tuple[float, float] = (0.0, 0.0)
    theta: float = 0.0
    pose: Pose | None = None
    verdict: bool | None = None
    exact: bool = True

    @property
    def radius(self) -> float | None:
        """Radius of a disk (m), None for anything else."""
        return self.item.radius if isinstance(self.item, Disk) else None


def limit_views(grip: Grip, radii: RadiusRange | None) -> tuple[View, View]:
    """The smallest and the largest held disk."""
    if radii is None:
        nothing = View(Role.CAPTION, ("no disk is held",), _upright(grip))
        return nothing, nothing
    largest = _limit_view(Role.LARGEST, grip, radii.radius_max)
    if radii.radius_min > NEGLIGIBLE * grip.finger_length:
        return _limit_view(Role.SMALLEST, grip, radii.radius_min), largest
    standing_in = _limit_view(Role.SMALLEST, grip, VANISHING * min(grip.half_palm, grip.finger_length))
    return replace(standing_in, words=("no lower limit", "every smaller disk is held"), exact=False), largest


def disk_view(grip: Grip, disk: Disk, held: bool) -> View:
    """The case's disk: as it is held, else on the palm where the fingers touch it or can come no nearer."""
    pose = holding_pose(grip, disk.radius)
    shown = pose or touching_pose(grip, disk.radius, disk.radius)
    psi = _within_limits(grip, shown.psi) if shown else min(_last(grip), NEARLY_CLOSED)
    words = (f"✓ held, fingers at {angle(psi)}" if held else "✗ not held", f"radius {millimetres(disk.radius)}")
    at = (0.0, shown.height if shown else disk.radius)
    return View(Role.OBJECT, words, psi, disk, at, pose=pose if held else None, verdict=held)


def polygon_view(grip: Grip, polygon: ConvexPolygon, theta: float) -> View:
    """The case's polygon on the palm at one orientation, closed on by the fingers; not whether it is held."""
    found = squeezed_pose(polygon.vertices, theta, grip)
    psi = _within_limits(grip, found.psi) if found else min(_last(grip), NEARLY_CLOSED)
    lowest = float(turned(polygon.vertices, theta)[:, 1].min())
    words = (f"turned by {angle(theta)}", f"fingers at {angle(psi)}")
    return View(Role.OBJECT, words, psi, polygon, found.at if found else (0.0, -lowest), theta)


def view_extent(hand: Hand, view: View) -> Extent:
    """Palm, fingers and object; far parts of a very large disk are left out."""
    h, reach = hand.half_thickness, hand.half_palm + hand.finger_length
    side, top = np.abs(finger_points(hand, (view.psi,))).max(axis=0) + h
    extent = Extent(-float(side), -h, float(side), float(top))
    if view.item is None:
        return extent
    radius, (x, y) = view.radius, view.at
    if radius is None:
        corners = turned(cast(ConvexPolygon, view.item).vertices, view.theta) + view.at
        return extent.joined(Extent(*map(float, (*corners.min(axis=0), *corners.max(axis=0)))))
    disk = Extent(x - radius, y - radius, x + radius, y + radius)
    if radius > WHOLE * reach:
        disk = disk.within(Extent(-SIDE * reach, -h, SIDE * reach, HEIGHT * reach))
    return extent.joined(disk)


def _limit_view(role: Role, grip: Grip, radius: float) -> View:
    pose = holding_pose(grip, radius)
    part = ", drawn in part" if radius > WHOLE * (grip.half_palm + grip.finger_length) else ""
    psi, height = (pose.psi, pose.height) if pose else (_upright(grip), radius)
    words = (f"radius {millimetres(radius)}", f"fingers at {angle(psi)}{part}" if pose else "")
    return View(role, words, psi, Disk(radius=radius), (0.0, height), pose=pose)


def _upright(grip: Grip) -> float:
    return _within_limits(grip, 0.5 * pi)


def _within_limits(grip: Grip, psi: float) -> float:
    return min(max(psi, grip.psi_limits[0]), _last(grip))


def _last(grip: Grip) -> float:
    hand = grip.half_palm, grip.finger_length, grip.half_thickness
    return float(last_angle(*hand, grip.crossing, grip.psi_limits[1]))
