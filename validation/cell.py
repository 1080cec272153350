"""The 3-D cell's tables: success against vision's error, tension noise, latency and wrist turn, and fault runs.

    python3 dev.py validate cell [TRIALS [SEED [PART ...]]]

TRIALS of each setting (200), and of each fault a tenth of them. Parts: table, floating, noise, latency, turn, faults; all
by default. A setting takes 5 to 10 minutes of processor time for 200 trials.
"""

from __future__ import annotations

import sys
from concurrent.futures import Executor, ProcessPoolExecutor
from dataclasses import replace
from functools import lru_cache
from math import radians

from palmar.models.cell_task import TaskKind
from palmar.models.salisbury_hand import SalisburyHand
from palmar.studies.cell_prediction import Predicted, against, predict
from palmar.studies.cell_trials import TASKS, CellReport, Trials, run_trials
from palmar.worlds.cell.faults import FaultKind

ERRORS = {
    TaskKind.TABLE: (0.0, 0.010, 0.020, 0.030, 0.040, 0.050, 0.060),
    TaskKind.FLOATING: (0.0, 0.010, 0.020, 0.030, 0.040, 0.060),
}
NOISES = (0.5, 5.0, 10.0, 20.0)
LATENCIES = (0.010, 0.100, 0.190, 0.250)
TURNS = (0.0, 10.0, 20.0)
FIXED = 0.015
"""Vision's error (m) where something else varies."""


@lru_cache
def predicted(kind: TaskKind) -> tuple[Predicted, ...]:
    """What is promised of a task; nothing where a tall cylinder is taken from the side."""
    return () if kind is TaskKind.ALIGN else predict(SalisburyHand(), TASKS[kind])


def beside(report: CellReport) -> str:
    """The region's prediction beside the trials."""
    found = against(report, predicted(report.trials.kind))
    inside = f"{found.inside} inside: {found.lost_inside} lost, {found.more_inside} in more" if found.inside else ""
    outside = f"{found.outside} outside: {found.caught_outside} caught" if found.outside else ""
    return "; ".join(each for each in (inside, outside) if each)


def line(name: str, report: CellReport) -> str:
    """One setting as a row of a table."""
    number = report.trials.number
    approaches = ", ".join(f"{count} in {k}" for k, count in report.approaches.items())
    failures = ", ".join(f"{count} {why}" for why, count in report.failures.items()) or "none"
    worst = max(each.object_force for each in report.results)
    return (
        f"| {name} | {report.success}/{number} | {approaches} | {failures} | {beside(report)} | {report.unsafe}"
        f" | {worst:.0f} |"
    )


def settings(number: int, seed: int, parts: set[str]) -> list[tuple[str, Trials]]:
    """Every setting that is asked for, with its name."""
    asked = []
    for kind, errors in ERRORS.items():
        if kind.value in parts:
            asked += [
                (f"{kind.value}, vision errs by {1e3 * e:g} mm", Trials(kind, number, seed, e, exact=True))
                for e in errors
            ]
    base = Trials(TaskKind.TABLE, number, seed, FIXED, exact=True)
    if "noise" in parts:
        asked += [(f"table, 15 mm, tension noise {n:g} N", replace(base, tension_noise=n)) for n in NOISES]
    if "latency" in parts:
        asked += [(f"table, 15 mm, latency {1e3 * t:g} ms", replace(base, latency=t)) for t in LATENCIES]
        asked += [
            (f"floating, latency {1e3 * t:g} ms", Trials(TaskKind.FLOATING, number, seed, latency=t)) for t in LATENCIES
        ]
    if "turn" in parts:
        asked += [
            (f"floating, wrist turned {t:g} deg", Trials(TaskKind.FLOATING, number, seed, turn=radians(t)))
            for t in TURNS
        ]
    if "faults" in parts:
        few = max(1, number // 10)
        asked += [
            (f"{kind.value}, {fault.value}", Trials(kind, few, seed, fault=fault))
            for fault in FaultKind
            if fault is not FaultKind.NONE
            for kind in TaskKind
        ]
    return asked


def tell(asked: list[tuple[str, Trials]], pool: Executor) -> int:
    """Run and print each; how many trials were unsafe."""
    print("| setting | success | of these in so many approaches | failures | predicted | unsafe | most force, N |")
    print("|---|---|---|---|---|---|---|")
    unsafe = 0
    for name, trials in asked:
        report = run_trials(trials, pool)
        unsafe += report.unsafe
        print(line(name, report), flush=True)
    return unsafe


def main(words: list[str]) -> int:
    """All tables; status 1 if any trial was unsafe."""
    number, seed = (int(words[k]) if len(words) > k else value for k, value in enumerate((200, 1)))
    parts = set(words[2:]) or {"table", "floating", "noise", "latency", "turn", "faults"}
    with ProcessPoolExecutor() as pool:
        return int(tell(settings(number, seed, parts), pool) > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
