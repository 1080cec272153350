"""A CSV file of starts: x_mm, y_mm and, optionally, theta_deg, vx_mm_s, vy_mm_s."""

from __future__ import annotations

import csv
import math
import warnings
from pathlib import Path
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from palmar.errors import InputError

_SCALES = {"x_mm": 1e-3, "y_mm": 1e-3, "theta_deg": math.pi / 180.0, "vx_mm_s": 1e-3, "vy_mm_s": 1e-3}
LARGEST_FILE = 500_000_000


def read_starts(path: Path) -> NDArray[np.float64]:
    """Starts (N, 5) in SI; columns that are missing are 0.

    Raises InputError naming file, line and column.
    """
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise InputError(str(path), None, f"is larger than {LARGEST_FILE // 1_000_000} MB, split it")
        with path.open(newline="", encoding="utf-8") as file:
            heads = [each.strip() for each in next(csv.reader(file), [])]
            _check_heads(path, heads)
            values = _numbers(file)
        if values is None or (values.size and values.shape[1] != len(heads)) or not np.isfinite(values).all():
            raise _first_bad_line(path, heads)
    except OSError as error:
        raise InputError(str(path), None, f"cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError as error:
        raise InputError(str(path), None, f"is not text in UTF-8 (byte {error.start})") from None
    starts = np.zeros((len(values) if values.size else 0, len(_SCALES)))
    for column, (name, scale) in enumerate(_SCALES.items()):
        if name in heads and values.size:
            starts[:, column] = scale * values[:, heads.index(name)]
    return starts


def _numbers(file: TextIO) -> NDArray[np.float64] | None:
    """The rest of the file as rows of numbers, none of them where it is blank; None where it cannot be read so."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # numpy remarks on a file with a heading alone
        try:
            return np.loadtxt(file, delimiter=",", ndmin=2)
        except ValueError:
            return None


def _check_heads(path: Path, heads: list[str]) -> None:
    unknown = [each for each in heads if each not in _SCALES]
    if unknown or "x_mm" not in heads or "y_mm" not in heads or len(set(heads)) < len(heads):
        raise InputError(f"{path}: line 1", ",".join(heads)[:60], f"must name x_mm,y_mm and of {', '.join(_SCALES)}")


def _first_bad_line(path: Path, heads: list[str]) -> InputError:
    """Which line could not be read, and why."""
    with path.open(newline="", encoding="utf-8") as file:
        for line, row in enumerate(csv.reader(file), start=1):
            if line == 1 or not row:
                continue
            if len(row) != len(heads):
                return InputError(f"{path}: line {line}", None, f"has {len(row)} values, the heading {len(heads)}")
            for name, text in zip(heads, row, strict=True):
                try:
                    good = math.isfinite(float(text))
                except ValueError:
                    good = False
                if not good:
                    return InputError(f"{path}: line {line}: {name}", repr(text[:40]), "must be a finite number")
    return InputError(str(path), None, "cannot be read as numbers separated by commas")
