"""What carries the starts of a batch."""

from __future__ import annotations

from enum import Enum


class Device(Enum):
    """The processors of this machine, or its CUDA device: the same mechanics, rounded a little differently."""

    CPU = "cpu"
    GPU = "gpu"
