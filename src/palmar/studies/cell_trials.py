"""Many seeded trials of one task of the 3-D cell, in lock-step simulated time, on as many processors as there are.

In each the cylinder stands or hangs somewhere else, and vision errs by a calibration error drawn uniformly from a disk. A
trial depends only on the settings, the seed and its number, not on how many processes run.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from math import cos, pi, sin, sqrt

import numpy as np

from palmar.errors import InputError, NotCoveredError
from palmar.models.cell_messages import EyeKind
from palmar.models.cell_task import ALIGN_TASK, FLOATING_TASK, TABLE_TASK, CellTask, TaskKind
from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.cell.faults import Fault, FaultKind
from palmar.worlds.cell.timed_camera import CameraSettings, Sight
from palmar.worlds.cell.timing import Timing
from palmar.worlds.mujoco.cell.cell import Cell
from palmar.worlds.mujoco.cell.settings import CellSettings
from palmar.worlds.mujoco.cell.trial import TrialResult, run_trial

TASKS = {TaskKind.TABLE: TABLE_TASK, TaskKind.FLOATING: FLOATING_TASK, TaskKind.ALIGN: ALIGN_TASK}
PLACED, SWAY = 0.020, 0.010
"""The cylinder is within so much (m) of its task's place, or passes its rest position with up to so much (m/s)."""
FAULT_WITHIN = {TaskKind.TABLE: 7.0, TaskKind.FLOATING: 5.0, TaskKind.ALIGN: 8.0}
"""A fault sets in at a time drawn uniformly from 0 to this (s)."""


@dataclass(frozen=True)
class Trials:
    """``error``: radius (m) of the disk of vision's calibration error, which the behaviour knows; ``exact``: it errs by
    just so much, in any direction; ``tension_noise`` (N), ``latency`` (s) of vision, ``turn`` (rad) of the wrist,
    ``eye``: a camera that is rendered, or one made of the true pose.
    """

    kind: TaskKind
    number: int
    seed: int = 0
    error: float = 0.005
    exact: bool = False
    tension_noise: float = 2.0
    latency: float = 0.040
    turn: float = 0.0
    fault: FaultKind = FaultKind.NONE
    eye: EyeKind = EyeKind.POSE

    def __post_init__(self) -> None:
        if self.number < 1 or self.seed < 0:
            raise InputError("cell", f"{self.number} trials, seed {self.seed}", "must be at least 1 and at least 0")

    @property
    def task(self) -> CellTask:
        """With its cylinder."""
        return TASKS[self.kind]

    def settings(self, k: int) -> CellSettings:
        """Of trial number ``k``."""
        random = np.random.default_rng([self.seed, k])
        one, two, three, share, way, when = random.random(6).tolist()
        error = self.error * (1.0 if self.exact else sqrt(share))
        floating = self.kind is TaskKind.FLOATING
        away = PLACED * sqrt(one) * (0.0 if floating else 1.0)
        speed = SWAY * three if floating else 0.0
        angle = 2.0 * pi * two
        return CellSettings(
            seed=int(random.integers(2**31)),
            offset=(away * cos(angle), away * sin(angle)),
            sway=(speed * cos(angle), speed * sin(angle)),
            camera=CameraSettings(
                latency=self.latency, bias=(error * cos(2.0 * pi * way), error * sin(2.0 * pi * way))
            ),
            tension_noise=self.tension_noise,
            turn=self.turn,
            fault=Fault(self.fault, FAULT_WITHIN[self.kind] * when),
        )


@dataclass(frozen=True)
class CellReport:
    """What came of all trials, in order; ``timings``: of those in real time, empty in lock-step."""

    trials: Trials
    results: tuple[TrialResult, ...]
    timings: tuple[Timing | None, ...] = ()

    @property
    def success(self) -> int:
        """How many carried and held the cylinder."""
        return sum(each.success for each in self.results)

    @property
    def unsafe(self) -> int:
        """How many were unsafe in any way."""
        return sum(bool(each.unsafe) for each in self.results)

    @property
    def failures(self) -> dict[str, int]:
        """How often each reason for no success, the commonest first."""
        return dict(Counter(each.outcome for each in self.results if not each.success).most_common())

    @property
    def approaches(self) -> dict[int, int]:
        """In how many trials that succeeded so many approaches were made."""
        return dict(sorted(Counter(each.approaches for each in self.results if each.success).items()))

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds per second of one process; in real time, of the run itself without its start."""
        return sum(each.seconds for each in self.results) / max(sum(each.wall for each in self.results), 1e-9)

    @property
    def kept(self) -> tuple[Timing, ...]:
        """Timings of those trials in real time that came to an end of their own."""
        return tuple(each for each in self.timings if each is not None)


def run_trials(
    trials: Trials, executor: Executor | None = None, report: Callable[[int], None] | None = None
) -> CellReport:
    """Run them all."""
    asked = [(trials, k) for k in range(trials.number)]
    found = map(run_one, asked) if executor is None else executor.map(run_one, asked)
    results = []
    for each in found:
        results.append(each)
        if report is not None:
            report(len(results))
    return CellReport(trials, tuple(results))


def run_one(asked: tuple[Trials, int], watch: Callable[[Cell], None] | None = None) -> TrialResult:
    """Trial number k; ``watch`` is called at every request of the arm. Raises NotCoveredError as ``rendered`` does."""
    trials, k = asked
    hand, settings = SalisburyHand(), trials.settings(k)
    sight = rendered(hand, trials.task, settings) if trials.eye is EyeKind.CAMERA else None
    return run_trial(hand, trials.task, settings, trials.error, watch, sight=sight)


def rendered(hand: SalisburyHand, task: CellTask, settings: CellSettings) -> Sight:
    """A rendered camera; raises NotCoveredError where nothing can be rendered, or OpenCV is missing."""
    from palmar.worlds.mujoco.cell.rendered_camera import RenderedCamera  # its OpenCV is needed by nothing else

    return RenderedCamera(hand, task, settings).sight


def eye_here(wanted: EyeKind) -> tuple[EyeKind, str | None]:
    """What this machine can see with instead of what is wanted, and why; None where it can."""
    if wanted is EyeKind.CAMERA:
        try:
            rendered(SalisburyHand(), TABLE_TASK, CellSettings())
        except NotCoveredError as error:
            return EyeKind.POSE, f"simulated-pose camera instead of the rendered one: {error}"
    return wanted, None
