"""Messages between the server and its workers."""

from __future__ import annotations

import struct
from enum import Enum

LENGTH = struct.Struct(">I")


class Tag(Enum):
    """What a worker says."""

    READY = b"r"
    PART = b"p"
    FILE = b"f"
    DONE = b"d"
    ERROR = b"e"
    LEAVING = b"l"
    """After this job it ends."""
    COMPILING = b"c"
    COMPILED = b"k"


def packed(tag: Tag, data: bytes = b"") -> bytes:
    """What a worker sends: length, tag, data."""
    return LENGTH.pack(1 + len(data)) + tag.value + data
