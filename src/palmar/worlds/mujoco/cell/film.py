"""Pictures of a running cell, rendered off the screen where the machine can do that."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.errors import NotCoveredError
from palmar.worlds.mujoco.cell.cell import Cell
from palmar.worlds.mujoco.engine import mujoco

Picture = NDArray[np.uint8]
WAYS = ("egl", "osmesa")
EVERY = 3
"""Requests of the arm between two pictures: 84 ms."""


@dataclass
class Film:
    """Call it at every request of the arm; ``pictures`` are RGB (height, width, 3)."""

    size: tuple[int, int] = (360, 480)
    pictures: list[Picture] = field(default_factory=list)
    renderer: Any = None
    count: int = 0

    def __call__(self, cell: Cell) -> None:
        """Take a picture if one is due; raises NotCoveredError where nothing can be rendered."""
        if self.renderer is None:
            self.renderer = _renderer(cell, self.size)
        if self.count % EVERY == 0:
            self.renderer.update_scene(cell.data, "film")
            self.pictures.append(self.renderer.render().copy())
        self.count += 1

    def close(self) -> None:
        """Give the context back."""
        if self.renderer is not None:
            self.renderer.close()
            self.renderer = None


def _renderer(cell: Cell, size: tuple[int, int]) -> Any:
    """Through EGL, or else OSMesa; ``MUJOCO_GL``, where set, names the only way to be tried."""
    asked = os.environ.get("MUJOCO_GL")
    for way in (asked,) if asked else WAYS:
        os.environ["MUJOCO_GL"] = way
        try:
            return mujoco.Renderer(cell.model, *size)
        except Exception:  # whatever a graphics stack raises, the next way is tried
            continue
        finally:
            if asked is None:
                os.environ.pop("MUJOCO_GL", None)
    raise NotCoveredError(
        "nothing can be rendered off the screen here: install the packages libegl1, libgl1 and libgl1-mesa-dri"
    )
