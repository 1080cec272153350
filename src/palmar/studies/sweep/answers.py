"""From rows of a sweep to columns of answers: one command each. A row that is refused has its reason and no answer."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import nan, radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.errors import PalmarError
from palmar.models.case import Case
from palmar.models.device import Device
from palmar.models.outcome import Outcome
from palmar.models.sweep import Sweep, SweepCommand

Floats = NDArray[np.float64]
Columns = dict[str, NDArray[Any]]
NOT_ANSWERED = -1
"""In place of an outcome's code."""
STARTS = ("start.at_mm.0", "start.at_mm.1", "start.theta_deg", "start.velocity_mm_s.0", "start.velocity_mm_s.1")
"""Keys of a start: rows that differ in these alone go through the kernel in one batch."""
ENDS = ("x_m", "y_m", "theta_rad", "right_rad", "left_rad")


def answers(sweep: Sweep, given: dict[str, Floats]) -> tuple[Columns, list[str | None]]:
    """Columns of answers (N,) for columns of numbers (N,), and why a row has none."""
    if sweep.command is SweepCommand.SIMULATE:
        return _simulated(sweep, given, partial(_by_kernel, sweep.device))
    if sweep.command is SweepCommand.TESTBED:
        return _simulated(sweep, given, _on_the_bed)
    return _one_by_one(sweep, given, {
        SweepCommand.CLOSURE: _closure, SweepCommand.REGION: _region, SweepCommand.PLAN: _plan,
    }[sweep.command])  # fmt: skip


Ends = tuple[NDArray[np.int8], Floats]
"""Codes (N,) of outcomes, and where object and base joints ended: (N, 5)."""


def _simulated(
    sweep: Sweep, given: dict[str, Floats], carry: Callable[[Case, Floats], Ends]
) -> tuple[Columns, list[str | None]]:
    number = len(next(iter(given.values())))
    codes, ends = np.full(number, NOT_ANSWERED, np.int8), np.full((number, 5), nan)
    reasons: list[str | None] = [None] * number
    for values, rows in _batches({key: column for key, column in given.items() if key not in STARTS}, number):
        try:
            case = sweep.case_at(values)
        except PalmarError as error:
            _refuse(reasons, rows, error)
            continue
        starts, parts = _starts(case, given, rows), [np.arange(len(rows))]
        while parts:
            part = parts.pop()
            try:
                codes[rows[part]], ends[rows[part]] = carry(case, starts[part])
            except PalmarError as error:
                if len(part) == 1:
                    _refuse(reasons, rows[part], error)
                else:
                    parts += np.array_split(part, 2)
    return {"outcome": codes, **{name: ends[:, k] for k, name in enumerate(ENDS)}}, reasons


def _refuse(reasons: list[str | None], rows: NDArray[np.intp], error: PalmarError) -> None:
    for row in rows:
        reasons[row] = str(error).removeprefix("row: ")


def _batches(columns: dict[str, Floats], number: int) -> list[tuple[dict[str, float], NDArray[np.intp]]]:
    """Rows that agree in all these columns, with their values."""
    if not columns:
        return [({}, np.arange(number))]
    table = np.stack(list(columns.values()), axis=1)
    kinds, which = np.unique(table, axis=0, return_inverse=True)
    order = np.argsort(which.ravel(), kind="stable")
    parts = np.split(order, np.cumsum(np.bincount(which.ravel()))[:-1])
    return [(dict(zip(columns, kind.tolist(), strict=True)), part) for kind, part in zip(kinds, parts, strict=True)]


def _starts(case: Case, given: dict[str, Floats], rows: NDArray[np.intp]) -> Floats:
    """(N, 5) in m, rad and m/s; what does not vary is the case's."""
    starts = np.tile([*case.start.at, case.start.theta, *case.start.velocity], (len(rows), 1))
    for k, key in enumerate(STARTS):
        if key in given:
            starts[:, k] = given[key][rows] * (radians(1.0) if key.endswith("deg") else 1e-3)
    return starts


def _by_kernel(device: Device, case: Case, starts: Floats) -> Ends:
    from palmar.studies.simulate import simulate_starts

    ends = simulate_starts(case, starts, device)
    return ends.codes, np.column_stack([ends.poses, ends.fingers])


def _on_the_bed(case: Case, starts: Floats) -> Ends:
    from palmar.studies.simulate_in_world import simulate_starts_in
    from palmar.worlds.mujoco.world import bed_world

    ends = simulate_starts_in(case, starts, bed_world)
    return ends.codes, np.column_stack([ends.poses, ends.fingers])


def _one_by_one(
    sweep: Sweep, given: dict[str, Floats], ask: Callable[[Sweep, Case], dict[str, float]]
) -> tuple[Columns, list[str | None]]:
    number = len(next(iter(given.values())))
    found: list[dict[str, float]] = []
    reasons: list[str | None] = []
    for row in range(number):
        try:
            found.append(ask(sweep, sweep.case_at({key: float(column[row]) for key, column in given.items()})))
            reasons.append(None)
        except PalmarError as error:
            found.append({})
            reasons.append(str(error).removeprefix("row: "))
    names = list(ANSWERS[sweep.command])
    return {name: np.array([each.get(name, nan) for each in found]) for name in names}, reasons


def _closure(_: Sweep, case: Case) -> dict[str, float]:
    from palmar.studies.closure import closure_answer

    found = closure_answer(case)
    record: dict[str, float] = {"structural": found.object.structural, "frictional": found.object.frictional}
    for name, radii in (("structural", found.structural), ("frictional", found.frictional)):
        if radii is not None:
            record |= {f"{name}_min_m": radii.radius_min, f"{name}_max_m": radii.radius_max}
    return record


def _region(_: Sweep, case: Case) -> dict[str, float]:
    from palmar.regions.build import build_region

    region = build_region(case)
    record = {"area_m2": region.area}
    if (circle := region.allowed_error) is not None:
        record |= {"error_m": circle.radius, "error_x_m": circle.centre[0], "error_y_m": circle.centre[1]}
    return record


def _plan(sweep: Sweep, case: Case) -> dict[str, float]:
    from palmar.behaviours.policy import approaches, is_guaranteed
    from palmar.studies.plan import plan
    from palmar.studies.three_tips import uncertain_disk

    policy = plan(case, uncertain_disk(sweep.uncertainty), case.start.at, sweep.approaches).found.policy
    sure = is_guaranteed(policy)
    return {"guaranteed": sure, "approaches": float(approaches(policy)) if sure else nan}


ANSWERS = {
    SweepCommand.CLOSURE: (
        "structural", "frictional", "structural_min_m", "structural_max_m", "frictional_min_m", "frictional_max_m",
    ),
    SweepCommand.REGION: ("area_m2", "error_m", "error_x_m", "error_y_m"),
    SweepCommand.PLAN: ("guaranteed", "approaches"),
    SweepCommand.SIMULATE: ("outcome", *ENDS),
    SweepCommand.TESTBED: ("outcome", *ENDS),
}  # fmt: skip
"""Columns of answers."""
OUTCOMES = tuple(each.value for each in Outcome)
