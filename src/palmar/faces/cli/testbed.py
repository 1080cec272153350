"""``palmar testbed``: what the source measured on its planar test bed (chapter 6), in any world."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.behaviour_options import within
from palmar.faces.cli.pool import counting, processes
from palmar.faces.cli.printing import AsJson, CaseName, number, show
from palmar.faces.cli.testbed_report import report
from palmar.faces.cli.texts import table, titled
from palmar.faces.cli.trial_log import Log, TrialLog
from palmar.faces.cli.world_option import Physics, maker_of
from palmar.faces.trial_records import limits_record
from palmar.models.case import Case
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.studies.limits import Limit, Rules

app = App(name="testbed")
app.command(report)
ANGLES = "15,22.5,30,37.5,45,52.5,60,67.5,75,82.5,90"
MOST_ANGLES = 1000


@app.command
def limits(
    case: CaseName,
    *,
    world: Physics = "mujoco",
    angles: Annotated[str, Parameter(help="Directions in deg from the palm line, separated by commas.")] = ANGLES,
    about: Annotated[
        Literal["palm", "joint"], Parameter(help="Rays from the palm's middle or the right joint.")
    ] = "palm",
    tolerance_mm: Annotated[str, Parameter(help="How well each limit is to be known.")] = "1",
    placing_mm: Annotated[str, Parameter(help="By how much a place may be missed.")] = "0",
    seed: Annotated[int, Parameter(help="Of the first places and of their errors.")] = 0,
    log: Log = None,
    json: AsJson = False,
) -> None:
    """The source's search: place, trigger, further out on success, further in on failure, until the limit."""
    from palmar.regions.build import build_region
    from palmar.studies.limits import Rules, Trial, left_to_do
    from palmar.studies.limits import limits as search

    if seed < 0:
        raise InputError("--seed", str(seed), "must not be negative")
    name, given = open_case(case)
    rules = Rules(
        (0.0, 0.0) if about == "palm" else (given.hand.half_palm, 0.0),
        _angles(angles),
        1e-3 * within("--tolerance-mm", tolerance_mm, 0.001, 1000.0),
        1e-3 * within("--placing-mm", placing_mm, 0.0, 1000.0),
        seed,
    )
    make, region = maker_of(world), build_region(given)
    kept = None if log is None else TrialLog(log, _settings(given, rules, world))
    made = [] if kept is None else kept.trials()
    past, length = tuple(made), given.hand.finger_length
    whole = len(made) + left_to_do(length, rules, made)
    with processes() as pool, counting(whole, "trials", len(made)) as report:

        def keep(trial: Trial) -> None:
            made.append(trial)
            if kept is not None:
                kept.add_trial(trial)
            report(len(made), len(made) + left_to_do(length, rules, made))

        found = search(given, rules, region.centre, make, pool, past, keep)
    record = limits_record(
        found, {"world": world, "about_m": list(rules.about), "seed": seed, "tolerance_m": rules.tolerance}
    )
    show(titled(name, given, _text(found)), record, json)


def _angles(text: str) -> tuple[float, ...]:
    values = [number(part, "--angles") for part in text.split(",")]
    if len(values) > MOST_ANGLES or not all(0.0 <= each <= 180.0 for each in values):
        raise InputError("--angles", text[:60], f"must be up to {MOST_ANGLES} numbers from 0 to 180")
    return tuple(math.radians(each) for each in values)


def _settings(case: Case, rules: Rules, world: str) -> str:
    """What a trial depends on, as a line."""
    return f"{case.model_dump_json()} {rules} {world}"


def _text(found: tuple[Limit, ...]) -> str:
    rows: list[tuple[str, ...]] = [("direction", "limit", "region", "difference", "trials")]
    for each in found:
        values = (each.distance, each.predicted, each.difference)
        rows.append(
            (
                f"{math.degrees(each.angle):.4g} deg",
                *("-" if value is None else f"{1e3 * value:.1f} mm" for value in values),
                str(len(each.trials)),
            )
        )
    return table(rows)
