"""``palmar validate``: a region put to the test by random starts in a world."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from cyclopts import App, Parameter

from palmar.errors import InputError, NotCoveredError
from palmar.faces.cli.behaviour_options import within
from palmar.faces.cli.pool import counting, processes
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, show
from palmar.faces.cli.texts import table, titled
from palmar.faces.cli.world_option import Physics, maker_of
from palmar.faces.trial_records import validation_record
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.studies.validate import Validation

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
    if given.behaviour.name is not BehaviourName.CLOSE:
        raise NotCoveredError(f'behaviour.name = "{given.behaviour.name.value}": validation is for closing')
    make = maker_of(world)
    region = build_region(given)
    with processes() as pool, counting(samples, "starts") as report:
        result = try_starts(given, region, samples, seed, margin, make, pool, report)
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
    for each in result.surprises[:10]:
        x, y, _ = (1e3 * value for value in each.start)
        side = "inside" if each.inside else "outside"
        planar = "" if each.planar is None else f"; the planar kernels: {each.planar.value}"
        lines.append(f"({x:.2f}, {y:.2f}) mm, {1e3 * each.distance:.2f} mm {side}: {each.outcome.value}{planar}")
    if case.hand.finger_rate > SLOW and len(result.surprises) > 0:
        lines.append("The region is that of a slow closing; hand.finger_rate_deg_s makes inertia matter.")
    return "\n".join(lines)


SLOW = 0.2
"""Closing rate (rad/s) up to which inertia hardly matters on a table."""
