"""``palmar behaviours chance``: how often a behaviour that tracks a free disk catches it from one start."""

from __future__ import annotations

from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import cpu_count, get_context
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from palmar.errors import InputError
from palmar.faces.cli.behaviour_options import (
    Layout,
    Named,
    Number,
    Track,
    Velocity,
    placed,
    tracker_of,
    with_behaviour,
    with_velocity,
    within,
)
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, show
from palmar.faces.cli.texts import table, titled
from palmar.mechanics.batch import allot
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.studies.matched_capture import MatchedCapture

MOST_RUNS, FEW = 1_000_000, 40


def chance(
    case: CaseName,
    *,
    behaviour: Named = None,
    start: Annotated[str | None, Parameter(help="X_MM,Y_MM; else the case's.", allow_leading_hyphen=True)] = None,
    velocity: Velocity = None,
    sensors: Layout = None,
    track: Track = None,
    runs: Annotated[int, Parameter(help="How many, each with its own draw of the tracker's errors.")] = 100,
    seed: Annotated[int, Parameter(help="Of the first draw.")] = 0,
    tick: Annotated[Number, Parameter(help="Time between two observations in ms.")] = "20",
    json: AsJson = False,
    check: Check = False,
) -> None:
    """How often a behaviour that tracks a free disk catches it: runs from one start, each with its own tracking errors."""
    from palmar.studies.matched_capture import matched_capture

    name, given = open_case(case)
    given = placed(with_velocity(with_behaviour(given, behaviour, sensors), velocity), start)
    if not 0 <= seed < 2**32:
        raise InputError("--seed", str(seed), f"must be from 0 to {2**32 - 1}")
    if not 1 <= runs <= MOST_RUNS:
        raise InputError("--runs", str(runs), f"must be from 1 to {MOST_RUNS}")
    seconds = 1e-3 * within("--tick", tick, 1.0, 1000.0)
    tracker = tracker_of(track, seed)
    if tracker is None:
        raise InputError("--track", "absent", "it says how late the object is tracked, and with which errors")
    with _pool(runs) as pool:
        found = matched_capture(given, tracker, runs, pool, seconds)
    said = (
        f"{given.behaviour.name.value}: {found.caught} of {found.runs} runs catch; the chance is {found.low:.3f} to"
        f" {found.high:.3f} (95 % confidence)."
    )
    rows = [(str(count), why) for why, count in found.ends]
    show(titled(name, given, said, "How the runs ended:", table(rows)), _record(found), json)
    answer(found.caught == found.runs, check)


def _pool(runs: int) -> Executor:
    """Processes for many runs; for few that would take longer."""
    if runs <= FEW:
        return ThreadPoolExecutor(1)
    # A fresh interpreter for each process: one forked from threads may wait forever.
    return ProcessPoolExecutor(cpu_count(), mp_context=get_context("spawn"), initializer=allot, initargs=(1,))


def _record(found: MatchedCapture) -> dict[str, Any]:
    return {
        "runs": found.runs,
        "caught": found.caught,
        "chance": {"low": found.low, "high": found.high, "confidence": 0.95},
        "ends": [{"why": why, "runs": count} for why, count in found.ends],
    }
