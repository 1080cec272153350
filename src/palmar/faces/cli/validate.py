"""``palmar validate``: a region put to the test by random starts in a world."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.behaviour_options import within
from palmar.faces.cli.pool import counting, processes
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, show
from palmar.faces.cli.texts import table, titled
from palmar.faces.cli.trial_log import Log, TrialLog
from palmar.faces.cli.world_option import Physics, maker_of
from palmar.faces.trial_records import validation_record
from palmar.models.case import Case
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.models.outcome import Outcome
    from palmar.studies.validate import Tried, Validation

app = App(name="validate")
MOST_SAMPLES = 1_000_000


@app.default
def validate(
    case: CaseName,
    *,
    world: Physics = "mujoco",
    samples: Annotated[int, Parameter(help="Starts, half of them inside the region.")] = 100,
    seed: Annotated[int, Parameter(help="Of the draw.")] = 0,
    margin_mm: Annotated[str, Parameter(help="No start is nearer to the boundary.", allow_leading_hyphen=True)] = "0",
    log: Log = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Try random starts inside and around the exact region; --check: is the region right about all of them?"""
    from palmar.regions.build import build_region
    from palmar.studies.validate import validate as try_starts

    if not 2 <= samples <= MOST_SAMPLES:
        raise InputError("--samples", str(samples), f"must be from 2 to {MOST_SAMPLES}")
    if seed < 0:
        raise InputError("--seed", str(seed), "must not be negative")
    margin = 1e-3 * within("--margin-mm", margin_mm, 0.0, 1e5)
    name, given = open_case(case)
    make, region = maker_of(world), build_region(given)
    kept = None if log is None else TrialLog(log, f"{given.model_dump_json()} {samples} {seed} {margin} {world}")
    past = {} if kept is None else kept.outcomes()
    with processes() as pool, counting(samples, "starts", len(past)) as report:
        done = len(past)

        def keep(number: int, outcome: Outcome) -> None:
            nonlocal done
            done += 1
            if kept is not None:
                kept.add_outcome(number, outcome)
            report(done, None)

        result = try_starts(given, region, samples, seed, margin, make, pool, past, keep)
    record = validation_record(result, region, {"world": world, "seed": seed, "margin_m": margin})
    show(titled(name, given, _text(given, result, region.reason)), record, json)
    answer(bool(result.tried) and not result.surprises, check)


def _text(case: Case, result: Validation, reason: str | None) -> str:
    if not result.tried:
        return f"Nothing to try, the region is empty: {reason}."
    heads = ("starts", "caught", "lost")
    rows = [
        (side, *(str(result.count(inside=inside, caught=caught)) for caught in (True, False)))
        for side, inside in (("inside", True), ("outside", False))
    ]
    lines = [table([heads, *rows])]
    lines += [_line(each) for each in result.surprises[:10]]
    same, alike = (result.agreeing(exactly=each) for each in (True, False))
    if same is not None:
        lines.append(
            f"Same outcome in the planar world: {same} of {len(result.tried)}; caught in both or lost in both: {alike}."
        )
        lines += [_line(each) for each in result.disputed[:10] if each.as_told]
    if case.hand.finger_rate > SLOW and len(result.surprises) > 0:
        lines.append("The region is that of a slow closing; hand.finger_rate_deg_s makes inertia matter.")
    return "\n".join(lines)


def _line(each: Tried) -> str:
    x, y, _ = (1e3 * value for value in each.start)
    side = "inside" if each.inside else "outside"
    planar = "" if each.planar is None else f"; the planar world: {each.planar.value}"
    if each.disputed:
        planar += " near by too" if each.aside is None else f", but not {1e3 * each.aside:g} mm aside"
    return f"({x:.2f}, {y:.2f}) mm, {1e3 * each.distance:.2f} mm {side}: {each.outcome.value}{planar}"


SLOW = 0.2
"""Closing rate (rad/s) up to which inertia hardly matters on a table."""
