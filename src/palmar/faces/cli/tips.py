"""``palmar tips``: three fingertips that close on a cylinder standing on a table, from above."""

from __future__ import annotations

from math import pi
from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter
from pydantic import ValidationError

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, Check, answer, number, progress, show
from palmar.models.quantity import LARGEST_LENGTH, SMALLEST_LENGTH, Unit
from palmar.models.support import Pressure
from palmar.models.three_tips import ThreeTips
from palmar.studies.three_tips import Task

app = App(name="tips", help="Three fingertips from above: from where they catch a cylinder, plans by touch, toppling.")
MOST_APPROACHES, MOST_TRIALS = 3, 1_000_000

Number = Annotated[str, Parameter(allow_leading_hyphen=True)]
Maybe = Annotated[str | None, Parameter(allow_leading_hyphen=True)]


@app.command
def region(
    *,
    radius: Number = "30",
    tip_radius: Number = "10",
    open: Number = "80",
    closed: Number = "20",
    friction: Number = "0.5",
    pressure: Pressure = Pressure.UNIFORM,
    height: Annotated[Maybe, Parameter(help="Of the cylinder: adds at which heights the tips may close on it.")] = None,
    table_friction: Annotated[Number, Parameter(help="Of the cylinder with the table, with --height.")] = "0.3",
    sweep: Annotated[
        str | None, Parameter(help="LENGTH_MM[,WIDTH_MM]: of the cylinder and the hand, for stl, glb, ply.")
    ] = None,
    out: Annotated[
        Path | None, Parameter(help="Also write it: svg, pdf or png, or with --sweep stl, glb or ply.")
    ] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """From where the closing tips catch the cylinder: centre region, allowed error, radii they hold. Lengths in mm."""
    from palmar.faces.cli.swept import write_swept
    from palmar.faces.tips_record import closing_heights, heights_text, tips_region_record, tips_region_text

    task = _task(radius, tip_radius, open, closed, friction, pressure=pressure)
    drawn = out is not None and out.suffix.lower() in (".svg", ".pdf", ".png")
    if out is not None and sweep is None and not drawn:
        raise InputError("--out", str(out), "is svg, pdf or png, or with --sweep stl, glb or ply")
    found = task.region
    record, text = tips_region_record(task, found), tips_region_text(task, found)
    if height is not None:
        table = _plain(table_friction, "--table-friction")
        record["heights"] = closing_heights(task, _length(height, "--height"), table)
        text += "\n" + heights_text(record["heights"])
    written = "" if out is None else f"\n\nWritten: {out}"
    if sweep is not None:
        said, record["swept"] = write_swept(out, found.centre, sweep)
        written = "\n\n" + said
    elif out is not None:
        from palmar.faces.plots.style import save
        from palmar.faces.plots.tips_picture import tips_picture

        save(tips_picture(task, found), out)
    show(text + written, record, json)
    answer(not found.centre.is_empty, check)


@app.command
def plan(
    *,
    uncertainty: Annotated[str, Parameter(help="Where it may be: disk:R_MM, box:W_MM,H_MM, FILE.geojson.")],
    radius: Number = "30",
    tip_radius: Number = "10",
    open: Number = "80",
    closed: Number = "20",
    friction: Number = "0.5",
    palm_radius: Annotated[Maybe, Parameter(help="Of a round palm that feels; absent: none.")] = None,
    opening: Annotated[Maybe, Parameter(help="The only circle of tips tried for touching, else a grid.")] = None,
    displacement: Annotated[Number, Parameter(help="How far a touch may shift the cylinder.")] = "0",
    pose_error: Annotated[Number, Parameter(help="How far the hand may be from where it should be.")] = "0",
    approaches_max: int = 3,
    trial: Annotated[int, Parameter(help="Also carry so many cylinders through the plan.")] = 0,
    seed: int = 0,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Come down, look which tips touch, move, come down again, close: as few approaches as found, proved at every end."""
    from palmar.behaviours.descent import is_certain
    from palmar.faces.cli.uncertainty import parse_uncertainty
    from palmar.faces.tips_record import descent_record, descent_text
    from palmar.studies.plan_trial import drawn_starts
    from palmar.studies.three_tips import plan_descents, try_descents

    _within("--approaches-max", approaches_max, 1, MOST_APPROACHES)
    _within("--trial", trial, 0, MOST_TRIALS)
    _within("--seed", seed, 0, 2**32 - 1)
    errors = parse_uncertainty(uncertainty)
    doubt = _length(displacement, "--displacement", 0.0), _length(pose_error, "--pose-error", 0.0)
    task = _task(radius, tip_radius, open, closed, friction, palm_radius=palm_radius, doubt=doubt)
    only = None if opening is None else _length(opening, "--opening")
    if only is not None and not task.tips.touching <= only <= task.tips.open_radius:
        raise InputError("--opening", opening, "must be a circle the tips can be on, up to --open")
    found = plan_descents(task, errors, approaches_max, only)
    tried = None
    if trial > 0:
        progress(f"carrying {trial} cylinders through the plan")
        tried = try_descents(task, found, drawn_starts(errors, trial, seed), seed)
    show(descent_text(task, found, approaches_max, tried), descent_record(found, approaches_max, tried), json)
    answer(is_certain(found), check)


@app.command
def topple(
    *,
    radius: Number = "30",
    height: Number = "100",
    mass: Annotated[Number, Parameter(help="In kg.")] = "0.2",
    tip_radius: Number = "10",
    tip_height: Annotated[Number, Parameter(help="Of the tips' contact above the table.")] = "20",
    friction: Number = "0.5",
    table_friction: Number = "0.3",
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Does a push at this height topple the cylinder before it slides, and what does a tip that lands on its rim do."""
    from palmar.faces.tips_record import topple_record, topple_text
    from palmar.mechanics.pushing.cylinder_toppling import loads, push_heights, rim_bands

    r, h, tip, z = (
        _length(text, option)
        for text, option in (
            (radius, "--radius"), (height, "--height"), (tip_radius, "--tip-radius"), (tip_height, "--tip-height"),
        )
    )  # fmt: skip
    mu, table = _plain(friction, "--friction"), _plain(table_friction, "--table-friction")
    weight = number(mass, "--mass")
    if not 0.0 < weight <= 1e9:
        raise InputError("--mass", mass, "must be above 0, at most 1e9 kg")
    if z > h:
        raise InputError("--tip-height", tip_height, "must be at most the cylinder's height")
    heights, bands = push_heights(r, table, mu), rim_bands(r, h, tip, (mu, table))
    push = loads(r, weight, table, (z, 2.0 * r), 0.5 * pi)
    show(topple_text(heights, bands, push, z), topple_record(heights, bands, push), json)
    answer(z <= heights.surely, check)


def _task(
    radius: str, tip: str, opened: str, closed: str, friction: str, *, palm_radius: str | None = None,
    pressure: Pressure = Pressure.UNIFORM, doubt: tuple[float, float] = (0.0, 0.0),
) -> Task:  # fmt: skip
    """The hand and the cylinder from the words of the command line."""
    palm = None if palm_radius is None else _length(palm_radius, "--palm-radius")
    lengths = [_length(*each) for each in ((tip, "--tip-radius"), (opened, "--open"), (closed, "--closed"))]
    try:
        tips = ThreeTips(tip_radius=lengths[0], open_radius=lengths[1], closed_radius=lengths[2], palm_radius=palm)
    except ValidationError as error:
        raise InputError("--closed", closed, error.errors()[0]["msg"].removeprefix("Value error, ")) from None
    return Task(tips, _length(radius, "--radius"), _plain(friction, "--friction"), pressure, *doubt)


def _length(text: str, option: str, least: float = SMALLEST_LENGTH) -> float:
    """Millimetres -> m."""
    value = Unit.MILLIMETRE.to_si(number(text, option))
    if not least <= value <= LARGEST_LENGTH:
        raise InputError(option, text[:60], f"must be from {1e3 * least:g} to {1e3 * LARGEST_LENGTH:g} mm")
    return value


def _plain(text: str, option: str) -> float:
    value = number(text, option)
    if not 0.0 <= value <= 100.0:
        raise InputError(option, text[:60], "must be from 0 to 100")
    return value


def _within(option: str, value: int, low: int, high: int) -> None:
    if not low <= value <= high:
        raise InputError(option, str(value), f"must be from {low} to {high}")
