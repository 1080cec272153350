"""Recorded pushes: read them, predict where each ends, and say how far off the prediction is.

A file of pushes is CSV with a header. Needed columns (metres, radians, table frame): x0_m, y0_m, theta0_rad, the pose
of the object's frame before the push; tip_x0_m, tip_y0_m, tip_x1_m, tip_y1_m, the pusher's centre at both ends of a
straight path. Optional: shape, a name; x1_m, y1_m, theta1_rad, the pose after the push.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable
from dataclasses import dataclass
from math import isfinite, pi
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from palmar.errors import InputError
from palmar.mechanics.pushing.push import Pushed, Pusher, push
from palmar.mechanics.pushing.slider import Slider
from palmar.models.quantity import LARGEST_LENGTH
from palmar.models.text_file import read_text

Floats = NDArray[np.float64]
BEFORE = ("x0_m", "y0_m", "theta0_rad")
AFTER = ("x1_m", "y1_m", "theta1_rad")
PATH = ("tip_x0_m", "tip_y0_m", "tip_x1_m", "tip_y1_m")
LARGEST_ANGLE = 1e4
LARGEST_FILE = 200_000_000


@dataclass(frozen=True)
class RecordedPushes:
    """One row a push: shapes (names, "" if the file has none), poses before and after (N, 3), pusher paths (N, 4)."""

    shapes: tuple[str, ...]
    starts: Floats
    ends: Floats | None
    paths: Floats

    def __len__(self) -> int:
        """The number of pushes."""
        return len(self.starts)

    def rows(self, index: NDArray[np.int_]) -> RecordedPushes:
        """Some of the pushes."""
        shapes = tuple(self.shapes[i] for i in index)
        return RecordedPushes(
            shapes, self.starts[index], None if self.ends is None else self.ends[index], self.paths[index]
        )

    def of(self, shape: str) -> RecordedPushes:
        """The pushes of one shape."""
        return self.rows(np.flatnonzero([each == shape for each in self.shapes]))


@dataclass(frozen=True)
class EndErrors:
    """Distance (m) and angle (rad, at most pi) between predicted and recorded end, per push."""

    position: Floats
    angle: Floats


def read_pushes(path: Path) -> RecordedPushes:
    """Read a file of pushes; raises InputError naming the line and column that is wrong."""
    rows = csv.reader(read_text(path, LARGEST_FILE).splitlines(), strict=True)
    try:
        table = [(rows.line_num, row) for row in rows if any(cell.strip() for cell in row)]
    except csv.Error as error:
        raise InputError(f"{path}: line {rows.line_num}", None, f"is not CSV: {error}") from None
    if not table:
        raise InputError(str(path), None, f"is empty; the first line must name the columns {', '.join(BEFORE + PATH)}")
    header = [name.strip() for name in table[0][1]]
    with_ends = any(name in header for name in AFTER)
    needed = BEFORE + PATH + (AFTER if with_ends else ())
    for name in needed:
        if header.count(name) != 1:
            what = "is missing" if name not in header else "stands there twice"
            raise InputError(f"{path}: column {name}", None, f"{what}; needed are {', '.join(needed)}")
    places = [header.index(name) for name in needed]
    shape = header.index("shape") if "shape" in header else None
    shapes, values = [], np.empty((len(table) - 1, len(needed)))
    for k, (line, row) in enumerate(table[1:]):
        if len(row) != len(header):
            raise InputError(
                f"{path}: line {line}", f"{len(row)} values", f"must have {len(header)}, as the header has"
            )
        values[k] = [_number(row[place], name, path, line) for name, place in zip(needed, places, strict=True)]
        shapes.append("" if shape is None else row[shape].strip())
    ends = values[:, 7:].copy() if with_ends else None
    return RecordedPushes(tuple(shapes), values[:, :3].copy(), ends, values[:, 3:7].copy())


def predict(slider: Slider, pusher: Pusher, recorded: RecordedPushes) -> Pushed:
    """Where each recorded push ends according to the mechanics; only starts and paths are looked at."""
    return push(slider, pusher, recorded.starts, recorded.paths)


def end_errors(poses: Floats, ends: Floats) -> EndErrors:
    """Errors of predicted ``poses`` (N, 3) against recorded ``ends`` (N, 3)."""
    return EndErrors(np.hypot(*(poses - ends)[:, :2].T), np.abs(wrapped(poses[:, 2] - ends[:, 2])))


def wrapped(angles: Floats) -> Floats:
    """Angles (rad) brought into [-pi, pi)."""
    turned: Floats = (angles + pi) % (2.0 * pi) - pi
    return turned


def mean_errors(errors: Iterable[EndErrors]) -> tuple[float, float]:
    """Mean over objects of the mean errors per object: (m, rad)."""
    means = [(each.position.mean(), each.angle.mean()) for each in errors]
    position, angle = np.mean(means, axis=0)
    return float(position), float(angle)


def _number(text: str, name: str, path: Path, line: int) -> float:
    """A finite number within the bounds of its kind."""
    where, bound = f"{path}: line {line}, {name}", LARGEST_ANGLE if name.endswith("rad") else LARGEST_LENGTH
    try:
        value = float(text)
    except ValueError:
        raise InputError(where, repr(text[:40]), "must be a number") from None
    if not isfinite(value) or abs(value) > bound:
        raise InputError(where, repr(text[:40]), f"must be a number between {-bound:g} and {bound:g}")
    return value
