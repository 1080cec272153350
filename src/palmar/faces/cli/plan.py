"""``palmar plan``: approaches by touch that certainly end in a grasp, from a set of places where the object may be."""

from __future__ import annotations

from math import pi, radians
from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from palmar.behaviours.policy import is_guaranteed
from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, numbers, progress, show
from palmar.faces.cli.region_options import place_given
from palmar.faces.cli.texts import titled
from palmar.faces.plan_record import plan_record
from palmar.faces.plan_words import plan_text
from palmar.models.case_file import with_layout
from palmar.models.closure import Closure
from palmar.models.shipped import open_case
from palmar.studies.plan import Rule

app = App(name="plan")
MOST_APPROACHES, MOST_TRIALS, MOST_DIRECTIONS = 6, 1_000_000, 24
Text = Annotated[str | None, Parameter(allow_leading_hyphen=True)]


@app.default
def plan(
    case: CaseName,
    *,
    uncertainty: Annotated[
        str, Parameter(help="Where it may be about that place: disk:R_MM, box:W_MM,H_MM, FILE.geojson.")
    ],
    at: Annotated[Text, Parameter(help="X_MM,Y_MM: where the object is thought to be, else the case's start.")] = None,
    approaches_max: Annotated[int, Parameter(help="The most approaches allowed; of strips, from a touch on.")] = 3,
    sensors: Annotated[
        str | None, Parameter(help="Instead of the case's: none, palm, tips, distributed, full, or PART[,PART...].")
    ] = None,
    rule: Annotated[
        Rule,
        Parameter(
            help="fewest: by search; recentre: under the middle of what is known; strips: side by side across it;"
            " closings: one place after the other, without touch."
        ),
    ] = Rule.FEWEST,
    directions: Annotated[
        Text, Parameter(help="Ways the hand may face: how many all around, or DEG[,DEG...] from as it stands.")
    ] = None,
    closure: Annotated[Closure, Parameter(help="structural takes the contacts as frictionless.")] = Closure.FRICTIONAL,
    trial: Annotated[int, Parameter(help="Also simulate so many objects drawn from the uncertainty.")] = 0,
    seed: Annotated[int, Parameter(help="Of the objects drawn.")] = 0,
    out: Annotated[Path | None, Parameter(help="Also draw the hardest branch: svg, pdf or png.")] = None,
    animate: Annotated[Path | None, Parameter(help="Also film an object that takes the most approaches: gif.")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Approach until a sensor fires, again if need be, then close: a tree of moves with a proof at each of its ends."""
    from palmar.faces.cli.uncertainty import parse_uncertainty
    from palmar.studies.plan import plan as planned
    from palmar.studies.plan_trial import Errors, drawn_starts, try_plan

    _within("--approaches-max", approaches_max, 0, MOST_APPROACHES)
    _within("--trial", trial, 0, MOST_TRIALS)
    _within("--seed", seed, 0, 2**32 - 1)
    if out is not None and out.suffix.lower() not in (".svg", ".pdf", ".png"):
        raise InputError("--out", str(out), "a plan is drawn as svg, pdf or png")
    if animate is not None and animate.suffix.lower() != ".gif":
        raise InputError("--animate", str(animate), "a plan's film is a .gif")
    name, given = open_case(case)
    if sensors is not None:
        given = with_layout(given, sensors, "--sensors")
    errors = parse_uncertainty(uncertainty)
    place = given.start.at if at is None else place_given(at)
    facing = (0.0,) if directions is None else _directions(directions, rule)
    found = planned(given, errors, place, approaches_max, closure, rule, facing)
    tried = None
    if trial > 0:
        progress(f"simulating {trial} objects")
        starts = drawn_starts(errors, trial, seed) + place
        assumed = Errors(found.doubt.displacement, found.doubt.pose_error)
        tried = try_plan(given, found.found.policy, found.stretches, starts, assumed, seed)
    if out is not None:
        from palmar.faces.plots.plan_picture import plan_picture
        from palmar.faces.plots.style import save

        save(plan_picture(given, found), out)
    if animate is not None:
        from palmar.faces.plots.plan_film import write_plan_film

        write_plan_film(animate, given, found)
    written = [f"Written: {each}" for each in (out, animate) if each is not None]
    show(
        titled(name, given, plan_text(found, approaches_max, tried), *written),
        plan_record(found, approaches_max, tried),
        json,
    )
    answer(is_guaranteed(found.found.policy), check)


def _directions(text: str, rule: Rule) -> tuple[float, ...]:
    """A number of ways all around, or degrees -> rad."""
    if rule is not Rule.FEWEST:
        raise InputError("--directions", repr(text[:60]), f"only with --rule fewest, not {rule.value}")
    if text.isdecimal():
        many = int(text)
        if not 1 <= many <= MOST_DIRECTIONS:
            raise InputError(
                "--directions", text[:60], f"must be 1 to {MOST_DIRECTIONS}, or DEG[,DEG...] with a sign or point"
            )
        return tuple(2.0 * pi * k / many for k in range(many))
    values = numbers(text, "--directions", tuple(range(1, MOST_DIRECTIONS + 1)), "N or DEG[,DEG...]")
    if max(abs(each) for each in values) > 360.0:
        raise InputError("--directions", repr(text[:60]), "must be from -360 to 360 deg")
    return tuple(radians(each) for each in values)


def _within(option: str, value: int, low: int, high: int) -> None:
    if not low <= value <= high:
        raise InputError(option, str(value), f"must be from {low} to {high}")
