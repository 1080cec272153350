"""Which behaviour carries out which task of the cell."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from palmar.behaviours.cell.floating_catch import Catching, FloatingCatch
from palmar.behaviours.cell.phased import Programme
from palmar.behaviours.cell.table_pick import Picking, TablePick
from palmar.models.cell_task import CellTask, TaskKind
from palmar.models.salisbury_hand import SalisburyHand

Floats = NDArray[np.float64]


def programme_for(
    hand: SalisburyHand, task: CellTask, error: float, pose: Floats, time: float = 0.0
) -> Programme[Picking] | Programme[Catching]:
    """From a pose of the hand frame (4, 4) and a time (s) on; ``error`` (m) bounds vision's systematic error."""
    if task.kind is TaskKind.TABLE:
        pick = TablePick(hand, task.cylinder, task.place[2] + 0.5 * task.cylinder.height, error)
        return Programme(pick, pick.begin(pose, time))
    catch = FloatingCatch(hand, task.place[2], align=task.kind is TaskKind.ALIGN)
    return Programme(catch, catch.begin(pose, time))
