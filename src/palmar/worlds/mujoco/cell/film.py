"""Pictures of a running cell, for people."""

from __future__ import annotations

from dataclasses import dataclass, field

from palmar.worlds.mujoco.cell.cell import Cell
from palmar.worlds.mujoco.cell.renderer import Picture, Renderer

EVERY = 3
"""Requests of the arm between two pictures: 84 ms."""


@dataclass
class Film:
    """Call it at every request of the arm; ``pictures`` are RGB (height, width, 3)."""

    size: tuple[int, int] = (360, 480)
    pictures: list[Picture] = field(default_factory=list)
    renderer: Renderer | None = None
    count: int = 0

    def __call__(self, cell: Cell) -> None:
        """Take a picture if one is due; raises NotCoveredError where nothing can be rendered."""
        if self.renderer is None:
            self.renderer = Renderer(cell.model, "film", self.size)
        if self.count % EVERY == 0:
            self.pictures.append(self.renderer.picture(cell.data))
        self.count += 1
