"""One trial in real time: plant, controller and vision as processes of their own, started, killed and buried here."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing import get_context, resource_tracker
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from time import monotonic
from typing import Any

import numpy as np

from palmar.models.cell_task import CellTask
from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.cell.controller import control
from palmar.worlds.cell.faults import Fault, FaultKind
from palmar.worlds.cell.pose_camera import PoseCamera
from palmar.worlds.cell.process import ONE_THREAD, environment
from palmar.worlds.cell.timed_camera import Sight
from palmar.worlds.cell.timing import Timing
from palmar.worlds.cell.transport import free_ports
from palmar.worlds.cell.vision import PoseSight, watch
from palmar.worlds.mujoco.cell.plant import ASSEMBLY, run_plant
from palmar.worlds.mujoco.cell.settings import CellSettings
from palmar.worlds.mujoco.cell.trial import LONGEST, TrialResult, start_pose

STRUCK = {
    FaultKind.CONTROLLER_KILLED: ("controller", signal.SIGKILL),
    FaultKind.CONTROLLER_HUNG: ("controller", signal.SIGSTOP),
    FaultKind.VISION_KILLED: ("vision", signal.SIGKILL),
}
"""Which process gets which signal."""
GRACE = 10.0
"""What takes so much longer (s) than it may is hung."""
FAREWELL = 2.0
"""So long (s) a process has to end by itself."""


@dataclass(frozen=True)
class RealTimeTrial:
    """What came of it, and how well it kept its times; None if the trial never came to an end of its own."""

    result: TrialResult
    timing: Timing | None


def run_in_real_time(
    hand: SalisburyHand,
    task: CellTask,
    settings: CellSettings,
    error: float = 0.0,
    make_sight: Callable[[], Sight] | None = None,
) -> RealTimeTrial:
    """Carry out one trial; ``make_sight``, called in vision's process, makes what looks: None, the true pose with noise."""
    began = monotonic()
    crew = Crew(hand, task, settings, error, make_sight or pose_sight(task, settings))
    try:
        with environment(ONE_THREAD):
            crew.start()
        epoch = crew.hear(ASSEMBLY + GRACE, all_alive=True)
        if not isinstance(epoch, float):
            return RealTimeTrial(unfinished("never started", monotonic() - began), None)
        struck = crew.strike(epoch, settings.fault)
        found = crew.hear(LONGEST + GRACE)
        if found is None:
            crew.plant.join(FAREWELL)  # its pipe closes before it is gone
            how = "hung" if crew.plant.is_alive() else "the plant's process died"
            return RealTimeTrial(unfinished(how, monotonic() - began, (how,)), None)
        result, timing = found
        return RealTimeTrial(result, replace(timing, fault_s=_set_in(settings.fault, timing, struck)))
    finally:
        crew.bury()


def pose_sight(task: CellTask, settings: CellSettings) -> Callable[[], Sight]:
    """Of the true pose, with the noise of the trial's camera."""
    return partial(
        PoseSight, PoseCamera(settings.camera, np.random.default_rng([settings.seed, 3])), task.cylinder.radius
    )


def unfinished(outcome: str, wall: float, unsafe: tuple[str, ...] = ()) -> TrialResult:
    """Of a trial that never moved, or never came to an end of its own."""
    return TrialResult(
        outcome=outcome, end="none", unsafe=unsafe, approaches=0, error=0.0, seconds=0.0, wall=wall, requests=0, missed=0,
        table_force=0.0, object_force=0.0, trace=(), phases=(),
    )  # fmt: skip


def _set_in(fault: Fault, timing: Timing, struck: float | None) -> float | None:
    """When (s) a fault set in, if the trial had not ended before."""
    at = struck if fault.kind in STRUCK else fault.start
    return at if fault.kind is not FaultKind.NONE and at is not None and at < timing.ended else None


class Crew:
    """The three processes of a trial, and the pipe on which the plant reports."""

    def __init__(
        self,
        hand: SalisburyHand,
        task: CellTask,
        settings: CellSettings,
        error: float,
        make_sight: Callable[[], Sight],
    ) -> None:
        context, ports = get_context("spawn"), free_ports()  # forked from threads a process may wait forever
        self.ear: Connection
        self.ear, self.mouth = context.Pipe(duplex=False)
        fault, pose = settings.fault, start_pose(hand, task, settings.turn)
        jobs: dict[str, tuple[Callable[..., None], tuple[Any, ...]]] = {
            "plant": (run_plant, (hand, task, settings, ports, self.mouth)),
            "controller": (control, (hand, task, error, pose, fault, ports)),
            "vision": (watch, (make_sight, settings.camera, fault, settings.seed, ports)),
        }
        self.members: dict[str, BaseProcess] = {
            name: context.Process(target=target, args=words, name=f"palmar-{name}", daemon=True)
            for name, (target, words) in jobs.items()
        }
        self.plant = self.members["plant"]

    def start(self) -> None:
        """All of them, deaf to Ctrl-C from their first instruction on: it is for the supervisor."""
        resource_tracker.ensure_running()  # it would let Ctrl-C through again as it starts
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            for each in self.members.values():
                each.start()
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        self.mouth.close()

    def hear(self, seconds: float, all_alive: bool = False) -> Any:
        """What the plant says next within so many seconds; None if nothing, or it is gone, or another where all must be."""
        others = [each.sentinel for each in self.members.values() if all_alive and each is not self.plant]
        if self.ear in wait([self.ear, *others], seconds):
            with suppress(EOFError):
                return self.ear.recv()
        return None

    def strike(self, epoch: float, fault: Fault) -> float | None:
        """Kill or stop a process at its time if the fault is of that kind; when (s), None if the trial ended before."""
        if fault.kind not in STRUCK or wait([self.ear], max(0.0, epoch + fault.start - monotonic())):
            return None
        name, how = STRUCK[fault.kind]
        pid = self.members[name].pid
        assert pid is not None
        os.kill(pid, how)
        return monotonic() - epoch

    def bury(self) -> None:
        """Nobody survives: the plant is asked to stop safely first, then everyone is killed."""
        self.ear.close()
        if self.plant.is_alive():
            self.plant.terminate()
            self.plant.join(FAREWELL)
        for each in self.members.values():
            if each.is_alive():
                each.kill()
        for each in self.members.values():
            if each.pid is not None:
                each.join()
