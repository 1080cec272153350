"""The option ``--device``: what carries the starts of a batch."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

from palmar.models.device import Device

Processor = Annotated[
    Literal["cpu", "gpu"],
    Parameter(help="What carries the starts: this machine's processors, or its CUDA device (the extra gpu)."),
]


def device_of(name: str) -> Device:
    """The device of that name; raises NotCoveredError where it is a GPU and none can be used."""
    device = Device(name)
    if device is Device.GPU:
        from palmar.worlds.planar.on_gpu import refuse_without_gpu

        refuse_without_gpu()
    return device
