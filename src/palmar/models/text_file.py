"""A text file that someone wrote: read whole, in UTF-8, with or without a byte order mark, up to a size."""

from __future__ import annotations

from pathlib import Path

from palmar.errors import InputError

FEW_LINES = 1_000_000
"""Bytes that no file written by hand has."""


def read_text(path: Path, most: int = FEW_LINES, words: str = "") -> str:
    """The text; raises InputError in one line. ``words`` say more where the file has more than ``most`` bytes."""
    try:
        with path.open("rb") as file:
            data = file.read(most + 1)
    except OSError as error:
        raise InputError(str(path), None, f"cannot be read: {error.strerror or error}") from None
    if len(data) > most:
        raise InputError(str(path), None, f"is larger than {most} bytes{words}")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(str(path), None, f"is not text in UTF-8 (byte {error.start})") from None
