"""``palmar cell predict`` and ``workspace``: what is certain of the 3-D cell's tasks before any trial, and where."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from palmar.errors import InputError
from palmar.faces.cell_record import prediction_record, workspace_record
from palmar.faces.cli.behaviour_options import within
from palmar.faces.cli.printing import AsJson, Check, answer, numbers, show
from palmar.faces.cli.texts import table
from palmar.models.cell_task import FLOATING_TASK, TABLE_TASK, TaskKind
from palmar.models.salisbury_hand import SalisburyHand

if TYPE_CHECKING:
    from palmar.studies.cell_workspace import Workspace

Number = Annotated[str, Parameter(allow_leading_hyphen=True)]
Maybe = Annotated[str | None, Parameter(allow_leading_hyphen=True)]
Task = Annotated[Literal["table", "floating"], Parameter(help="Pick up from a table, or catch in the air.")]
SOLIDS = (".stl", ".ply", ".glb")
ENDINGS = (".svg", ".pdf", ".png", ".geojson", *SOLIDS)
LEAST = 0.001
"""Thickness (m) of the solid of a way at one height."""
Record = dict[str, Any]
TASKS = {"table": TABLE_TASK, "floating": FLOATING_TASK}


def predict(task: Task, *, json: AsJson = False) -> None:
    """How far vision may err for a grasp that is certain, in one, two and three approaches; and why."""
    from palmar.behaviours.cell.grasp_height import grasp_heights
    from palmar.studies.cell_prediction import predict as predicted

    hand, given = SalisburyHand(), TASKS[task]
    found = predicted(hand, given)
    heights = grasp_heights(hand, given.cylinder) if given.kind is TaskKind.TABLE else None
    rows = [(f"in {each.approaches} approach{'es' * (each.approaches > 1)}", _allowed(each.error)) for each in found]
    for each in found:
        if each.along_across is not None:
            along, across = each.along_across
            rows.append(("along, across the drive", f"{1e3 * along:.1f} mm, {1e3 * across:.1f} mm"))
    if heights is not None:
        low, high = heights.pushes
        rows.append(("tips push", f"{1e3 * low:.0f} to {1e3 * high:.0f} mm over the table"))
        rows.append(("slides for certain", f"pushed up to {1e3 * heights.bound:.0f} mm"))
    why = sorted({f"{each.why} ({each.guarantee.meaning})" for each in found})
    show(
        "\n".join([f"{task}: vision may err by", "", table(rows), "", *why]),
        prediction_record(task, found, heights),
        json,
    )


def workspace(
    task: Task,
    *,
    at: Annotated[Maybe, Parameter(help="X_MM,Y_MM of the cylinder's axis in the arm's base; else the task's.")] = None,
    error_mm: Annotated[Maybe, Parameter(help="How far vision may err; else what one approach allows.")] = None,
    spacing_mm: Annotated[Number, Parameter(help="Of the places asked, along the boundary.")] = "5",
    out: Annotated[Path | None, Parameter(help="Also write it: svg, pdf, png, geojson, stl, ply or glb.")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Where the cylinder may be for the arm to reach every pose of the task, and which part of the region it then serves."""
    from palmar.studies.cell_prediction import predict as predicted
    from palmar.studies.cell_workspace import allowed_places
    from palmar.studies.cell_workspace import workspace as served_places

    if out is not None and out.suffix.lower() not in ENDINGS:
        raise InputError("--out", str(out), f"the name must end in one of {', '.join(ENDINGS)}")
    hand, given = SalisburyHand(), TASKS[task]
    x, y = given.place[:2] if at is None else (1e-3 * each for each in numbers(at, "--at", (2,), "X_MM,Y_MM"))
    promised = predicted(hand, given, most=1)[0]
    error = promised.error if error_mm is None else 1e-3 * within("--error-mm", error_mm, 0.0, 500.0)
    found = served_places(hand, given, 1e-3 * within("--spacing-mm", spacing_mm, 1.0, 40.0))
    region = allowed_places(hand, given, promised)
    record = workspace_record(task, found, (x, y), error, region)
    written = "" if out is None else f"\n\n{_write(out, found, (x, y), error)}"
    show(_workspace_text(record, error) + written, record, json)
    answer(found.room((x, y)) >= error, check)


def _workspace_text(record: Record, error: float) -> str:
    x, y = record["at_m"]
    rows = [
        ("places served", f"{1e4 * record['area_m2']:.0f} cm2"),
        (f"with an error of {1e3 * error:.1f} mm", f"{1e4 * record['area_with_error_m2']:.0f} cm2"),
        (f"at ({1e3 * x:.0f}, {1e3 * y:.0f}) mm", "served" if record["served"] else "not served with this error"),
        ("  room to the boundary", f"{1e3 * record['room_m']:.0f} mm"),
        ("  of the region of hand places", f"{100.0 * record['region_share']:.1f} % served"),
    ]
    said = f"at places {1e3 * record['spacing_m']:g} mm apart along the boundary, their inner side"
    return "\n".join([f"{record['task']}: where the arm can serve", "", table(rows), "", said])


def _write(out: Path, found: Workspace, at: tuple[float, float], error: float) -> str:
    """Write the places, flat or as a solid over the palm's heights, and say so."""
    ending = out.suffix.lower()
    if ending in SOLIDS:
        from palmar.faces.exports.solid_file import write_solid
        from palmar.geometry.prism import prism

        low, high = found.heights
        thick = max(high - low, LEAST)
        write_solid(out, prism(found.places, high - thick, high))
    elif ending == ".geojson":
        from palmar.faces.exports.region_file import write_places

        write_places(out, {"served": found.places, "served_with_error": found.with_error(error)})
    else:
        from palmar.faces.plots.style import save
        from palmar.faces.plots.workspace_picture import workspace_picture

        save(workspace_picture(found, at, error), out)
    return f"Written: {out}"


def _allowed(error: float) -> str:
    return f"{1e3 * error:.1f} mm in any direction"
