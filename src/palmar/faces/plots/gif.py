"""Whole pictures one after the other as a GIF."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

from palmar.faces.exports.whole_file import write_whole

Picture = NDArray[np.uint8]
DPI, COLOURS = 90, 48
"""Dots per inch; colours of the palette."""


def rendered(figure: Figure) -> Picture:
    """RGB (height, width, 3), both even."""
    canvas: Any = FigureCanvasAgg(figure)
    figure.set_dpi(DPI)
    canvas.draw()
    picture = np.asarray(canvas.buffer_rgba())[:, :, :3]
    return picture[: len(picture) // 2 * 2, : picture.shape[1] // 2 * 2].copy()


def write_gif(path: Path, pictures: Sequence[Picture], delay: int, last: int) -> None:
    """Write pictures ``delay`` ms apart, the last for ``last`` ms, whole or not at all."""
    images = [Image.fromarray(each) for each in pictures]
    palette = images[len(images) // 3].quantize(COLOURS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    flat = [each.quantize(palette=palette, dither=Image.Dither.NONE) for each in images]
    durations = [delay] * (len(flat) - 1) + [last]

    def write(partial: Path) -> None:
        flat[0].save(
            partial, format="GIF", save_all=True, append_images=flat[1:], duration=durations, loop=0, optimize=True
        )

    write_whole(path, write)
