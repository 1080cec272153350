"""Whole pictures one after the other as an mp4 film, through the program ffmpeg."""

from __future__ import annotations

import shutil
from collections.abc import Iterable
from itertools import chain
from pathlib import Path
from subprocess import DEVNULL, PIPE, Popen

import numpy as np
from numpy.typing import NDArray

from palmar.errors import OutputError
from palmar.faces.exports.whole_file import write_whole


def write_mp4(path: Path, pictures: Iterable[NDArray[np.uint8]], rate: float) -> None:
    """Write RGB pictures, so many a second, whole or not at all; raises OutputError without ffmpeg."""
    if shutil.which("ffmpeg") is None:
        raise OutputError(f"{path}: an mp4 film needs the program ffmpeg, which is not installed; .gif does not")
    write_whole(path, lambda partial: fill_mp4(partial, pictures, rate))


def fill_mp4(path: Path, pictures: Iterable[NDArray[np.uint8]], rate: float) -> None:
    """Let ffmpeg take the pictures one by one; raises OutputError where it gives up."""
    each_one = iter(pictures)
    first = next(each_one)
    height, width, _ = first.shape
    taken = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{rate:g}", "-i", "-"]
    made = ["-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4", str(path)]
    words = ["ffmpeg", "-y", "-loglevel", "error", *taken, *made]
    with Popen(words, stdin=PIPE, stdout=DEVNULL, stderr=PIPE) as program:
        assert program.stdin is not None
        try:
            for each in chain([first], each_one):
                program.stdin.write(each.tobytes())
        except BrokenPipeError:
            pass  # ffmpeg gave up, its message says why
        _, said = program.communicate()
    if program.returncode:
        lines = said.decode(errors="replace").split("\n")
        raise OutputError(f"ffmpeg cannot make the film: {next(filter(None, lines), f'status {program.returncode}')}")
