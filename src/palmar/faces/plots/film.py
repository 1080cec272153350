"""A film of one closing motion; the ending of the name chooses the format."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
from matplotlib.colors import to_rgb
from PIL import Image

from palmar.errors import InputError, OutputError
from palmar.faces.exports.whole_file import write_whole
from palmar.faces.pages.film_page import film_page
from palmar.faces.plots.film_frames import HELD, RATE, frames, moments
from palmar.faces.plots.film_scene import Scene, scene
from palmar.faces.plots.mp4 import fill_mp4
from palmar.faces.plots.style import Role
from palmar.models.case import Case
from palmar.studies.simulate import Simulation

ENDINGS = (".gif", ".mp4", ".html")
COLOURS = 64
SAMPLES = 5
"""Pictures that the common palette of a GIF is made from."""
NEARLY_WHITE = 248
"""What is this light becomes the white of the paper."""
SMALL = (Role.FORCE, Role.OBJECT, Role.SMALLEST, Role.HAND, Role.GHOST, Role.HELD, Role.LOST)


def known_ending(path: Path) -> None:
    """Raise InputError unless the path's ending is one that can be written, OutputError where no program can."""
    if path.suffix.lower() not in ENDINGS:
        raise InputError("--animate", str(path), f"the name must end in one of {', '.join(ENDINGS)}")
    if path.suffix.lower() == ".mp4" and shutil.which("ffmpeg") is None:
        raise OutputError(
            f"{path}: an mp4 film needs the program ffmpeg, which is not installed; .gif and .html do not"
        )


def write_film(path: Path, case: Case, start: tuple[float, ...], result: Simulation) -> None:
    """Write the motion from ``start`` (x, y, theta[, vx, vy]) whole or not at all.

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
    times, palette = moments(film), _palette(film)
    pictures = [
        Image.fromarray(each).quantize(palette=palette, dither=Image.Dither.NONE) for each in frames(film, times)
    ]
    durations = [1000 // RATE] * (len(pictures) - 1) + [round(1000 * HELD)]
    pictures[0].save(
        path, format="GIF", save_all=True, append_images=pictures[1:], duration=durations, loop=0, optimize=True
    )


def _palette(film: Scene) -> Image.Image:
    """The commonest colours of a few pictures, and exactly those of small things that these would miss."""
    joined = Image.fromarray(np.concatenate(list(frames(film, np.linspace(0.0, film.duration, SAMPLES).tolist()))))
    common = joined.quantize(COLOURS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).getpalette() or []
    exact = np.array([to_rgb("white"), *(to_rgb(role.line) for role in SMALL)])
    rest = np.reshape(common[: 3 * COLOURS], (-1, 3))
    rest = rest[rest.min(axis=1) < NEARLY_WHITE]
    palette = Image.new("P", (1, 1))
    palette.putpalette(np.vstack((np.rint(255.0 * exact), rest)).astype(int).ravel().tolist())
    return palette


def _mp4(path: Path, film: Scene) -> None:
    """The pictures through ffmpeg, one by one."""
    times = moments(film)
    pictures = frames(film, times + times[-1:] * round(HELD * RATE))
    fill_mp4(path, pictures, RATE)
