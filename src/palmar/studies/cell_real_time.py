"""Seeded trials of the 3-D cell in real time, one after the other: each has three processes of its own."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from palmar.models.cell_messages import EyeKind
from palmar.models.salisbury_hand import SalisburyHand
from palmar.studies.cell_trials import CellReport, Trials, rendered
from palmar.worlds.mujoco.cell.real_time import RealTimeTrial, run_in_real_time


def run_trials_in_real_time(trials: Trials, report: Callable[[int], None] | None = None) -> CellReport:
    """Run them all; the same trials as in lock-step, but what the processes' timing does to them is not repeatable."""
    found = []
    for k in range(trials.number):
        found.append(run_one_in_real_time(trials, k))
        if report is not None:
            report(k + 1)
    return CellReport(trials, tuple(each.result for each in found), tuple(each.timing for each in found))


def run_one_in_real_time(trials: Trials, k: int) -> RealTimeTrial:
    """Trial number ``k``."""
    hand, settings = SalisburyHand(), trials.settings(k)
    looking = partial(rendered, hand, trials.task, settings) if trials.eye is EyeKind.CAMERA else None
    return run_in_real_time(hand, trials.task, settings, trials.error, looking)
