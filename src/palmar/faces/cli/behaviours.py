"""``palmar behaviours``: what the hand can be told to do, and one run of it in a world."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import App, Parameter

from palmar.behaviours.descriptions import DESCRIPTIONS
from palmar.errors import InputError
from palmar.faces.cli.behaviour_chance import chance
from palmar.faces.cli.behaviour_options import (
    Layout,
    Massive,
    Named,
    Number,
    Track,
    Velocity,
    named,
    tracker_of,
    with_behaviour,
    with_velocity,
    within,
)
from palmar.faces.cli.behaviour_region import region
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, numbers, progress, show
from palmar.faces.cli.texts import table, titled
from palmar.faces.cli.travel import travel
from palmar.faces.cli.world_option import Physics, maker_of
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case
from palmar.models.quantity import file_key, unit_of
from palmar.models.shipped import open_case
from palmar.models.support import SupportKind

if TYPE_CHECKING:
    from palmar.studies.run_behaviour import BehaviourRun

app = App(name="behaviours")
app.command(region)
app.command(chance)
app.command(travel)
Text = Annotated[str | None, Parameter(allow_leading_hyphen=True)]


@app.default
@app.command(name="list")
def list_all(*, json: AsJson = False) -> None:
    """Every behaviour in one line."""
    rows = [(name.value, each.summary) for name, each in DESCRIPTIONS.items()]
    show(table(rows), {"behaviours": [{"name": name, "summary": summary} for name, summary in rows]}, json)


@app.command
def describe(
    name: Annotated[str, Parameter(help="One of palmar behaviours list.", show_default=False)],
    *,
    json: AsJson = False,
) -> None:
    """What a behaviour does, step by step, its parameters in a case file with their defaults, and what it needs."""
    chosen = named(name, "NAME")
    known = DESCRIPTIONS[chosen]
    parameters = [_parameter(each) for each in known.parameters]
    lines = [f"{chosen.value}: {known.summary}", ""]
    lines += [f"{k + 1}. {step}" for k, step in enumerate(known.steps)]
    lines += ["", f"Needs {known.needs}. Source: section {known.section}."]
    if parameters:
        lines += ["", "In a case file, [behaviour]:", table([(_line(*each),) for each in parameters])]
    record = {
        "name": chosen.value, "summary": known.summary, "steps": list(known.steps), "needs": known.needs,
        "section": known.section, "parameters": dict(parameters),
    }  # fmt: skip
    show("\n".join(lines), record, json)


@app.command(name="run")
def run_one(
    case: CaseName,
    *,
    behaviour: Named = None,
    start: Annotated[Text, Parameter(help="X_MM,Y_MM[,THETA_DEG]; else the case's start.")] = None,
    velocity: Velocity = None,
    sensors: Layout = None,
    track: Track = None,
    massive: Massive = None,
    world: Physics = "planar",
    tick: Annotated[Number, Parameter(help="Time between two observations in ms.")] = "5",
    longest: Annotated[Number, Parameter(help="Cut it off after so many seconds.")] = "600",
    missed: Annotated[Number, Parameter(help="Share of touches that a sensor never sees.")] = "0",
    false_rate: Annotated[Number, Parameter(help="How often a second a sensor fires without a touch.")] = "0",
    seed: Annotated[int, Parameter(help="Of the sensors' faults and the tracker's errors.")] = 0,
    out: Annotated[
        Path | None, Parameter(help="Also keep the run: json, csv; or draw it: svg, pdf, png; or film it: gif.")
    ] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Run a behaviour: outcome, and what was felt and done when."""
    from palmar.faces.exports.trace_file import known_ending, write_trace
    from palmar.studies.run_behaviour import Circumstances, run_behaviour
    from palmar.worlds.planar.bits import Sensing

    if out is not None:
        known_ending(out)
    name, given = open_case(case)
    given = with_velocity(with_behaviour(given, behaviour, sensors), velocity)
    place = _place(given, start)
    seconds = 1e-3 * within("--tick", tick, 1.0, 1000.0)
    if not 0 <= seed < 2**32:
        raise InputError("--seed", str(seed), f"must be from 0 to {2**32 - 1}")
    faults = Sensing(
        given.sensors.displacement, within("--missed", missed, 0.0, 1.0),
        within("--false-rate", false_rate, 0.0, 1000.0), seed,
    )  # fmt: skip
    if given.behaviour.name is BehaviourName.FOLLOW_POLICY and given.support.kind is SupportKind.TABLE:
        progress("planning")
    most = within("--longest", longest, 0.0, 3600.0)
    tracker = tracker_of(track, seed)
    done = run_behaviour(given, place, Circumstances(seconds, faults, massive, most, tracker, maker_of(world)))
    if out is not None:
        write_trace(out, done)
    _tell(name, done, out, json)
    answer(done.trace.outcome.caught, check)


@app.command
def replay(
    trace: Annotated[Path, Parameter(help="A json or csv file that palmar behaviours run wrote.", show_default=False)],
    *,
    out: Annotated[Path | None, Parameter(help="Write it anew: json, csv, svg, pdf, png or gif.")] = None,
    json: AsJson = False,
) -> None:
    """Tell and draw a run again from its file."""
    from palmar.faces.exports.trace_file import known_ending, read_trace, write_trace

    if out is not None:
        known_ending(out)
    done = read_trace(trace)
    if out is not None:
        write_trace(out, done)
    _tell(trace.stem, done, out, json)


def _tell(name: str, done: BehaviourRun, out: Path | None, json: bool) -> None:
    from palmar.faces.trace_record import run_record

    trace, (x, y, theta) = done.trace, done.trace.rows[-1].pose
    shown = (round(each, 2) + 0.0 for each in (1e3 * x, 1e3 * y, math.degrees(theta)))
    place = "({:.2f}, {:.2f}) mm, turned {:.2f} deg".format(*shown)
    ended = (
        f"{done.case.behaviour.name.value}: {trace.outcome.value}; the object ends at {place}.\n"
        f"The hand's own verdict: {done.verdict.value}. {_ENDED[trace.ended.value]}."
    )
    if trace.peak_forces is not None:
        right, left = trace.peak_forces
        ended += f"\nLargest force on the left finger {left:.4g} N, on the right one {right:.4g} N."
    rows = [(f"{each.time:8.3f} s", each.kind.replace("_", " "), _short(each.what)) for each in trace.happenings]
    written = [f"Written: {out}"] if out is not None else []
    show(titled(name, done.case, ended, table(rows), *written), run_record(done), json)


_ENDED = {
    "stopped": "The behaviour ended by itself",
    "cut_off": "The behaviour did not end and was cut off",
    "broken": "The world could not go on",
}


def _short(text: str) -> str:
    """Words without underscores, and numbers with one decimal."""
    return re.sub(r"\d+\.\d{2,}", lambda found: f"{float(found[0]):.1f}", text.replace("_", " "))


def _parameter(name: str) -> tuple[str, float | None]:
    """A parameter's key in a case file and its default in the file's unit; None if it is absent."""
    field = Behaviour.model_fields[name]
    unit, given = unit_of(field), field.default
    return file_key(name, field), given if unit is None or given is None else unit.from_si(given)


def _line(key: str, value: float | None) -> str:
    return f"{key} absent" if value is None else f"{key} = {value:g}"


def _place(case: Case, start: str | None) -> tuple[float, float, float]:
    if start is None:
        return (*case.start.at, case.start.theta)
    values = numbers(start, "--start", (2, 3), "X_MM,Y_MM[,THETA_DEG]")
    theta = math.radians(values[2]) if len(values) == 3 else case.start.theta
    return 1e-3 * values[0], 1e-3 * values[1], theta
