"""A film of the cell."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from palmar.errors import InputError, NotCoveredError, OutputError
from palmar.faces.cli.printing import progress

if TYPE_CHECKING:
    from palmar.studies.cell_trials import Trials

LAST = 1500
"""How long (ms) the last picture stays."""


def known_ending(path: Path | None) -> None:
    """Raise InputError unless a film can have such a name, OutputError where no program can write it."""
    if path is None:
        return
    if path.suffix.lower() not in (".gif", ".mp4"):
        raise InputError("--view", str(path), "the name must end in .gif or .mp4")
    if path.suffix.lower() == ".mp4" and shutil.which("ffmpeg") is None:
        raise OutputError(f"{path}: an mp4 film needs the program ffmpeg, which is not installed; .gif does not")


def film(path: Path, asked: Trials) -> str:
    """Film the first trial; a line about it, also where nothing can be rendered."""
    from palmar.faces.plots.gif import write_gif
    from palmar.faces.plots.mp4 import write_mp4
    from palmar.studies.cell_trials import run_one
    from palmar.worlds.mujoco.cell.film import EVERY, Film

    taken = Film()
    try:
        run_one((asked, 0), taken)
    except NotCoveredError as error:
        said = f"no film: {error}"
        progress(said)
        return said
    if path.suffix.lower() == ".gif":
        write_gif(path, taken.pictures, 28 * EVERY, LAST)
    else:
        write_mp4(path, taken.pictures, 1.0 / (0.028 * EVERY))
    return f"the first trial, filmed: {path}"
