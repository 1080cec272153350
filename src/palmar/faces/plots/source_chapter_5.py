"""Figures 5.3 to 5.8, drawn anew: what 4-jointed hands hold, and the shortest hands for one disk."""

from __future__ import annotations

from functools import partial
from math import pi

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from palmar.faces.plots.closure_map_picture import case_picture
from palmar.faces.plots.dimensions import dimension, note
from palmar.faces.plots.hand import draw_hand, draw_object
from palmar.faces.plots.sheet import MM, Extent, Pad, Room, per_paper_mm, sheet
from palmar.faces.plots.strokes import stroke
from palmar.faces.plots.style import HEADING_SIZE, HEAVY, Role
from palmar.mechanics.closure.shortest_hand import shortest_hand
from palmar.models.hand import Hand
from palmar.models.objects import Disk

RADIUS = 0.05
OPTIMAL = (
    "The shortest hands that hold one disk without friction, to one scale. With n links a finger the hand is half of a "
    "regular polygon with 4n sides around the disk, 4nR tan(π/4n) long; the ideal hand has links without end, πR."
)

case_1 = partial(case_picture, "distal_proximal", "Figure 5.3: Held between distal and proximal links")
case_2 = partial(case_picture, "proximal_palm", "Figure 5.4: Held between proximal links and palm")
case_3 = partial(case_picture, "distal_palm", "Figure 5.5: Held between distal links and palm")
case_4 = partial(case_picture, "distal_proximal_palm", "Figure 5.6: Held between distal links, proximal links and palm")
all_cases = partial(case_picture, "overall", "Figure 5.7: The largest disk held in any way")


def optimal_hands() -> Figure:
    """Figure 5.8: the ideal hand, and the shortest ones with one and with two links a finger."""
    extent = Extent(-1.25 * RADIUS, 0.0, 1.25 * RADIUS, 2.0 * RADIUS)
    page = sheet(
        [[extent] * 3],
        title="Figure 5.8: Optimal hands for one disk",
        footer=OPTIMAL,
        room=Room(inside=Pad(3.0, 20.0, 3.0, 6.0), highest=120.0),
    )
    for axes, links, name in zip(page.panels[0], (None, 1, 2), ("ideal", "2-jointed", "4-jointed"), strict=True):
        draw_object(axes, Disk(radius=RADIUS), (0.0, RADIUS))
        length = pi if links is None else _draw_shortest(axes, links)
        if links is None:
            turn = np.linspace(pi, 2.0 * pi, 181)
            half = MM * RADIUS * np.stack([np.cos(turn), 1.0 + np.sin(turn)], axis=1)
            stroke(axes, half, Role.HAND, level=5.0, width=HEAVY)
        unit, bottom = per_paper_mm(axes) / MM, axes.get_ylim()[0] / MM
        note(axes, (0.0, bottom + 7.0 * unit), name, size=HEADING_SIZE, bold=True)
        share = "" if links is None else f" (ideal / this = {pi / length:.3f})"
        note(axes, (0.0, bottom + 2.5 * unit), f"length {length:.4f} R{share}")
    return page.figure


def _draw_shortest(axes: Axes, links: int) -> float:
    """The hand around the disk; its length over R."""
    shortest = shortest_hand(links, RADIUS)
    hand = Hand(palm_width=2.0 * shortest.half_palm, finger_links=shortest.links)
    turn = 0.5 * pi / links
    draw_hand(axes, hand, turn, distal=(turn,) * (links - 1))
    half = shortest.half_palm
    dimension(axes, (-half, 0.0), (half, 0.0), f"{2.0 * half / RADIUS:.3g} R", -5.0)
    return shortest.length / RADIUS
