"""``palmar cell predict``: what is certain of the 3-D cell's tasks before any trial."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

from palmar.faces.cell_record import prediction_record
from palmar.faces.cli.printing import AsJson, show
from palmar.faces.cli.texts import table
from palmar.models.cell_task import FLOATING_TASK, TABLE_TASK, TaskKind
from palmar.models.salisbury_hand import SalisburyHand

Task = Annotated[Literal["table", "floating"], Parameter(help="Pick up from a table, or catch in the air.")]
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


def _allowed(error: float) -> str:
    return f"{1e3 * error:.1f} mm in any direction"
