"""What jointed fingers hold, drawn: bent around the case's disk and around the largest one."""

from __future__ import annotations

from math import degrees, pi, radians

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from palmar.faces.plots.dimensions import note, radius_dimension
from palmar.faces.plots.hand import draw_hand, draw_object
from palmar.faces.plots.lettering import line_height, millimetres
from palmar.faces.plots.sheet import MARGIN, MM, Extent, Pad, Room, per_paper_mm, sheet
from palmar.faces.plots.style import HEADING_SIZE, TEXT_SIZE, Role
from palmar.mechanics.closure.stance import Stance
from palmar.models.case import Case
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.studies.jointed_closure import JointedClosure, held_stances

ROOM = Room(inside=Pad(4.0, 20.0, 4.0, 16.0), highest=250.0, narrowest=48.0)
WORDS = 9.5
"""Height (mm) of a panel's first line of words above its lower edge."""
RADIUS_DIRECTION = radians(125.0)
NAMES = ("your disk", "largest")


def bent_picture(case: Case, answer: JointedClosure) -> Figure:
    """Rows: without friction, and with it if the case has any; columns: bent around the case's disk, around the largest."""
    alpha = case.contact.friction_angle
    headings = ["Without friction", f"With friction {case.contact.friction:.3g}"][: 2 if alpha else 1]
    rows = [held_stances(case, answer, frictional=bool(row)) for row in range(len(headings))]
    hand = case.hand
    extents = [[stance_extent(hand, stance) for stance in row] for row in rows]
    page = sheet(extents, title="What this hand holds with bent fingers, to scale", footer=_footer(answer), room=ROOM)
    for row, shown, panels, heading in zip(rows, extents, page.panels, headings, strict=True):
        top = page.box(panels[0]).top
        page.rule(top)
        page.write((MARGIN, top - 2.0), heading, size=HEADING_SIZE, bold=True, upright="top")
        for stance, extent, axes, name in zip(row, shown, panels, NAMES, strict=True):
            box = page.box(axes)
            page.write((0.5 * (box.left + box.right), top - 8.0), name, across="center", upright="top")
            role = Role.OBJECT if name == NAMES[0] else Role.LARGEST
            draw_stance(axes, hand, stance, role)
            _words(axes, extent, stance, role if stance else Role.CAPTION)
    return page.figure


def draw_stance(axes: Axes, hand: Hand, stance: Stance | None, role: Role) -> None:
    """The hand around its disk, or fingers upright as a ghost where there is none."""
    if stance is None:
        low, high = hand.base_limits
        draw_hand(axes, hand, min(max(0.5 * pi, low), high), ghost=True)
        return
    at = (0.0, stance.height)
    draw_object(axes, Disk(radius=stance.radius), at, role=role)
    radius_dimension(axes, at, stance.radius, RADIUS_DIRECTION, role=role)
    draw_hand(axes, hand, stance.angles[0], distal=stance.angles[1:])


def stance_extent(hand: Hand, stance: Stance | None) -> Extent:
    """Palm, fingers and disk."""
    h = hand.half_thickness
    if stance is None:
        return Extent(-hand.half_palm - h, -h, hand.half_palm + h, hand.finger_length)
    points = stance.joints(hand.half_palm, hand.finger_links)
    side = max(float(abs(points[:, 0]).max()) + h, stance.radius)
    top = max(float(points[:, 1].max()) + h, stance.height + stance.radius)
    return Extent(-side, -h, side, top)


def _words(axes: Axes, extent: Extent, stance: Stance | None, role: Role) -> None:
    lines = ["not held"]
    if stance is not None:
        lines = [f"radius {millimetres(stance.radius)}", " + ".join(f"{degrees(each):.0f}°" for each in stance.angles)]
    unit = per_paper_mm(axes) / MM
    middle, bottom = 0.5 * (extent.left + extent.right), axes.get_ylim()[0] / MM
    for i, line in enumerate(lines):
        y = bottom + (WORDS - (i + 1) * line_height(TEXT_SIZE)) * unit
        note(axes, (middle, y), line, role=Role.CAPTION if i else role, upright="baseline", bold=not i)


def _footer(answer: JointedClosure) -> str:
    return f"Your object: {answer.object.reason}. Angles: base joint from fully open, then each further joint from straight."
