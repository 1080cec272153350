"""A film of the cell, rendered in a process of its own: how MuJoCo renders is settled by its first import."""

from __future__ import annotations

import os
import shutil
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from pickle import dumps, loads
from typing import TYPE_CHECKING

from palmar.errors import InputError, NotCoveredError, OutputError
from palmar.faces.cli.pool import processes
from palmar.faces.cli.printing import progress

if TYPE_CHECKING:
    from palmar.studies.cell_trials import Trials
    from palmar.worlds.mujoco.cell.film import Picture

WAYS = ("egl", "osmesa")
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
    from palmar.worlds.mujoco.cell.film import EVERY

    pictures = _pictures(asked)
    if pictures is None:
        said = (
            "no film: nothing can be rendered off the screen here;"
            " Debian's packages libegl1, libgl1 and libgl1-mesa-dri allow it"
        )
        progress(said)
        return said
    if path.suffix.lower() == ".gif":
        write_gif(path, pictures, 28 * EVERY, LAST)
    else:
        write_mp4(path, pictures, 1.0 / (0.028 * EVERY))
    return f"the first trial, filmed: {path}"


def _rendered(packed: bytes) -> list[Picture] | None:
    """In a process of its own: pictures of the first trial, None where nothing can be rendered this way.

    The trials come packed: to unpack them imports MuJoCo, which raises where the way to render is not there.
    """
    try:
        asked: Trials = loads(packed)
        from palmar.models.salisbury_hand import SalisburyHand
        from palmar.worlds.mujoco.cell.film import film_trial

        return film_trial(SalisburyHand(), asked.task, asked.settings(0), asked.error)
    except (NotCoveredError, ImportError, AttributeError, RuntimeError):
        return None


def _pictures(asked: Trials) -> list[Picture] | None:
    """Through EGL, or else OSMesa; ``MUJOCO_GL``, where set, names the only way to be tried."""
    set_by_user = os.environ.get("MUJOCO_GL")
    try:
        for way in (set_by_user,) if set_by_user else WAYS:
            os.environ["MUJOCO_GL"] = way
            try:
                with processes(1) as pool:
                    made = pool.submit(_rendered, dumps(asked)).result()
            except BrokenProcessPool:  # the graphics stack took the process with it
                continue
            if made is not None:
                return made
    finally:
        if set_by_user is None:
            os.environ.pop("MUJOCO_GL", None)
    return None
