"""What became of a trial, by the truth that no behaviour sees; and whether anything was unsafe."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from palmar.models.cell_task import TaskKind
from palmar.worlds.mujoco.cell.cell import Cell
from palmar.worlds.mujoco.engine import mujoco

Floats = NDArray[np.float64]
FAR, HELD, DRIFT = 0.095, 2.0, 0.010
"""Success: carried so far (m) for so long (s) without moving so much (m) in the hand."""
TOPPLED = 0.5
"""Tilt (rad)."""
TABLE_FORCE, OBJECT_FORCE, FASTEST, CREEP = 60.0, 150.0, 0.8, 0.01
"""Unsafe above: force (N) on the table, on the object; speed (m/s) of the palm; speed (m/s) at the end."""


@dataclass
class Judge:
    """Watches one cell; ``faults`` are unsafe things seen."""

    cell: Cell
    faults: set[str] = field(default_factory=set)
    since: float | None = None
    raised: float = 0.0
    longest: float = 0.0
    table_force: float = 0.0
    object_force: float = 0.0

    def __post_init__(self) -> None:
        model = self.cell.model
        self.start = self.cell.data.xpos[self.cell.object].copy()
        self.palm = model.body("hand").id
        self.thing = model.geom("object").id
        self.table = model.geom("table").id if self.cell.task.kind is not TaskKind.FLOATING else -1
        self.mark = np.zeros(3)

    def look(self) -> None:
        """Take note of the present moment."""
        data = self.cell.data
        carried = data.xpos[self.cell.object] - self.start
        in_hand = data.xmat[self.palm].reshape(3, 3).T @ (data.xpos[self.cell.object] - data.xpos[self.palm])
        on_table = self.cell.task.kind is not TaskKind.FLOATING
        self.raised = float(carried[2]) if on_table else float(np.linalg.norm(carried))
        if self.raised < FAR or (self.since is not None and np.linalg.norm(in_hand - self.mark) > DRIFT):
            self.since = None
        elif self.since is None:
            self.since, self.mark = self.cell.time, in_hand
        if self.since is not None:
            self.longest = max(self.longest, self.cell.time - self.since)
        if self.speed > FASTEST:
            self.faults.add(f"moved faster than {FASTEST:g} m/s")

    def feel(self) -> None:
        """Take note of the contact forces of the last servo tick: what the hand presses the table and the object with."""
        data = self.cell.data
        touching = data.contact.geom == self.thing
        on_thing, on_table = touching.any(axis=1), (data.contact.geom == self.table).any(axis=1)
        if not (data.contact.efc_address >= 0).any():
            return
        normal = np.where(data.contact.efc_address >= 0, data.efc_force[data.contact.efc_address], 0.0)
        self.table_force = max(self.table_force, float(normal[on_table & ~on_thing].sum()))
        self.object_force = max(self.object_force, float(normal[on_thing & ~on_table].sum()))

    def weigh(self) -> None:
        """Whether any of those forces was unsafe."""
        if self.table_force > TABLE_FORCE:
            self.faults.add(f"pressed the table with more than {TABLE_FORCE:g} N")
        if self.object_force > OBJECT_FORCE:
            self.faults.add(f"pressed the object with more than {OBJECT_FORCE:g} N")

    @property
    def speed(self) -> float:
        """Of the palm (m/s)."""
        velocity = np.zeros(6)
        mujoco.mj_objectVelocity(self.cell.model, self.cell.data, mujoco.mjtObj.mjOBJ_BODY, self.palm, velocity, 0)
        return float(np.linalg.norm(velocity[3:]))

    @property
    def tilt(self) -> float:
        """Of the cylinder's axis from the vertical (rad)."""
        return float(np.arccos(np.clip(self.cell.data.xmat[self.cell.object][8], -1.0, 1.0)))

    @property
    def success(self) -> bool:
        """Whether it has been carried and held long enough, and still is."""
        return self.since is not None and self.cell.time - self.since >= HELD
