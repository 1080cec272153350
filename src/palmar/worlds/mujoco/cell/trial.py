"""One trial of a task in lock-step simulated time: behaviours at the arm's requests, reflexes and physics at every tick."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from palmar.behaviours.cell.sightings import OLDEST
from palmar.behaviours.cell.tasks import programme_for
from palmar.models.cell_messages import CellEnd, CellOrder, Eye, Sighting
from palmar.models.cell_task import CellTask, TaskKind
from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.cell.timed_camera import Sight
from palmar.worlds.mujoco.cell.cell import Cell
from palmar.worlds.mujoco.cell.judge import CREEP, TOPPLED, Judge
from palmar.worlds.mujoco.cell.settings import CellSettings

Floats = NDArray[np.float64]
TICKS = 28
"""Servo ticks between two requests of the arm."""
LONGEST = 120.0
"""A trial that has not ended after this (s) never will."""
AFTERWARDS = 0.3
"""How long (s) the cell is watched after its end."""
BY_ITSELF = (
    CellEnd.STOPPED,
    CellEnd.NO_FRESH_SIGHTING,
    CellEnd.SENSOR_FAULT,
    CellEnd.OUT_OF_REACH,
    CellEnd.WOULD_TOPPLE,
)
"""Ends that say why there was no success."""
DOWN = np.diag([1.0, -1.0, -1.0])
AHEAD = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
"""Rotations of the hand frame: palm down, palm forward with the cylinder's axis along the hand's x."""


@dataclass(frozen=True)
class TrialResult:
    """``outcome``: success, or why not; ``end``: the behaviour's own account; ``unsafe``: what was; times in s."""

    outcome: str
    end: str
    unsafe: tuple[str, ...]
    approaches: int
    error: float
    seconds: float
    wall: float
    requests: int
    missed: int
    table_force: float
    object_force: float
    trace: tuple[tuple[float, str], ...]
    phases: tuple[tuple[float, str], ...]

    @property
    def success(self) -> bool:
        """Whether the cylinder was carried and held."""
        return self.outcome == "success"


def start_pose(hand: SalisburyHand, task: CellTask, turn: float = 0.0) -> Floats:
    """Of the hand frame (4, 4) before a task: off to one side, above the cylinder or before it."""
    pose = np.eye(4)
    x, y, z = task.place
    if task.kind is TaskKind.TABLE:
        pose[:3, :3] = DOWN
        pose[:3, 3] = x - 0.05, y + 0.08, z + 0.5 * task.cylinder.height + 0.20
    else:
        cosine, sine = np.cos(turn), np.sin(turn)
        pose[:3, :3] = AHEAD @ np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
        pose[:3, 3] = x - 0.22, y - hand.grasp_line - 0.03, z
    return pose


def run_trial(
    hand: SalisburyHand,
    task: CellTask,
    settings: CellSettings,
    error: float = 0.0,
    watch: Callable[[Cell], None] | None = None,
    eye: Eye | None = None,
    sight: Sight | None = None,
) -> TrialResult:
    """Carry out one trial; ``watch`` is called at every request of the arm; ``eye``, ``sight``: as the cell's."""
    began = perf_counter()
    cell = Cell(hand, task, settings, start_pose(hand, task, settings.turn), eye, sight)
    programme, judge = programme_for(hand, task, error, cell.pose), Judge(cell)
    end: CellEnd | None = None
    left, phases = int(AFTERWARDS / 0.028), [(0.0, programme.state.phase.value)]
    while cell.time < LONGEST and left > 0:
        if end is None or end is CellEnd.HOLDS:
            before = programme.state.path.pose
            order = programme.step(cell.seen())
            cell.order = order.hand
            check_sight(judge, order, before, cell.sighting, cell.time)
            end = order.end
            if order.why != phases[-1][1]:
                phases.append((cell.time, order.why))
        left -= end is not None
        if end is not None and end is not CellEnd.HOLDS:
            cell.stopped = cell.stopped or end.value  # a hand that still closes stops
        if not cell.reply(programme.state.path.pose):
            end = CellEnd.OUT_OF_REACH
        for _ in range(TICKS):
            cell.tick()
            judge.feel()
        judge.look()
        if watch is not None:
            watch(cell)
    return result_of(cell, judge, end, programme.state.approaches, phases, perf_counter() - began)


def check_sight(judge: Judge, order: CellOrder, before: Floats, latest: Sighting | None, now: float) -> None:
    """The arm must not move by vision without a sighting that is fresh at a time (s); ``before``: its last set-point."""
    moved = float(np.abs(order.palm_pose - before).max()) > 1e-9
    if order.guided and moved and (latest is None or now - latest.stamp_s > OLDEST + 0.028):
        judge.faults.add("moved by a stale sighting")


def result_of(
    cell: Cell, judge: Judge, end: CellEnd | None, approaches: int, phases: list[tuple[float, str]], wall: float
) -> TrialResult:
    """What came of a trial that took ``wall`` seconds."""
    if end is None:
        judge.faults.add("never ended")
    judge.weigh()
    if judge.speed > CREEP:
        judge.faults.add("moved after its end")
    bias = cell.settings.camera.bias
    return TrialResult(
        "success" if judge.success else _why(judge, end),
        "none" if end is None else end.value,
        tuple(sorted(judge.faults)),
        approaches,
        float(np.hypot(*bias)),
        cell.time,
        wall,
        cell.link.asked,
        cell.link.missed,
        judge.table_force,
        judge.object_force,
        tuple((time, owner.value) for time, owner in cell.trace),
        tuple(phases),
    )


def _why(judge: Judge, end: CellEnd | None) -> str:
    """Why a trial was no success, for people."""
    if end is None:
        return "timeout"
    if end in BY_ITSELF:
        return str(end.value)
    if end in (CellEnd.LOST_GRIP, CellEnd.HOLDS):
        return "slipped"
    if judge.cell.task.kind is not TaskKind.FLOATING and judge.tilt > TOPPLED:
        return "toppled"
    if end is CellEnd.OUT_OF_APPROACHES:
        return "out of approaches"
    return "missed"
