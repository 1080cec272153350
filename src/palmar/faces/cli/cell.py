"""``palmar cell``: the 3-D cell, a Puma with the Salisbury hand and a cylinder (chapter 7), in MuJoCo."""

from __future__ import annotations

from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cell_record import cell_record, timing_record
from palmar.faces.cli.behaviour_options import within
from palmar.faces.cli.cell_film import film, known_ending
from palmar.faces.cli.cell_theory import predict, workspace
from palmar.faces.cli.pool import Count, counting, processes
from palmar.faces.cli.printing import AsJson, Check, answer, progress, show
from palmar.faces.cli.texts import table
from palmar.models.cell_messages import EyeKind
from palmar.models.cell_task import TaskKind
from palmar.worlds.cell.faults import FaultKind

if TYPE_CHECKING:
    from palmar.studies.cell_trials import CellReport, Trials

app = App(name="cell")
app.command(predict)
app.command(workspace)
MOST_TRIALS = 100_000
EYES = {EyeKind.CAMERA: "rendered camera", EyeKind.POSE: "simulated-pose camera"}
Number = Annotated[str, Parameter(allow_leading_hyphen=True)]


@app.command
def run(
    task: Annotated[
        Literal["table", "floating", "align"],
        Parameter(help="Pick up from a table, catch in the air, or take from the side after aligning the palm."),
    ],
    *,
    trials: Annotated[int, Parameter(help="How many.")] = 20,
    seed: Annotated[int, Parameter(help="Of everything that is drawn.")] = 0,
    error_mm: Annotated[
        Number, Parameter(help="Vision's calibration error is drawn from a disk of this radius.")
    ] = "5",
    exact: Annotated[
        bool, Parameter(negative="", help="It errs by just so much, in a direction that is drawn.")
    ] = False,
    tension_noise_n: Annotated[Number, Parameter(help="Standard deviation of each tendon's tension sensor.")] = "2",
    latency_ms: Annotated[Number, Parameter(help="Of vision.")] = "40",
    turn_deg: Annotated[Number, Parameter(help="Floating and align: how far the wrist is turned from square.")] = "0",
    fault: Annotated[
        str, Parameter(help="Let one thing fail at a time that is drawn: see `palmar cell faults`.")
    ] = "none",
    real_time: Annotated[
        bool,
        Parameter(negative="", help="Plant, controller and vision as processes of their own, by the wall clock."),
    ] = False,
    eye: Annotated[
        Literal["camera", "pose"],
        Parameter(help="Render frames and find the cylinder in them, or make sightings of its true pose."),
    ] = "pose",
    view: Annotated[Path | None, Parameter(help="Also film the first trial: gif, or mp4 (needs ffmpeg).")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Seeded trials, in lock-step or in real time; success is 100 mm away and held for 2 s, by contact alone."""
    from palmar.studies.cell_trials import Trials, eye_here

    if not 1 <= trials <= MOST_TRIALS:
        raise InputError("--trials", str(trials), f"must be 1 to {MOST_TRIALS}")
    known_ending(view)
    if view is not None and real_time:
        raise InputError("--view", str(view), "films trials in lock-step; leave out --real-time")
    if seed < 0:
        raise InputError("--seed", str(seed), "must not be negative")
    fault_kind = _fault(fault)
    used, note = eye_here(EyeKind(eye))
    if note is not None:
        progress(note)
    asked = Trials(
        TaskKind(task),
        trials,
        seed,
        1e-3 * within("--error-mm", error_mm, 0.0, 200.0),
        exact,
        within("--tension-noise-n", tension_noise_n, 0.0, 100.0),
        1e-3 * within("--latency-ms", latency_ms, 0.0, 10_000.0),
        radians(within("--turn-deg", turn_deg, -30.0, 30.0)),
        fault_kind,
        used,
    )
    filmed = None if view is None else film(view, asked)
    with counting(trials, "trials") as report:
        found = _in_real_time(asked, report) if real_time else _in_lock_step(asked, report)
    show(_text(found, note, filmed), cell_record(found, note) | ({} if filmed is None else {"view": filmed}), json)
    answer(found.success == trials and not found.unsafe, check)


def _in_lock_step(asked: Trials, report: Count) -> CellReport:
    from palmar.studies.cell_trials import run_trials

    with processes(min(asked.number, 64)) as pool:
        return run_trials(asked, pool if asked.number > 1 else None, report)


def _in_real_time(asked: Trials, report: Count) -> CellReport:
    from palmar.studies.cell_real_time import run_trials_in_real_time

    return run_trials_in_real_time(asked, report)


@app.command
def faults(*, json: AsJson = False) -> None:
    """What can be made to fail."""
    names = [each.value for each in FaultKind]
    show("\n".join(names), {"faults": names}, json)


def _fault(name: str) -> FaultKind:
    try:
        return FaultKind(name)
    except ValueError:
        raise InputError(
            "--fault", repr(name[:60]), f"must be one of {', '.join(each.value for each in FaultKind)}"
        ) from None


def _text(report: CellReport, note: str | None, filmed: str | None) -> str:
    asked, simulated = report.trials, sum(each.seconds for each in report.results)
    rows = [
        ("succeeded", f"{report.success} of {asked.number}"),
        *((f"  failed: {reason}", str(count)) for reason, count in report.failures.items()),
        *((f"  approaches: {number}", str(count)) for number, count in report.approaches.items()),
        ("unsafe", str(report.unsafe)),
        *((f"  {what}", str(count)) for what, count in _unsafe(report).items()),
        ("late replies to the arm", str(sum(each.missed for each in report.results))),
        ("simulated", f"{simulated:.0f} s, {report.real_time_factor:.{3 if report.timings else 1}f} times real time"),
        *(_times(report) if report.timings else ()),
    ]
    head = f"{asked.kind.value}: {asked.number} trials, seed {asked.seed}, {EYES[asked.eye]}"
    return "\n".join([head, "", table(rows), *(f"\n{said}" for said in (note, filmed) if said is not None)])


def _times(report: CellReport) -> list[tuple[str, str]]:
    """Rows that only trials in real time have."""
    record = timing_record(report)
    seen = record["sightings"]
    return [
        ("servo ticks late by", _milliseconds(record["jitter_s"])),
        ("replies after", _milliseconds(record["reply_s"])),
        ("ticks put off", f"{record['slipped_s']:.3f} s"),
        ("sightings", f"{seen['received']}, {seen['dropped']} dropped, {seen['stale']} stale"),
        ("real-time priority", "granted" if record["real_time_priority"] else "not granted"),
    ]


def _milliseconds(found: dict[str, float | None]) -> str:
    told = {name: "none" if value is None else f"{1e3 * value:.2f}" for name, value in found.items()}
    return f"{told['median']} ms in the median, 95 % {told['p95']}, 99 % {told['p99']}, most {told['max']}"


def _unsafe(report: CellReport) -> dict[str, int]:
    from collections import Counter

    return dict(Counter(what for each in report.results for what in each.unsafe).most_common())
