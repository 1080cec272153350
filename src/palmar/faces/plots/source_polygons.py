"""Figures 2.7 and 2.8, drawn anew: convex polygons that a hand holds at every orientation, or at some."""

from __future__ import annotations

from math import pi, radians

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from palmar.faces.plots.circle_test import enclosing_circle
from palmar.faces.plots.dimensions import force, note
from palmar.faces.plots.hand import draw_hand, draw_object, finger_points
from palmar.faces.plots.lettering import angle, millimetres
from palmar.faces.plots.sheet import MM, Extent, Pad, Room, per_paper_mm, sheet
from palmar.faces.plots.style import SMALL_SIZE, Role
from palmar.mechanics.closure.disk_2_2 import structural_radii
from palmar.mechanics.closure.polygon_pose import PolygonPose, squeezed_pose
from palmar.mechanics.closure.polygon_squeeze import bout, squeeze
from palmar.mechanics.closure.sizing import Grip
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon, Disk

HAND = Hand(palm_width=0.12, finger_links=(0.15,))
GRIP = Grip(HAND.half_palm, HAND.finger_length)
SEEN = Extent(-0.066, 0.0, 0.066, 0.155)
LIFT = 0.02
"""How high the bar that is pushed out is drawn."""
ROOM = Room(Pad(2.0, 14.0, 2.0, 4.0), highest=130.0)


EVERY = (
    "The largest disk this hand holds without friction, radius {largest}, fits around the polygon, and the smallest, a "
    "point, fits inside: so the polygon is held however it is turned, its orientation taken to stay. The test is safe "
    "where half the palm is at most 0.447 times the finger's length, here 0.4."
)
PARTICULAR = (
    "The bar, {width} by {height}, sticks out of the largest disk this hand holds without friction, radius {largest}. "
    "Upright, and turned from it by up to {most}, the fingers still come down on it and press it onto the palm; lying "
    "across, it covers the base joints and the fingers push it out. Its orientation is taken to stay."
)


def any_orientation() -> Figure:
    """Figure 2.7: a polygon inside the largest held disk."""
    corners = ((-0.038, -0.034), (0.02, -0.05), (0.052, -0.002), (0.012, 0.049), (-0.035, 0.036))
    return _page(
        "Figure 2.7: A polygon that is held at every orientation",
        ConvexPolygon(shape="polygon", vertices=corners),
        [0.0, radians(75.0), radians(200.0)],
        EVERY.format(largest=millimetres(_largest())),
    )


def particular_orientations() -> Figure:
    """Figure 2.8: a polygon larger than the largest held disk."""
    a, b = 0.035, 0.07
    bar = ConvexPolygon(shape="polygon", vertices=((-a, -b), (a, -b), (a, b), (-a, b)))
    turns = np.linspace(0.0, 0.5 * pi, 901)
    psi = squeeze(bout(bar.vertices, turns, GRIP.half_palm, GRIP.finger_length, 0.0), np.zeros_like(turns))
    most = angle(float(turns[psi >= 0.5 * pi].max()))
    sizes = {"width": millimetres(2.0 * a), "height": millimetres(2.0 * b), "largest": millimetres(_largest())}
    return _page(
        "Figure 2.8: A polygon that is held at particular orientations only",
        bar,
        [0.0, radians(-20.0), 0.5 * pi],
        PARTICULAR.format(most=most, **sizes),
    )


def _page(title: str, polygon: ConvexPolygon, turns: list[float], footer: str) -> Figure:
    """The circle test, then the hand closed on the polygon at each orientation."""
    poses = [_pose(polygon, turn) for turn in turns]
    sides = [float(np.abs(finger_points(HAND, (pose.psi,))[:, 0]).max()) for pose in poses]
    around = max(_largest(), enclosing_circle(polygon).radius)
    extents = [Extent(-around, 0.0, around, SEEN.top)]
    extents += [Extent(min(SEEN.left, -side), 0.0, max(SEEN.right, side), SEEN.top) for side in sides]
    page = sheet([extents], title=title, footer=footer, room=ROOM)
    test, *held = page.panels[0]
    _circle_test(test, polygon)
    for axes, turn, pose in zip(held, turns, poses, strict=True):
        _closed_on(axes, polygon, turn, pose)
    return page.figure


def _pose(polygon: ConvexPolygon, turn: float) -> PolygonPose:
    """On the palm where the fingers press it down, else on its way out."""
    pose = squeezed_pose(polygon.vertices, turn, GRIP)
    if pose is None or pose.psi < 0.5 * pi:
        pose = squeezed_pose(polygon.vertices, turn, GRIP, LIFT)
    assert pose is not None
    return pose


def _largest() -> float:
    return float(structural_radii(GRIP.half_palm, GRIP.finger_length).max)


def _circle_test(axes: Axes, polygon: ConvexPolygon) -> None:
    """The largest held disk about the centre of the smallest circle around the polygon."""
    around, largest = enclosing_circle(polygon), _largest()
    middle = (0.0, 0.5 * (SEEN.bottom + SEEN.top))
    at = (middle[0] - around.centre[0], middle[1] - around.centre[1])
    draw_object(axes, Disk(radius=largest), middle, role=Role.LARGEST, fill=0.35, mark=False)
    draw_object(axes, polygon, at, mark=False)
    fits = around.radius <= largest
    _below(axes, "inside the largest disk" if fits else "sticks out", Role.HELD if fits else Role.LOST)


def _closed_on(axes: Axes, polygon: ConvexPolygon, turn: float, pose: PolygonPose) -> None:
    draw_object(axes, polygon, pose.at, turn, mark=False)
    draw_hand(axes, HAND, pose.psi)
    held = pose.psi >= 0.5 * pi
    if not held:
        force(axes, (0.0, 0.13), 0.5 * pi, length=12.0, role=Role.LOST)
    words = f"✓ held at {angle(pose.psi)}" if held else "✗ pushed out"
    _below(axes, words, Role.HELD if held else Role.LOST)


def _below(axes: Axes, words: str, role: Role) -> None:
    unit = per_paper_mm(axes) / MM
    note(axes, (0.0, axes.get_ylim()[0] / MM + 5.0 * unit), words, role=role, size=SMALL_SIZE, bold=True)
