"""Figures 3.2 and 3.3, drawn anew: the pre-image of closing on a table, and the coordinates of its boundary."""

from __future__ import annotations

from math import radians, tan

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from palmar.faces.plots.areas import LEGEND_ROW, Band, draw_area, legend
from palmar.faces.plots.dimensions import angle_arc, dimension, label, note, radius_dimension
from palmar.faces.plots.hand import PALM_LEVEL, draw_finger, draw_hand, draw_object
from palmar.faces.plots.lettering import NO_BREAK, angle, millimetres
from palmar.faces.plots.sheet import MARGIN, MM, Extent, Pad, Room, per_paper_mm, sheet
from palmar.faces.plots.strokes import DASHES, shape, stroke
from palmar.faces.plots.style import HEAVY, NORMAL, Role
from palmar.geometry.spiral import Spiral
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.contact import Contact
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.regions.build import published_region
from palmar.regions.published_3_3_1 import Sweep, sweep

HAND, RADIUS, FRICTION_ANGLE = Hand(palm_width=2.0, finger_links=(2.0,)), 0.5, radians(35.0)
"""Section 3.3.2; one unit of the source is one metre."""
EXAMPLE = Case(hand=HAND, object=Disk(radius=RADIUS), contact=Contact(friction=tan(FRICTION_ANGLE)))

BANDS = {
    Closure.FRICTIONAL: Band(Role.LARGEST, "with friction: all of the disk starts inside", 0.0, dashes=DASHES),
    Closure.STRUCTURAL: Band(Role.CENTRE, "without friction: all of the disk starts inside", 1.0),
}
PRE_IMAGE = (
    "Fingers {finger}, palm {palm}, disk radius {radius}, friction angle {angle}. The source's construction; with "
    "friction it promises some starts that are lost."
)
SPIRAL = (
    "The contact runs out along the finger by R for each radian that the finger turns, so the boundary is the spiral "
    f"{'r = R₀ + R (φ − φ₀)'.replace(' ', NO_BREAK)}. Here R₀ = {{r0}}, φ₀ = {{phi0}}, R = {{radius}}; the spiral ends "
    "at φ = {end}, where r is the finger's length, {finger}."
)


def pre_image() -> Figure:
    """Figure 3.2: where the whole disk must start, without and with friction."""
    regions = {closure: published_region(EXAMPLE, closure) for closure in BANDS}
    d, length = HAND.half_palm, HAND.finger_length
    words = {"finger": length, "palm": HAND.palm_width, "radius": RADIUS}
    named = {name: millimetres(each) for name, each in words.items()}
    page = sheet(
        [[Extent(-d - length, 0.0, d + length, float(regions[Closure.FRICTIONAL].whole.bounds[3]))]],
        title="Figure 3.2: Where a disk may start on a table for closing to catch it",
        footer=PRE_IMAGE.format(angle=angle(FRICTION_ANGLE), **named),
        room=Room(Pad(4.0, 11.0, 4.0, 4.0), sides=Pad(bottom=LEGEND_ROW + 2.0)),
    )
    axes = page.panels[0][0]
    for closure, band in BANDS.items():
        draw_area(axes, regions[closure].whole, band)
    start = (-1.35, 0.95)
    draw_object(axes, EXAMPLE.object, start, fill=0.8)
    label(axes, start, "a disk that is caught", (22.0, 4.0))
    draw_hand(axes, HAND, 0.0)
    dimension(axes, (-d, 0.0), (d, 0.0), named["palm"], -5.0)
    dimension(axes, (d, 0.0), (d + length, 0.0), named["finger"], -5.0)
    legend(page, (MARGIN, page.box(axes).bottom), list(BANDS.values()))
    return page.figure


def spiral_coordinates() -> Figure:
    """Figure 3.3: the boundary r = R0 + R (phi - phi0) about the finger's base joint."""
    numbers = sweep(HAND.half_palm, HAND.finger_length, RADIUS, FRICTION_ANGLE)
    assert numbers is not None
    psi, base = radians(27.0), np.array([HAND.half_palm, 0.0])
    tangent, normal = np.array([np.cos(psi), np.sin(psi)]), np.array([-np.sin(psi), np.cos(psi)])
    contact = base + (numbers.r0 + RADIUS * (psi - numbers.phi0)) * tangent
    words = {"r0": numbers.r0, "radius": RADIUS, "finger": HAND.finger_length}
    named = {name: millimetres(each) for name, each in words.items()}
    page = sheet(
        [[Extent(0.0, 0.0, 3.05, 2.0)]],
        title="Figure 3.3: The boundary of the contact region about the base joint",
        footer=SPIRAL.format(phi0=angle(numbers.phi0), end=angle(numbers.end), **named),
        room=Room(Pad(6.0, 13.0, 14.0, 6.0), highest=165.0),
    )
    axes = page.panels[0][0]
    line = _boundary(numbers)
    area = shape(axes, MM * np.concatenate([line, [base]]), Role.CONTACT, level=0.5, width=0.0, fill=0.45)
    area.set_linewidth(0.0)
    stroke(axes, MM * line, Role.CONTACT, level=3.0, width=1.5 * NORMAL)
    centre = contact + RADIUS * normal
    draw_object(axes, EXAMPLE.object, _place(centre), fill=0.7)
    stroke(axes, [np.zeros(2), MM * base], Role.PALM, level=PALM_LEVEL, width=HEAVY)
    for angles, ghost in ((numbers.end, True), (0.0, True), (psi, False)):
        draw_finger(axes, HAND, (angles,), ghost=ghost)
    dimension(axes, _place(base), (HAND.half_palm + numbers.r0, 0.0), "R₀", -6.0)
    note(axes, _place(0.5 * (base + contact) + 2.2 * per_paper_mm(axes) / MM * normal), "r")
    radius_dimension(axes, _place(centre), RADIUS, radians(150.0), "R")
    angle_arc(axes, _place(base), numbers.phi0, psi, "φ", reach=17.0)
    label(axes, _place(contact), "contact", (10.0, -3.0))
    label(axes, _place(base), "base joint", (-7.0, -8.0))
    label(axes, _place(line[len(line) * 17 // 20]), "boundary of the contact region", (10.0, 3.0), role=Role.CONTACT)
    label(axes, _place(line[-1]), "r = finger length", (8.0, 5.0))
    return page.figure


def _boundary(numbers: Sweep) -> NDArray[np.float64]:
    along = numbers.r0 - RADIUS * numbers.phi0
    spiral = Spiral((HAND.half_palm, 0.0), along, RADIUS, 0.0, numbers.phi0, numbers.end)
    return spiral.flattened(1e-4)[0]


def _place(point: NDArray[np.float64]) -> tuple[float, float]:
    return float(point[0]), float(point[1])
