"""Limits on the table by direction: how far each experiment lies from the source's theory."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.figure import Figure

from palmar.faces.plots.style import FINE, NORMAL, SMALL_SIZE, TEXT_SIZE, TITLE_SIZE, Role, new_figure
from palmar.studies.bed_report import ANGLES, Row

_LOOKS = (
    (Role.CENTRE, "o", "-"),
    (Role.LARGEST, "s", "--"),
    (Role.HELD, "^", "-."),
    (Role.FORCE, "D", ":"),
)


def bed_picture(theory: Row, rows: Sequence[Row]) -> Figure:
    """Up to four rows of limits against the first; points only where both have one."""
    figure = new_figure(150.0, 90.0)
    axes = figure.add_axes((0.12, 0.15, 0.84, 0.73))
    for row, (role, marker, dashes) in zip(rows, _LOOKS, strict=False):
        points = [
            (math.degrees(angle), 1e3 * (found - told))
            for angle, found, told in zip(ANGLES, row.limits, theory.limits, strict=True)
            if found is not None and told is not None
        ]
        axes.plot(
            *zip(*points, strict=True), color=role.line, marker=marker, markersize=4.0, linestyle=dashes,
            linewidth=NORMAL, label=f"{row.name} ({row.physics})",
        )  # fmt: skip
    axes.axhline(0.0, color=Role.DIMENSION.line, linewidth=FINE)
    axes.set_xlabel("direction from the palm line (deg)", fontsize=TEXT_SIZE)
    axes.set_ylabel("limit less the published theory (mm)", fontsize=TEXT_SIZE)
    axes.set_title("Limits of the centre region on the table", fontsize=TITLE_SIZE)
    axes.tick_params(labelsize=SMALL_SIZE)
    axes.set_xticks([round(math.degrees(each), 1) for each in ANGLES])
    axes.legend(fontsize=SMALL_SIZE, frameon=False)
    return figure
