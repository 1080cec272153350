"""How drawings look and how they are written: colours, sizes, and files that come out the same on every run."""

from __future__ import annotations

import threading
from enum import Enum
from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from palmar.errors import OutputError
from palmar.faces.exports.whole_file import write_whole

MM_PER_INCH = 25.4
PAGE_WIDTH = 180.0
"""Width (mm) that fits the text of an A4 page."""

TITLE_SIZE, HEADING_SIZE, TEXT_SIZE, SMALL_SIZE = 11.0, 9.0, 8.0, 7.0
"""Font sizes (points)."""

HEAVY, NORMAL, FINE = 2.4, 1.4, 0.7
"""Line widths (points): palm; fingers and outlines; dimensions and construction lines."""

SUFFIXES = ("svg", "pdf", "png")

_METADATA: dict[str, dict[str, Any]] = {
    "svg": {"Date": None, "Creator": "palmar"},
    "pdf": {"CreationDate": None, "Creator": "palmar", "Producer": None},
    "png": {"Software": "palmar"},
}
_SETTINGS: dict[Any, Any] = {
    "svg.hashsalt": "palmar",
    "svg.fonttype": "none",
    "svg.id": None,
    "pdf.fonttype": 42,
    "pdf.compression": 6,
    "path.simplify": True,
    "savefig.bbox": None,
}
_ONE_AT_A_TIME = threading.Lock()


class Role(Enum):
    """What a line or area stands for: (line colour, fill colour).

    From the Okabe-Ito palette, which stays apart under the common colour deficiencies; sets that share a picture differ
    in line style too.
    """

    HAND = ("#333333", "#D6D6D6")
    GHOST = ("#A6A6A6", "#EEEEEE")
    JOINT = ("#333333", "#FFFFFF")
    PALM = ("#000000", "#000000")
    OBJECT = ("#5A4300", "#F4DC8C")
    SMALLEST = ("#0072B2", "#CFE3F1")
    LARGEST = ("#D55E00", "#FBDDCB")
    CONTACT = ("#00624A", "#B5E3D5")
    CENTRE = ("#0072B2", "#A9CFE8")
    WHOLE = ("#8F8F8F", "#F1F1F1")
    FORCE = ("#8E2C6B", "#E9C3D9")
    DIMENSION = ("#444444", "#444444")
    CAPTION = ("#1A1A1A", "#1A1A1A")
    HELD = ("#00795A", "#7CCBB2")
    LOST = ("#C24E00", "#FBDDCB")

    def __init__(self, line: str, fill: str) -> None:
        self.line, self.fill = line, fill


def new_figure(width_mm: float, height_mm: float) -> Figure:
    """An empty white figure of that size on paper, belonging to no window system."""
    return Figure(figsize=(width_mm / MM_PER_INCH, height_mm / MM_PER_INCH), facecolor="white", edgecolor="white")


def save(figure: Figure, path: Path) -> None:
    """Write the figure whole or not at all, as SVG, PDF or PNG by the suffix of ``path``; raises OutputError."""
    kind = path.suffix.lower().removeprefix(".")
    if kind not in SUFFIXES:
        raise OutputError(f"{path}: a drawing's file must end in .svg, .pdf or .png")
    data = encoded(figure, kind)
    write_whole(path, lambda partial: _write(partial, data))


def encoded(figure: Figure, kind: str = "svg") -> bytes:
    """The figure as a file's bytes (svg, pdf or png), the same for the same figure: no dates, fixed identifiers.

    Text in SVG stays text. Matplotlib's settings are global, so they are changed for one drawing at a time.
    """
    buffer = BytesIO()
    with _ONE_AT_A_TIME, matplotlib.rc_context(_SETTINGS):
        figure.savefig(buffer, format=kind, metadata=_METADATA[kind], dpi=200, facecolor="white")
    return buffer.getvalue()


def _write(path: Path, data: bytes) -> None:
    path.write_bytes(data)
