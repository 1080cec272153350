"""The sheet: panels side by side at one common scale, laid out in paper millimetres before anything is drawn.

Axes count millimetres of the real thing. Because their limits and places are fixed first, arrows and text can be placed
at distances on paper (``per_paper_mm``), and nothing is rescaled afterwards.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate, pairwise

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from palmar.faces.plots.lettering import line_height, wrapped
from palmar.faces.plots.style import FINE, MM_PER_INCH, PAGE_WIDTH, TEXT_SIZE, TITLE_SIZE, Role, new_figure

MM = 1e3
MARGIN = 5.0


@dataclass(frozen=True)
class Extent:
    """A rectangle of the real thing (m)."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        return self.right - self.left, self.top - self.bottom

    def contains(self, place: tuple[float, float]) -> bool:
        """Whether a place lies in it."""
        return self.left <= place[0] <= self.right and self.bottom <= place[1] <= self.top

    def joined(self, other: Extent) -> Extent:
        """The smallest rectangle around both."""
        low = min(self.left, other.left), min(self.bottom, other.bottom)
        return Extent(*low, max(self.right, other.right), max(self.top, other.top))

    def within(self, other: Extent) -> Extent:
        """The part common to both."""
        low = max(self.left, other.left), max(self.bottom, other.bottom)
        return Extent(*low, min(self.right, other.right), min(self.top, other.top))


@dataclass(frozen=True)
class Pad:
    """Free room on paper (mm) on the four sides."""

    left: float = 0.0
    bottom: float = 0.0
    right: float = 0.0
    top: float = 0.0

    @property
    def across(self) -> float:
        """Left and right together."""
        return self.left + self.right

    @property
    def upright(self) -> float:
        """Bottom and top together."""
        return self.bottom + self.top


@dataclass(frozen=True)
class Room:
    """Where panels may go on the paper (mm): free room inside each panel, around each, and at the paper's sides."""

    inside: Pad = Pad(6.0, 6.0, 6.0, 6.0)
    outside: Pad = Pad()
    sides: Pad = Pad()
    width: float = PAGE_WIDTH
    highest: float = 230.0
    narrowest: float = 0.0
    """Least width of a column."""


@dataclass(frozen=True)
class Sheet:
    """A figure with its panels, row by row."""

    figure: Figure
    panels: list[list[Axes]]

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the paper (mm)."""
        width, height = self.figure.get_size_inches()
        return float(width) * MM_PER_INCH, float(height) * MM_PER_INCH

    def box(self, panel: Axes) -> Extent:
        """The panel's rectangle on the paper (mm)."""
        width, height = self.size
        place = panel.get_position(original=True)
        return Extent(place.x0 * width, place.y0 * height, place.x1 * width, place.y1 * height)

    def inset(self, box: Extent, extent: Extent) -> Axes:
        """A further panel in the rectangle ``box`` of the paper (mm) that shows all of ``extent`` at its own scale."""
        across, upright = extent.size
        return _panel(self, box, extent, extent, Pad(), min(box.size[0] / across, box.size[1] / upright))

    def rule(self, y: float) -> None:
        """A thin line across the paper at height ``y`` (mm)."""
        width, height = self.size
        ends = [MARGIN / width, 1.0 - MARGIN / width]
        self.figure.add_artist(Line2D(ends, [y / height] * 2, color=Role.GHOST.line, linewidth=FINE))

    def write(
        self,
        at: tuple[float, float],
        text: str,
        *,
        size: float = TEXT_SIZE,
        role: Role = Role.CAPTION,
        bold: bool = False,
        across: str = "left",
        upright: str = "baseline",
        turned: float = 0.0,
    ) -> None:
        """Text at (x, y) mm from the paper's lower left corner."""
        width, height = self.size
        weight = "bold" if bold else "normal"
        self.figure.text(
            at[0] / width, at[1] / height, text, fontsize=size, color=role.line, fontweight=weight,
            ha=across, va=upright, rotation=turned,
        )  # fmt: skip


def sheet(extents: list[list[Extent]], *, title: str = "", footer: str = "", room: Room = Room()) -> Sheet:
    """One panel for each extent, all at the largest common scale that fits; title above, wrapped footer below.

    Every column is as wide, and every row as high, as its largest extent asks; the panels of a row have level y axes.
    """
    heading = wrapped(title, room.width - 2.0 * MARGIN, TITLE_SIZE, bold=True)
    caption = wrapped(footer, room.width - 2.0 * MARGIN, TEXT_SIZE)
    above = (heading.count("\n") + 1) * line_height(TITLE_SIZE) + 2.0 if title else 0.0
    below = (caption.count("\n") + 1) * line_height(TEXT_SIZE) + 4.0 if footer else 0.0
    levels = [(min(each.bottom for each in row), max(each.top for each in row)) for row in extents]
    widths = [max(each.right - each.left for each in column) for column in zip(*extents, strict=True)]
    heights = [high - low for low, high in levels]
    tall = room.inside.upright + room.outside.upright
    fixed = 2.0 * MARGIN + room.sides.upright + above + below + len(levels) * tall
    scale, across = _columns(widths, (room.highest - fixed) / sum(heights), room)
    height = fixed + scale * sum(heights)
    sides = accumulate(across, initial=MARGIN + room.sides.left)
    tops = accumulate((-scale * each - tall for each in heights), initial=height - MARGIN - above - room.sides.top)
    result = Sheet(new_figure(room.width, height), [])
    columns = list(pairwise(sides))
    for row, (low, high), (top, bottom) in zip(extents, levels, pairwise(tops), strict=True):
        boxes = [_shrunk(Extent(left, bottom, right, top), room.outside) for left, right in columns]
        level = Extent(0.0, low, 0.0, high)
        result.panels.append(
            [_panel(result, *each, level, room.inside, scale) for each in zip(boxes, row, strict=True)]
        )
    result.write((MARGIN, height - MARGIN), heading, size=TITLE_SIZE, bold=True, upright="top")
    result.write((MARGIN, MARGIN + below - 4.0), caption, upright="top")
    return result


def per_paper_mm(axes: Axes) -> float:
    """How many mm of the real thing one mm on paper is."""
    left, right = axes.get_xlim()
    figure = axes.get_figure(root=True)
    assert figure is not None
    paper = float(figure.get_size_inches()[0]) * MM_PER_INCH * axes.get_position(original=True).width
    return float((right - left) / paper)


def _columns(widths: list[float], highest_scale: float, room: Room) -> tuple[float, list[float]]:
    """The scale (paper mm for 1 m), and each column's width on paper; what is left over is shared out."""
    pad = room.inside.across + room.outside.across
    free = room.width - 2.0 * MARGIN - room.sides.across
    wide = set(range(len(widths)))
    while True:
        narrow = len(widths) - len(wide)
        scale = (free - narrow * room.narrowest - len(wide) * pad) / sum(widths[i] for i in wide)
        scale = min(scale, highest_scale)
        tight = {i for i in wide if scale * widths[i] + pad < room.narrowest}
        if not tight or tight == wide:
            break
        wide -= tight
    across = [max(scale * each + pad, room.narrowest) for each in widths]
    spare = (free - sum(across)) / len(widths)
    return scale, [each + spare for each in across]


def _shrunk(box: Extent, pad: Pad) -> Extent:
    return Extent(box.left + pad.left, box.bottom + pad.bottom, box.right - pad.right, box.top - pad.top)


def _panel(paper: Sheet, box: Extent, extent: Extent, level: Extent, inside: Pad, scale: float) -> Axes:
    """Axes in the paper's ``box`` (mm), the extent's middle in the middle of the room left inside."""
    width, height = paper.size
    span, rise = box.right - box.left, box.top - box.bottom
    axes = paper.figure.add_axes((box.left / width, box.bottom / height, span / width, rise / height), facecolor="none")
    middle = 0.5 * (extent.left + extent.right) + 0.5 * (inside.right - inside.left) / scale
    axes.set_xlim(MM * (middle - 0.5 * span / scale), MM * (middle + 0.5 * span / scale))
    low = 0.5 * (level.bottom + level.top) + 0.5 * (inside.top - inside.bottom) / scale - 0.5 * rise / scale
    axes.set_ylim(MM * low, MM * (low + rise / scale))
    axes.set_aspect("equal", adjustable="box")
    axes.set_axis_off()
    return axes
