"""Figures 2.1 to 2.6, drawn anew: the hand's model, kinds of hold, and limits of what is held."""

from __future__ import annotations

from math import atan, cos, pi, radians, sin, tan

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray
from shapely import LineString

from palmar.faces.plots.dimensions import (
    CONE_LEVEL,
    angle_arc,
    dimension,
    force,
    friction_cone,
    label,
    note,
    radius_dimension,
)
from palmar.faces.plots.hand import FINGER_LEVEL, draw_hand, draw_object, draw_palm, finger_points
from palmar.faces.plots.lettering import angle, millimetres
from palmar.faces.plots.sheet import MM, Extent, Pad, Room, per_paper_mm, sheet
from palmar.faces.plots.strokes import DASHES, shape, stroke
from palmar.faces.plots.style import HEADING_SIZE, Role
from palmar.mechanics.closure.disk_2_2 import frictional_radii, structural_radii
from palmar.mechanics.closure.holding_pose import Pose, holding_pose
from palmar.mechanics.closure.sizing import Grip
from palmar.models.hand import Hand
from palmar.models.objects import Disk

Place = tuple[float, float]

MODEL = (
    "The palm is the segment between the two base joints. Both fingers turn at the same rate, from ψ = 0° (fully open, "
    "along the palm line) towards ψ = 180° (folded onto the palm)."
)
FORCE = (
    "With friction {friction:g} the fingertips can push anywhere inside the cones. Both cones point upwards and "
    "nothing pushes down: squeezing harder drives the disk out unless an external force holds it."
)
STRUCTURAL = (
    "The fingers touch above the disk's equator and press it onto the palm. The three contact forces balance without "
    "friction, and any external force is met by squeezing."
)
FRICTIONAL = (
    "Below the equator the fingers still hold the disk as long as the contact normals lean by less than the friction "
    "angle, here {angle}. On the palm each cone must contain a direction that does not lift the disk; off the palm two "
    "opposed forces hold it, and their common line must lie in both cones."
)
LIMITS = (
    "Finger length {finger}, palm width {palm}, friction angle {angle}. Each disk is drawn with the fingers at the "
    "angle at which they hold it."
)
FINGERTIP = (
    "Where the hand's geometry allows any small disk, the round fingertips limit it: two tips of radius h that touch "
    "each other and the palm leave room for a disk of radius R = h / 4. The fingers are cut off above."
)


def model_of_hand_and_object() -> Figure:
    """Figure 2.1: what the letters mean."""
    hand, psi, radius = Hand(palm_width=0.12, finger_links=(0.13,)), radians(58.0), 0.032
    d = hand.half_palm
    contact = np.array([d, 0.0]) + 0.085 * np.array([cos(psi), sin(psi)])
    centre = _place(contact + radius * np.array([-sin(psi), cos(psi)]))
    page = sheet(
        [[Extent(-0.14, -0.012, 0.14, 0.125)]],
        title="Figure 2.1: The planar hand and its object",
        footer=MODEL,
        room=Room(inside=Pad(4.0, 12.0, 4.0, 6.0)),
    )
    axes = page.panels[0][0]
    unit = per_paper_mm(axes) / MM
    draw_object(axes, Disk(radius=radius), centre)
    draw_hand(axes, hand, psi)
    radius_dimension(axes, centre, radius, radians(150.0), "R")
    dimension(axes, (0.0, 0.0), (d, 0.0), "D", -6.0)
    base, tip = finger_points(hand, (psi,), left=True)
    dimension(axes, _place(base), _place(tip), "L", 6.0)
    stroke(axes, [(MM * d, 0.0), (MM * (d + 24.0 * unit), 0.0)], Role.DIMENSION, level=3.0, dashes=DASHES)
    angle_arc(axes, (d, 0.0), 0.0, psi, "ψ", reach=15.0)
    force(axes, (0.0, 18.0 * unit), 0.5 * pi, length=18.0, role=Role.CENTRE)
    force(axes, (18.0 * unit, 0.0), 0.0, length=18.0, role=Role.CENTRE)
    note(axes, (2.5 * unit, 17.0 * unit), "y", role=Role.CENTRE)
    note(axes, (17.0 * unit, 3.0 * unit), "x", role=Role.CENTRE)
    label(axes, (-d, 0.0), "base joint", (-8.0, -7.0))
    label(axes, (-0.4 * d, 0.0), "palm", (-5.0, -7.0))
    label(axes, _place(contact), "contact", (9.0, -2.0))
    label(axes, _place(0.4 * base + 0.6 * tip), "finger", (9.0, 3.0))
    label(axes, _place(tip), "fingertip", (9.0, 2.0))
    return page.figure


def force_closure() -> Figure:
    """Figure 2.2: a hold that lasts only while something outside presses."""
    hand, psi, below, friction = Hand(palm_width=0.12, finger_links=(0.1,)), radians(72.0), radians(52.0), 0.3
    x, y = _place(finger_points(hand, (psi,))[-1])
    radius = x / cos(below)
    height = y + radius * sin(below)
    page = sheet(
        [[Extent(-radius, 0.0, radius, height + radius)]],
        title="Figure 2.2: Force closure: held only while an external force presses",
        footer=FORCE.format(friction=friction),
        room=Room(inside=Pad(20.0, 8.0, 20.0, 22.0), highest=130.0),
    )
    axes = page.panels[0][0]
    draw_object(axes, Disk(radius=radius), (0.0, height))
    draw_hand(axes, hand, psi)
    _cones(axes, radius, Pose(psi, height, -below, False), atan(friction))
    force(axes, (0.0, height + radius), -0.5 * pi, "external force", length=14.0)
    return page.figure


def structural_closure() -> Figure:
    """Figure 2.3: a hold without friction."""
    grip, radius = Grip(0.06, 0.11), 0.04
    pose = _pose(grip, radius)
    page = sheet(
        [[Extent(-0.075, 0.0, 0.075, 0.11)]],
        title="Figure 2.3: Structural closure: held without friction",
        footer=STRUCTURAL,
        room=Room(inside=Pad(20.0, 14.0, 20.0, 4.0), highest=110.0),
    )
    axes = page.panels[0][0]
    draw_object(axes, Disk(radius=radius), (0.0, radius))
    draw_hand(axes, _hand(grip), pose.psi)
    _level(axes, radius, radius, Role.OBJECT)
    label(axes, (-0.55 * radius, radius), "equator", (-20.0, -8.0))
    e = pose.elevation
    x, y = radius * cos(e), radius + radius * sin(e)
    force(axes, (x, y), pi + e, "finger", length=16.0)
    force(axes, (-x, y), -e, "finger", length=16.0)
    force(axes, (0.0, 0.0), 0.5 * pi, "palm", length=9.0)
    return page.figure


def frictional_closure() -> Figure:
    """Figure 2.4: two holds that need friction."""
    alpha = radians(30.0)
    grip, radii = Grip(0.06, 0.1, friction_angle=alpha), (0.078, 0.118)
    poses = [_pose(grip, radius) for radius in radii]
    extents = [Extent(-r, 0.0, r, pose.height + r) for r, pose in zip(radii, poses, strict=True)]
    page = sheet(
        [extents],
        title="Figure 2.4: Closure that relies on friction",
        footer=FRICTIONAL.format(angle=angle(alpha)),
        room=Room(inside=Pad(6.0, 8.0, 6.0, 8.0), highest=125.0),
    )
    for axes, radius, pose in zip(page.panels[0], radii, poses, strict=True):
        draw_object(axes, Disk(radius=radius), (0.0, pose.height))
        draw_hand(axes, _hand(grip), pose.psi)
        _cones(axes, radius, pose, alpha)
        e = pose.elevation
        _level(axes, radius * cos(e), pose.height + radius * sin(e), Role.FORCE)
        bottom = (axes.get_ylim()[0] + 2.0 * per_paper_mm(axes)) / MM
        note(axes, (0.0, bottom), "on the palm" if pose.on_palm else "off the palm", upright="bottom")
    return page.figure


def smallest_and_largest() -> Figure:
    """Figure 2.5: the limits of the example of section 2.2.2."""
    d, length, alpha = 1.2, 1.0, radians(35.0)
    plain, rough = structural_radii(d, length), frictional_radii(d, length, alpha)
    limits = [(float(each.min), float(each.max)) for each in (plain, rough)]
    largest = limits[1][1]
    page = sheet(
        [[Extent(-1.35, 0.0, 1.35, 2.0), Extent(-largest, 0.0, largest, 2.0 * largest)]],
        title="Figure 2.5: The smallest and the largest cylinder one hand can hold",
        footer=LIMITS.format(finger=millimetres(length), palm=millimetres(2.0 * d), angle=angle(alpha)),
        room=Room(inside=Pad(6.0, 19.0, 6.0, 9.0)),
    )
    left, right = page.panels[0]
    _limits(left, Grip(d, length), *limits[0], "structural: without friction")
    _limits(right, Grip(d, length, friction_angle=alpha), *limits[1], f"frictional: with friction {tan(alpha):.2g}")
    return page.figure


def fingertip_geometry() -> Figure:
    """Figure 2.6: the fingertip, not the hand, sets the smallest object."""
    h = 0.01
    side, top = 2.6 * h, 2.9 * h
    page = sheet(
        [[Extent(-side, 0.0, side, top)]],
        title="Figure 2.6: The fingertip sets the smallest object",
        footer=FINGERTIP,
        room=Room(inside=Pad(14.0, 9.0, 14.0, 2.0), highest=120.0),
    )
    axes = page.panels[0][0]
    draw_palm(axes, Hand(palm_width=2.0 * side, finger_links=(1.0,)))
    shown = Rectangle((-MM * side, -MM * h), 2.0 * MM * side, MM * (h + top), transform=axes.transData)
    for mirror in (-1.0, 1.0):
        finger = LineString([(mirror * h, h), (mirror * 3.2 * h, 4.6 * h)]).buffer(h, quad_segs=32)
        outline = shape(axes, MM * np.asarray(finger.exterior.coords), Role.HAND, level=FINGER_LEVEL)
        outline.set(clip_on=True, clip_path=shown)
        draw_object(axes, Disk(radius=h), (mirror * h, h), role=Role.DIMENSION, ghost=True, level=FINGER_LEVEL + 0.1)
    radius_dimension(axes, (h, h), h, radians(150.0), "h")
    draw_object(axes, Disk(radius=0.25 * h), (0.0, 0.25 * h))
    label(axes, (0.0, 0.25 * h), "R = h / 4", (0.0, -12.0))
    return page.figure


def _limits(axes: Axes, grip: Grip, smallest: float, largest: float, name: str) -> None:
    """Both limiting disks on one hand, and their radii below."""
    unit, bottom = per_paper_mm(axes) / MM, axes.get_ylim()[0] / MM
    note(axes, (0.0, bottom + 11.0 * unit), name, size=HEADING_SIZE, bold=True)
    rows = ((Role.LARGEST, "largest", largest, 6.5), (Role.SMALLEST, "smallest", smallest, 2.5))
    for role, word, radius, above in rows:
        pose = _pose(grip, radius)
        draw_object(axes, Disk(radius=radius), (0.0, pose.height), role=role)
        draw_hand(axes, _hand(grip), pose.psi)
        if grip.friction_angle and role is Role.LARGEST:
            _cones(axes, radius, pose, grip.friction_angle)
        radius_dimension(axes, (0.0, pose.height), radius, radians(60.0), role=role)
        words = f"{word}: radius {millimetres(radius)}, fingers at {angle(pose.psi)}"
        note(axes, (0.0, bottom + above * unit), words, role=role)


def _pose(grip: Grip, radius: float) -> Pose:
    pose = holding_pose(grip, radius)
    assert pose is not None
    return pose


def _cones(axes: Axes, radius: float, pose: Pose, half_angle: float) -> None:
    """Friction cones at both finger contacts."""
    e = pose.elevation
    x, y = radius * cos(e), pose.height + radius * sin(e)
    friction_cone(axes, (x, y), pi + e, half_angle, length=14.0)
    friction_cone(axes, (-x, y), -e, half_angle, length=14.0)


def _level(axes: Axes, side: float, height: float, role: Role) -> None:
    """A level dashed line across the disk."""
    ends = MM * np.array([(-side, height), (side, height)])
    stroke(axes, ends, role, level=CONE_LEVEL + 0.2, dashes=DASHES)


def _hand(grip: Grip) -> Hand:
    return Hand(palm_width=2.0 * grip.half_palm, finger_links=(grip.finger_length,))


def _place(point: NDArray[np.float64]) -> Place:
    return float(point[0]), float(point[1])
