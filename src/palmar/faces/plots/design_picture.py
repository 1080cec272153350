"""A designed hand with the object and the circle of errors, and the front of hand size against tolerated error."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from palmar.faces.plots.dimensions import dimension
from palmar.faces.plots.hand import draw_hand, draw_object
from palmar.faces.plots.lettering import millimetres
from palmar.faces.plots.sheet import MARGIN, Extent, Pad, Room, sheet
from palmar.faces.plots.style import MM_PER_INCH, NORMAL, SMALL_SIZE, TEXT_SIZE, Role
from palmar.models.behaviour import BehaviourName
from palmar.models.design_brief import DesignBrief
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.studies.design.design import Design

FRONT = 84.0
"""Height (mm) of the front's panel, with its labels."""
SIDE = 24.0
CAPTION = (
    "The hand opened flat, and the object at its nominal place, the largest one dashed. Blue: wherever in this circle its"
    " centre starts, it is caught."
)

CURLED = "Grey: the distal joints curled, before the base joints close."


def design_picture(found: Design) -> Figure:
    """The hand open, to scale; below it the front where one was asked for."""
    chosen = found.chosen
    assert chosen is not None and chosen.hand is not None
    hand, error = chosen.hand, found.error or 0.0
    things = objects_of(found.brief)
    place = chosen.place or (0.0, _reach(things[-1]))
    half, height = hand.half_palm + hand.finger_length, place[1] + max(error, _reach(things[-1]))
    below = FRONT if found.front else 0.0
    room = Room(Pad(4.0, 14.0, 4.0, 4.0), sides=Pad(bottom=below))
    title = f"The smallest hand: {millimetres(chosen.size or 0.0)} in all"
    extent = Extent(-max(half, error), -hand.half_thickness, max(half, error), height)
    curls = f" {CURLED}" if chosen.does.name is BehaviourName.CURL_AND_CLOSE else ""
    page = sheet([[extent]], title=title, footer=CAPTION + curls if error > 0.0 else "", room=room)
    axes = page.panels[0][0]
    for k, each in enumerate(things):
        draw_object(axes, each, place, fill=0.4, ghost=k > 0, mark=k == 0)
    if error > 0.0:
        draw_object(axes, Disk(radius=error), place, role=Role.CENTRE, fill=0.0, mark=False)
    draw_hand(axes, hand, hand.open)
    if chosen.does.name is BehaviourName.CURL_AND_CLOSE:
        draw_hand(axes, hand, hand.open, distal=(chosen.does.preshape,), ghost=True)
    d, length = hand.half_palm, hand.finger_length
    dimension(axes, (-d, 0.0), (d, 0.0), millimetres(hand.palm_width), -7.0)
    dimension(axes, (d, 0.0), (d + length, 0.0), millimetres(length), -7.0)
    if found.front:
        width, tall = (each * MM_PER_INCH for each in page.figure.get_size_inches())
        box = (SIDE / width, (MARGIN + 24.0) / tall, 1.0 - (SIDE + MARGIN) / width, (below - 32.0) / tall)
        _draw_front(page.figure.add_axes(box), found, hand)
    return page.figure


def _draw_front(axes: Axes, found: Design, hand: Hand) -> None:
    sizes, errors = zip(*((1e3 * size, 1e3 * error) for size, error in found.front), strict=True)
    axes.plot(sizes, errors, color=Role.CENTRE.line, linewidth=NORMAL, marker="o", markersize=3.5)
    size = 2e3 * (hand.half_palm + hand.finger_length)
    axes.plot([size], [1e3 * found.brief.targets.error], color=Role.LARGEST.line, marker="s", markersize=6.0)
    axes.set_xlabel("palm and both fingers (mm)", fontsize=TEXT_SIZE)
    axes.set_ylabel("tolerated error (mm)", fontsize=TEXT_SIZE)
    axes.tick_params(labelsize=SMALL_SIZE)


def objects_of(brief: DesignBrief) -> list[Disk | ConvexPolygon]:
    """What the brief's hand is drawn with, the smallest object first."""
    if brief.targets.radii is None:
        assert brief.targets.vertices is not None
        return [ConvexPolygon(shape="polygon", vertices=brief.targets.vertices)]
    low, high = brief.targets.radii
    return [Disk(radius=low)] if low == high else [Disk(radius=low), Disk(radius=high)]


def _reach(thing: Disk | ConvexPolygon) -> float:
    return thing.radius if isinstance(thing, Disk) else max(y for _, y in thing.vertices)
