"""The regions of several closing strategies side by side, each with the hand as it starts and as it is curled."""

from __future__ import annotations

from math import degrees

from matplotlib.figure import Figure

from palmar.faces.plots.areas import Band, draw_area
from palmar.faces.plots.hand import draw_finger, draw_hand, draw_object
from palmar.faces.plots.lettering import square_millimetres
from palmar.faces.plots.sheet import Extent, Pad, Room, sheet
from palmar.faces.plots.style import SMALL_SIZE, Role
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.studies.strategies import Strategy, winner

MOST_COLUMNS = 3
CAPTION = 11.0
"""Room (mm) above each panel for its two lines."""


def strategies_picture(case: Case, found: tuple[Strategy, ...]) -> Figure:
    """All at one scale; the title names the winner."""
    best = winner(found)
    extent = _extent(case, found)
    columns = 2 if len(found) % 2 == 0 else MOST_COLUMNS
    rows = [list(found[k : k + columns]) for k in range(0, len(found), columns)]
    page = sheet(
        [[extent for _ in row] for row in rows],
        title=f"Where the object may start, by closing strategy: {best.name} catches from most",
        room=Room(Pad(2.0, 2.0, 2.0, 2.0), outside=Pad(top=CAPTION)),
    )
    for row, panels in zip(rows, page.panels, strict=True):
        for each, axes in zip(row, panels, strict=True):
            draw_area(axes, each.region.centre, Band(Role.CENTRE, "", 0.0))
            curled = each.behaviour.name is BehaviourName.CURL_AND_CLOSE
            draw_hand(axes, case.hand, case.hand.open)
            for left in (True, False) if curled else ():
                joints = (case.hand.open, each.behaviour.preshape)
                draw_finger(axes, case.hand, joints, left=left, ghost=True)
            if each.region.allowed_error is not None:
                draw_object(axes, case.object, each.region.allowed_error.centre, case.start.theta, fill=0.4)
            box = page.box(axes)
            page.write((box.left, box.top + 6.0), _title(each), bold=each is best)
            page.write((box.left, box.top + 1.5), square_millimetres(each.region.area), size=SMALL_SIZE)
    return page.figure


def _title(each: Strategy) -> str:
    if each.value is None:
        return each.name
    if each.behaviour.name is BehaviourName.CLOSE_COUPLED:
        return f"{each.name}, distal {each.value:.3g} times as fast"
    return f"{each.name}, curled by {degrees(each.value):.3g}°"


def _extent(case: Case, found: tuple[Strategy, ...]) -> Extent:
    hand = case.hand
    side = hand.half_palm + hand.finger_length
    extent = Extent(-side, -hand.half_thickness, side, 0.5 * hand.finger_length)
    for each in found:
        if not each.region.centre.is_empty:
            extent = extent.joined(Extent(*each.region.centre.bounds))
    return extent
