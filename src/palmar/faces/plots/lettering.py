"""Words and numbers on drawings: lengths in mm, angles in degrees, and the room that text takes."""

from __future__ import annotations

import re
from functools import lru_cache
from math import degrees, floor, log10

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from palmar.faces.plots.style import MM_PER_INCH

POINTS_PER_INCH = 72.0
LINE_SPACING = 1.25
NO_BREAK = "\u00a0"
_UNIT = re.compile(r"(\d) (mm|deg|m²|cm²)")


def millimetres(length: float) -> str:
    """A length (m) in mm, to four significant digits and never with an exponent; 0 below a nanometre."""
    return f"{_plain(1e3 * length)} mm"


def square_millimetres(area: float) -> str:
    """An area (m^2) in mm^2, or in cm^2 or m^2 where that reads better."""
    for unit, scale, least in (("m²", 1.0, 0.1), ("cm²", 1e4, 10e-4)):
        if area >= least:
            return f"{_plain(scale * area)} {unit}"
    return f"{_plain(1e6 * area)} mm²"


def angle(value: float) -> str:
    """An angle (rad) in degrees."""
    return f"{degrees(value):.1f}".removesuffix(".0").replace("-0", "0", 1 if abs(degrees(value)) < 0.05 else 0) + "°"


def text_width(text: str, size: float, *, bold: bool = False) -> float:
    """Width on paper (mm) of the text's longest line at ``size`` points."""
    return max(_width(line, size, bold) for line in text.split("\n"))


def line_height(size: float) -> float:
    """Distance on paper (mm) from one line of text to the next."""
    return LINE_SPACING * size * MM_PER_INCH / POINTS_PER_INCH


def wrapped(text: str, width: float, size: float, *, bold: bool = False) -> str:
    """The text broken into lines of at most ``width`` mm on paper; single longer words stand alone.

    Numbers stay with their units, and no-break spaces do not break.
    """
    lines: list[str] = []
    for paragraph in _UNIT.sub(rf"\1{NO_BREAK}\2", text).split("\n"):
        line = ""
        for word in paragraph.split(" "):
            longer = f"{line} {word}".strip()
            if line and _width(longer, size, bold) > width:
                lines.append(line)
                line = word
            else:
                line = longer
        lines.append(line)
    return "\n".join(lines).replace(NO_BREAK, " ")


@lru_cache(maxsize=4096)
def _width(text: str, size: float, bold: bool) -> float:
    font = FontProperties(family="DejaVu Sans", size=size, weight="bold" if bold else "normal")
    width, _, _ = text_to_path.get_text_width_height_descent(text, font, False)
    return float(width) * MM_PER_INCH / POINTS_PER_INCH


def _plain(value: float) -> str:
    if abs(value) < 1e-6:
        return "0"
    decimals = max(0, 3 - floor(log10(abs(value))))
    text = f"{value:.{decimals}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text
