"""The 3-D cell in real time: what becomes of it when something fails, and how well it keeps its times.

    python3 dev.py validate cell_faults [RUNS [SEED [JOBS]]]

RUNS of each kind of fault (20), half of them at the table, half in the air. In every second one the fault sets in at any
time, in the others while the hand grasps, lifts or holds. And as many without a fault. JOBS runs at a time (1), each with
three processes; leave the machine alone meanwhile. Takes about 9 s a run and job: 20 runs of each with 2 jobs, 16 minutes.
Every run is written to build/cell_faults_SEED.jsonl as it ends, and what stands there is not run again: interrupt it as
you like.
"""

from __future__ import annotations

import json
import os
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from palmar.models.cell_task import TaskKind
from palmar.models.salisbury_hand import SalisburyHand
from palmar.studies.cell_trials import Trials
from palmar.worlds.cell.faults import Fault, FaultKind
from palmar.worlds.cell.process import ONE_THREAD
from palmar.worlds.cell.timing import percentiles
from palmar.worlds.mujoco.cell.real_time import run_in_real_time

KINDS = [each for each in FaultKind if each is not FaultKind.NONE]
GRASP_S = {"table": (5.0, 8.0), "floating": (2.2, 6.0)}
"""When (s) a trial without a fault grasps, lifts and holds."""
IN_GRASP = {"close", "lift", "hold", "stop the arm", "carry away"}
Run = dict[str, Any]


def run(fault: str, task: str, k: int, seed: int) -> Run:
    """One run, as it is written down; times in s, how late ticks were in whole microseconds."""
    trials = Trials(TaskKind(task), k + 1, seed, fault=FaultKind(fault))
    settings = trials.settings(k)
    if k % 2:
        start = float(np.random.default_rng([seed, k, 1]).uniform(*GRASP_S[task]))
        settings = replace(settings, fault=Fault(trials.fault, start))
    trial = run_in_real_time(SalisburyHand(), trials.task, settings, trials.error)
    result, timing = trial.result, trial.timing
    found: Run = {"fault": fault, "task": task, "k": k, "outcome": result.outcome, "end": result.end}
    found |= {"unsafe": list(result.unsafe), "missed": result.missed, "seconds": result.seconds, "wall": result.wall}
    if timing is None:
        return found | {"late_us": [], "replies_us": []}
    at = timing.fault_s
    phase = None if at is None else ([what for when, what in result.phases if when <= at] or [None])[-1]
    return found | {
        "fault_s": at, "phase": phase, "at_rest": timing.at_rest, "slipped": timing.slipped, "rank": timing.ranked,
        "sightings": timing.sightings.model_dump(),
        "late_us": np.round(1e6 * timing.late).astype(int).tolist(),
        "replies_us": np.round(1e6 * timing.replies).astype(int).tolist(),
    }  # fmt: skip


def missing(log: Path, runs: int) -> tuple[list[tuple[str, str, int]], list[Run]]:
    """What is still to be run, and what was: the lines of the log."""
    known = [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []
    done = {(each["fault"], each["task"], each["k"]) for each in known}
    tasks = [("table", k) for k in range((runs + 1) // 2)] + [("floating", k) for k in range(runs // 2)]
    wanted = [(fault.value, task, k) for fault in (FaultKind.NONE, *KINDS) for task, k in tasks]
    return [each for each in wanted if each not in done], [
        each for each in known if (each["fault"], each["task"], each["k"]) in wanted
    ]


def fault_table(found: list[Run]) -> None:
    """Kind by kind: how runs ended, and how long after the fault the cell was at rest, if it ended by it."""
    print("| fault | runs | set in before the end | of these in the grasp | ended | at rest after, median and longest |"
          " unsafe |\n|---|---|---|---|---|---|---|")  # fmt: skip
    for kind in (FaultKind.NONE, *KINDS):
        runs = [each for each in found if each["fault"] == kind.value]
        hit = [each for each in runs if each.get("fault_s") is not None]
        grasped = sum(each["phase"] in IN_GRASP for each in hit)
        ends = ", ".join(f"{count} {what}" for what, count in Counter(each["outcome"] for each in runs).most_common())
        rest = [
            each["at_rest"] - each["fault_s"]
            for each in hit
            if each["outcome"] != "success" and each["at_rest"] is not None and each["at_rest"] >= each["fault_s"]
        ]
        told = f"{np.median(rest):.2f} s, {max(rest):.2f} s" if rest else "none"
        unsafe = Counter(what for each in runs for what in each["unsafe"])
        bad = ", ".join(f"{count} {what}" for what, count in unsafe.items()) or "0"
        print(f"| {kind.value} | {len(runs)} | {len(hit)} | {grasped} | {ends} | {told} | {bad} |")


def timing_table(found: list[Run]) -> None:
    """All runs together."""
    seconds, wall = (sum(each[name] for each in found) for name in ("seconds", "wall"))
    slipped = sum(each.get("slipped", 0.0) for each in found)
    print(f"\n{len(found)} runs, {seconds:.0f} s simulated in {wall:.0f} s: {seconds / wall:.4f} times real time;")
    print(f"ticks put off by {slipped:.3f} s; SCHED_FIFO in {sum(each.get('rank', False) for each in found)} runs\n")
    print("| | median | 95 % | 99 % | most |\n|---|---|---|---|---|")
    for name, key in (("servo tick late by", "late_us"), ("reply after", "replies_us")):
        values = percentiles(1e-6 * np.array(each[key], dtype=float) for each in found)
        cells = " | ".join("none" if value is None else f"{1e3 * value:.3f} ms" for value in values.values())
        print(f"| {name} | {cells} |")


def main(words: list[str]) -> int:
    """Run what is missing, print the tables; status 1 if any run was unsafe."""
    runs, seed, jobs = (int(words[k]) if len(words) > k else value for k, value in enumerate((20, 1, 1)))
    os.environ.update(ONE_THREAD)
    log = Path("build") / f"cell_faults_{seed}.jsonl"
    log.parent.mkdir(exist_ok=True)
    left, found = missing(log, runs)
    whole, pool = len(found) + len(left), ThreadPoolExecutor(jobs)
    try:
        with log.open("a") as lines:
            for done in as_completed(pool.submit(run, *each, seed) for each in left):
                found.append(done.result())
                print(json.dumps(found[-1]), file=lines, flush=True)
                print(f"{len(found)} of {whole}", end="\r", file=sys.stderr, flush=True)
    finally:
        pool.shutdown(cancel_futures=True)
    fault_table(found)
    timing_table(found)
    return int(any(each["unsafe"] for each in found))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
