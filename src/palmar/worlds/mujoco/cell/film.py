"""Pictures of a running cell, rendered off the screen where the machine can do that."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.errors import NotCoveredError
from palmar.models.cell_task import CellTask
from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.mujoco.cell.cell import Cell
from palmar.worlds.mujoco.cell.settings import CellSettings
from palmar.worlds.mujoco.cell.trial import run_trial
from palmar.worlds.mujoco.engine import mujoco

Picture = NDArray[np.uint8]
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
            try:
                self.renderer = mujoco.Renderer(cell.model, *self.size)
            except Exception as error:  # a graphics stack raises what it likes
                raise NotCoveredError(f"nothing can be rendered: {error}") from None
        if self.count % EVERY == 0:
            self.renderer.update_scene(cell.data, "film")
            self.pictures.append(self.renderer.render().copy())
        self.count += 1


def film_trial(hand: SalisburyHand, task: CellTask, settings: CellSettings, error: float) -> list[Picture]:
    """Pictures of one trial; ``MUJOCO_GL`` must have named a way to render before MuJoCo was first imported."""
    film = Film()
    run_trial(hand, task, settings, error, film)
    film.renderer.close()
    return film.pictures
