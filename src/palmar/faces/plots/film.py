"""A film of one closing motion; the ending of the name chooses the format."""

from __future__ import annotations

import shutil
from pathlib import Path
from subprocess import CalledProcessError

import numpy as np
from matplotlib.animation import FFMpegWriter
from matplotlib.figure import Figure
from PIL import Image

from palmar.errors import InputError, OutputError
from palmar.faces.exports.whole_file import write_whole
from palmar.faces.pages.film_page import film_page
from palmar.faces.plots.film_frames import HELD, RATE, frames
from palmar.faces.plots.film_scene import Scene, scene
from palmar.models.case import Case
from palmar.studies.simulate import Simulation

ENDINGS = (".gif", ".mp4", ".html")
COLOURS = 96
SAMPLES = 5
"""Pictures that the common palette of a GIF is made from."""


def known_ending(path: Path) -> None:
    """Raise InputError unless the path's ending is one that can be written, OutputError where no program can."""
    if path.suffix.lower() not in ENDINGS:
        raise InputError("--animate", str(path), f"the name must end in one of {', '.join(ENDINGS)}")
    if path.suffix.lower() == ".mp4" and shutil.which("ffmpeg") is None:
        raise OutputError(
            f"{path}: an mp4 film needs the program ffmpeg, which is not installed; .gif and .html do not"
        )


def write_film(path: Path, case: Case, start: tuple[float, float], result: Simulation) -> None:
    """Write the motion from ``start`` (m) whole or not at all.

    Raises InputError for an unknown ending, OutputError where the file cannot be written.
    """
    known_ending(path)
    film = scene(case, start, result)
    write = {".gif": _gif, ".mp4": _mp4, ".html": _html}[path.suffix.lower()]
    write_whole(path, lambda partial: write(partial, film))


def _html(path: Path, film: Scene) -> None:
    path.write_text(film_page(film), encoding="utf-8")


def _gif(path: Path, film: Scene) -> None:
    """All pictures in one palette without dithering, so that only what moves takes room."""
    pictures = [Image.fromarray(each) for each in frames(film)]
    width, height = pictures[0].size
    picked = [pictures[k * (len(pictures) - 1) // (SAMPLES - 1)] for k in range(SAMPLES)]
    joined = Image.new("RGB", (width, SAMPLES * height))
    for k, each in enumerate(picked):
        joined.paste(each, (0, k * height))
    palette = joined.quantize(COLOURS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    colours = np.reshape(palette.getpalette() or [], (-1, 3))
    colours[colours.sum(axis=1).argmax()] = 255  # the paper, which the median cut leaves slightly grey
    palette.putpalette(colours.ravel().tolist())
    flat = [each.quantize(palette=palette, dither=Image.Dither.NONE) for each in pictures]
    durations = [1000 // RATE] * (len(flat) - 1) + [round(1000 * HELD)]
    flat[0].save(path, format="GIF", save_all=True, append_images=flat[1:], duration=durations, loop=0, optimize=False)


def _mp4(path: Path, film: Scene) -> None:
    pictures = list(frames(film))
    pictures += [pictures[-1]] * round(HELD * RATE)
    height, width, _ = pictures[0].shape
    figure = Figure(figsize=(width / 100.0, height / 100.0), dpi=100)
    shown = figure.figimage(pictures[0])
    writer = FFMpegWriter(fps=RATE, codec="h264", extra_args=["-f", "mp4", "-movflags", "+faststart"])
    try:
        with writer.saving(figure, str(path), 100):
            for each in pictures:
                shown.set_data(each)
                writer.grab_frame()
    except (CalledProcessError, RuntimeError) as error:
        raise OutputError(f"{path}: ffmpeg could not make the film: {error}") from None
