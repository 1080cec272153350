"""``palmar cell``: the 3-D cell, a Puma with the Salisbury hand and a cylinder (chapter 7), in MuJoCo."""

from __future__ import annotations

from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cell_record import cell_record
from palmar.faces.cli.behaviour_options import within
from palmar.faces.cli.cell_film import film, known_ending
from palmar.faces.cli.cell_theory import predict, workspace
from palmar.faces.cli.pool import counting, processes
from palmar.faces.cli.printing import AsJson, Check, answer, show
from palmar.faces.cli.texts import table
from palmar.models.cell_task import TaskKind
from palmar.worlds.cell.faults import FaultKind

if TYPE_CHECKING:
    from palmar.studies.cell_trials import CellReport

app = App(name="cell")
app.command(predict)
app.command(workspace)
MOST_TRIALS = 100_000
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
    view: Annotated[Path | None, Parameter(help="Also film the first trial: gif, or mp4 (needs ffmpeg).")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Seeded trials in lock-step simulated time; success is 100 mm away and held for 2 s, by contact alone."""
    from palmar.studies.cell_trials import Trials, run_trials

    if not 1 <= trials <= MOST_TRIALS:
        raise InputError("--trials", str(trials), f"must be 1 to {MOST_TRIALS}")
    known_ending(view)
    if seed < 0:
        raise InputError("--seed", str(seed), "must not be negative")
    asked = Trials(
        TaskKind(task),
        trials,
        seed,
        1e-3 * within("--error-mm", error_mm, 0.0, 200.0),
        exact,
        within("--tension-noise-n", tension_noise_n, 0.0, 100.0),
        1e-3 * within("--latency-ms", latency_ms, 0.0, 10_000.0),
        radians(within("--turn-deg", turn_deg, -30.0, 30.0)),
        _fault(fault),
    )
    filmed = None if view is None else film(view, asked)
    with processes(min(trials, 64)) as pool, counting(trials, "trials") as report:
        found = run_trials(asked, pool if trials > 1 else None, report)
    show(_text(found, filmed), cell_record(found) | ({} if filmed is None else {"view": filmed}), json)
    answer(found.success == trials and not found.unsafe, check)


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


def _text(report: CellReport, filmed: str | None) -> str:
    asked, simulated = report.trials, sum(each.seconds for each in report.results)
    rows = [
        ("succeeded", f"{report.success} of {asked.number}"),
        *((f"  failed: {reason}", str(count)) for reason, count in report.failures.items()),
        *((f"  approaches: {number}", str(count)) for number, count in report.approaches.items()),
        ("unsafe", str(report.unsafe)),
        *((f"  {what}", str(count)) for what, count in _unsafe(report).items()),
        ("late replies to the arm", str(sum(each.missed for each in report.results))),
        ("simulated", f"{simulated:.0f} s, {report.real_time_factor:.1f} times real time in each process"),
    ]
    head = f"{asked.kind.value}: {asked.number} trials, seed {asked.seed}, simulated-pose camera"
    return "\n".join([head, "", table(rows), *([] if filmed is None else ["", filmed])])


def _unsafe(report: CellReport) -> dict[str, int]:
    from collections import Counter

    return dict(Counter(what for each in report.results for what in each.unsafe).most_common())
