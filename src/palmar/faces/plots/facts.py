"""A column of facts beside a panel: a small name over each value, headings without a name."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes

from palmar.faces.plots.lettering import line_height, wrapped
from palmar.faces.plots.sheet import Sheet
from palmar.faces.plots.style import HEADING_SIZE, SMALL_SIZE, TEXT_SIZE, Role

Fact = tuple[str, str, Role]
"""Name ("" for a heading), value, and what it stands for; values of captions are not bold."""
FACTS = 54.0
"""Width (mm) of the column."""


def write_facts(page: Sheet, axes: Axes, facts: Sequence[Fact]) -> None:
    """Write the facts into the column to the right of a panel, from its top downwards."""
    box = page.box(axes)
    x, y = box.right + 5.0, box.top - 1.0
    for name, value, role in facts:
        if name:
            page.write((x, y), name, size=SMALL_SIZE, role=Role.DIMENSION, upright="top")
            y -= line_height(SMALL_SIZE)
        size, bold = (TEXT_SIZE, role is not Role.CAPTION) if name else (HEADING_SIZE, True)
        text = wrapped(value, FACTS - 7.0, size, bold=bold)
        page.write((x, y), text, size=size, role=role, bold=bold, upright="top")
        y -= (text.count("\n") + 1) * line_height(size) + 2.0
