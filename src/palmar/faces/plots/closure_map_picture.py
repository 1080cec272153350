"""Contour pictures of what 4-jointed hands hold, over the lengths of both links: figures 5.3 to 5.7 without noise."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from palmar.faces.plots.hand import draw_hand, draw_object
from palmar.faces.plots.lettering import line_height, wrapped
from palmar.faces.plots.sheet import MARGIN, Extent, Sheet
from palmar.faces.plots.style import (
    FINE,
    HEADING_SIZE,
    NORMAL,
    PAGE_WIDTH,
    SMALL_SIZE,
    TEXT_SIZE,
    TITLE_SIZE,
    Role,
    new_figure,
)
from palmar.mechanics.closure.chain import Chain, Hold, largest_hold
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.studies.closure_map import ClosureMap, grid_map

Floats = NDArray[np.float64]
Place = tuple[float, float]

NODES = 401
LEVELS = np.array([0.1, 0.2, 0.3, 0.4, 0.45, 0.5, 0.55, 0.58, 0.6])
LABELLED = (0.2, 0.4, 0.5, 0.58)
LABELS = {
    "proximal_palm": ((0.35, 0.45), (0.07, 0.53)),
    "distal_palm": ((0.8, 0.1), (0.6, 0.2), (0.5, 0.25), (0.3, 0.3)),
    "distal_proximal": ((0.72, 0.2), (0.45, 0.35), (0.15, 0.78), (0.18, 0.6)),
    "distal_proximal_palm": ((0.6, 0.24), (0.35, 0.38), (0.35, 0.44), (0.2, 0.58)),
    "overall": ((0.8, 0.1), (0.6, 0.2), (0.5, 0.25), (0.15, 0.58)),
}
"""Where contour lines of the labelled levels carry their labels."""
SHADES = "cividis"
TITLES = {
    "proximal_palm": "proximal links and palm",
    "distal_palm": "distal links and palm",
    "distal_proximal": "distal and proximal links",
    "distal_proximal_palm": "distal, proximal links, palm",
    "overall": "overall",
}
BEST = {name: ((0.0, 0.5) if name == "proximal_palm" else (0.25, 0.5)) for name in TITLES}
NOTE = (
    "Largest radius R* held without friction by the links named, as a share of half the hand's length; half palm = "
    "1 − Q − P. White: no such hold. Dashed: the crease Q = t (t = P − half palm), where the distal link is just long "
    "enough to be tangent beyond a tangent proximal link; here it is P = 0.5. Cross: the one maximum."
)
SAMPLES = ((0.25, 0.5), (0.1, 0.7), (0.45, 0.3), (0.2, 0.2))
PANEL, GAP, HEAD, ROW = 48.0, 9.0, 9.0, 48.0
MOST_HANDS = 8


def map_picture(points: Sequence[Place] = ()) -> Figure:
    """All five maps on one page, and the hands at some points with the largest disk each holds."""
    shown = [(float(q), float(p)) for q, p in points][:MOST_HANDS] or list(SAMPLES)
    rows = -(-len(shown) // 4)
    height = 2.0 * MARGIN + 8.0 + 2.0 * (PANEL + HEAD + 6.0) + 14.0 + rows * ROW
    page = Sheet(new_figure(PAGE_WIDTH, height), [])
    page.write((MARGIN, height - MARGIN), "What 4-jointed hands hold", size=TITLE_SIZE, bold=True, upright="top")
    top = height - MARGIN - 8.0
    for i, name in enumerate(TITLES):
        row, column = divmod(i, 3)
        left = MARGIN + 8.0 + column * (PANEL + GAP)
        bottom = top - HEAD - PANEL - row * (PANEL + HEAD + 6.0)
        axes = _square(page, Extent(left, bottom, left + PANEL, bottom + PANEL))
        page.write((left, bottom + PANEL + 2.0), TITLES[name], size=TEXT_SIZE, bold=True)
        _draw_map(axes, name, numbered=shown if name == "overall" else ())
        _label_axes(axes, left=column == 0, bottom=row == 1 or column == 2)
    words = wrapped(NOTE, PANEL, SMALL_SIZE)
    page.write((MARGIN + 8.0 + 2 * (PANEL + GAP), top - HEAD - PANEL - 14.0), words, size=SMALL_SIZE, upright="top")
    _draw_hands(page, shown, top - 2.0 * (PANEL + HEAD + 6.0) - 6.0)
    return page.figure


def case_picture(name: str, title: str) -> Figure:
    """One map alone, with the posture at its maximum beside it."""
    page = Sheet(new_figure(PAGE_WIDTH, 122.0), [])
    page.write((MARGIN, 122.0 - MARGIN), title, size=TITLE_SIZE, bold=True, upright="top")
    axes = _square(page, Extent(16.0, 26.0, 101.0, 111.0))
    _draw_map(axes, name)
    _label_axes(axes)
    hand = BEST[name]
    _draw_hand(page, Extent(112.0, 46.0, 172.0, 106.0), hand)
    words = f"the maximum, at Q = {hand[0]:g}, P = {hand[1]:g}: R* = {_radius(name):.4f}"
    page.write((142.0, 40.0), words, across="center")
    page.write((MARGIN, 14.0), wrapped(NOTE, PAGE_WIDTH - 2.0 * MARGIN, SMALL_SIZE), size=SMALL_SIZE, upright="top")
    return page.figure


@lru_cache(maxsize=1)
def _map() -> ClosureMap:
    return grid_map(NODES)


@lru_cache(maxsize=64)
def _largest(half_palm: float, links: tuple[float, ...]) -> Hold | None:
    return largest_hold(Chain(half_palm, links))


def _radius(name: str) -> float:
    return 0.5 if name == "proximal_palm" else (1.0 + 2.0**0.5) / 4.0


def _square(page: Sheet, box: Extent) -> Axes:
    width, height = page.size
    place = (box.left / width, box.bottom / height, box.size[0] / width, box.size[1] / height)
    axes = page.figure.add_axes(place)
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0), aspect="equal")
    axes.tick_params(labelsize=SMALL_SIZE, length=2.0, width=FINE, pad=1.5)
    ticks = [0.0, 0.25, 0.5, 0.75, 1.0]
    axes.set_xticks(ticks, [f"{each:g}" for each in ticks])
    axes.set_yticks(ticks, [f"{each:g}" for each in ticks])
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    return axes


def _label_axes(axes: Axes, *, left: bool = True, bottom: bool = True) -> None:
    if bottom:
        axes.set_xlabel("distal link Q", fontsize=SMALL_SIZE, labelpad=1.0)
    if left:
        axes.set_ylabel("proximal link P", fontsize=SMALL_SIZE, labelpad=1.0)


def _draw_map(axes: Axes, name: str, *, numbered: Sequence[Place] = ()) -> None:
    found = _map()
    shares = np.linspace(0.0, 1.0, NODES)
    radii = np.ma.masked_invalid(found.radius_max[name].reshape(NODES, NODES))
    fills = np.concatenate([[0.0], LEVELS, [0.61]])
    axes.contourf(shares, shares, radii, levels=fills, cmap=SHADES, zorder=1.0)
    lines = axes.contour(shares, shares, radii, levels=LEVELS, colors="white", linewidths=FINE, zorder=1.5)
    for level, place in zip(LABELLED, LABELS[name], strict=False):
        colour = "white" if level < 0.45 else "black"
        axes.clabel(
            lines, [level], fmt="%g", fontsize=0.85 * SMALL_SIZE, inline_spacing=2, colors=colour, manual=[place]
        )
    axes.plot([0.0, 1.0], [1.0, 0.0], color=Role.DIMENSION.line, linewidth=FINE, zorder=2.0)
    if name != "proximal_palm":
        axes.plot([0.0, 0.5], [0.5, 0.5], color="black", linewidth=NORMAL, dashes=(3, 2), zorder=2.0, clip_on=True)
    best = BEST[name]
    axes.plot(*best, marker="x", color="black", markersize=6.0, markeredgewidth=NORMAL, zorder=3.0, clip_on=False)
    for number, place in enumerate(numbered, 1):
        axes.annotate(
            str(number), place, xytext=(5.0, 5.0), textcoords="offset points", fontsize=SMALL_SIZE, zorder=4.0,
            bbox={"boxstyle": "circle,pad=0.15", "facecolor": "white", "edgecolor": "black", "linewidth": FINE},
        )  # fmt: skip
        axes.plot(*place, marker="o", color="black", markersize=2.5, zorder=4.0)


def _draw_hands(page: Sheet, hands: Sequence[Place], top: float) -> None:
    page.rule(top)
    page.write((MARGIN, top - 2.0), "Hands at the numbered points", size=HEADING_SIZE, bold=True, upright="top")
    width = (PAGE_WIDTH - 2.0 * MARGIN) / 4.0
    for i, hand in enumerate(hands):
        row, column = divmod(i, 4)
        left, upper = MARGIN + column * width, top - 8.0 - row * ROW
        radius = _draw_hand(page, Extent(left + 2.0, upper - 34.0, left + width - 2.0, upper), hand)
        said = f"{i + 1}: Q {hand[0]:g}, P {hand[1]:g}"
        middle = left + 0.5 * width
        page.write((middle, upper - 38.0), said, across="center", bold=True)
        held = "holds no disk" if radius is None else f"R* = {radius:.4f}"
        page.write((middle, upper - 38.0 - line_height(TEXT_SIZE)), held, across="center")


def _draw_hand(page: Sheet, box: Extent, place: Place) -> float | None:
    """The hand with the largest disk it holds; all hands are as long. Returns the radius."""
    q, p = place
    w = 1.0 - q - p
    extent = Extent(-1.02, -0.06, 1.02, 1.25)
    axes = page.inset(box, extent)
    links = tuple(each for each in (p, q) if each > 0.0)
    hold = _largest(w, links)
    hand = Hand(palm_width=2.0 * w, finger_links=links)
    if hold is None:
        draw_hand(axes, hand, 0.0)
        return None
    joints = posture(hold.joints, links, hold.radius, hold.height, hold.elevation)
    draw_object(axes, Disk(radius=hold.radius), (0.0, hold.height), mark=False)
    draw_hand(axes, hand, joints[0], distal=joints[1:])
    axes.axhline(0.0, xmin=0.0, xmax=1.0, color=Role.GHOST.line, linewidth=FINE, zorder=0.0)
    return hold.radius


def posture(
    joints: Floats, links: Sequence[float], radius: float, height: float, elevation: float
) -> tuple[float, ...]:
    """Joint angles (rad): through the joints of the hold, the last link on to its contact, the rest straight on."""
    contact = np.array([radius * np.cos(elevation), height + radius * np.sin(elevation)])
    places = np.vstack([joints, contact])
    steps = np.diff(places, axis=0)
    directions = np.arctan2(steps[:, 1], steps[:, 0])
    directions = np.concatenate([directions, np.full(len(links) - directions.size, directions[-1])])
    return tuple(float(each) for each in np.diff(directions, prepend=0.0))
