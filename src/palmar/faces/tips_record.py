"""Three tips over a standing cylinder as JSON-ready records and as texts for people."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, inf
from typing import Any

from palmar.behaviours.descent import Closing, Descending, Descent, Stand, descents, is_certain
from palmar.faces.records import region_record
from palmar.mechanics.pushing.cylinder_toppling import Loads, PushHeights, RimBands, push_heights, rim_bands
from palmar.mechanics.pushing.three_tips import CAGE, held_radii
from palmar.regions.region import Region
from palmar.studies.three_tips import Task, Trial

Record = dict[str, Any]


def tips_region_record(task: Task, region: Region) -> Record:
    """`palmar tips region --json`: the region's fields, the caging radius, and the radii these tips can hold."""
    caged, touched, fits = _radii(task)
    return {
        **region_record(region),
        "caging_radius_m": CAGE * (task.radius + task.tips.tip_radius),
        "radii": {"caged_from_m": caged, "three_contacts_from_m": touched, "fits_to_m": fits},
    }


def tips_region_text(task: Task, region: Region) -> str:
    """`palmar tips region`."""
    caged, touched, fits = _radii(task)
    lines = [_heading(task)]
    circle = region.allowed_error
    if circle is None:
        lines.append(f"Nothing is caught: {region.reason}.")
    else:
        lines += [
            f"area of the centre region   {1e4 * region.area:.4g} cm2",
            f"allowed error               {1e3 * circle.radius:.4g} mm in every direction",
            f"guarantee                   {region.guarantee.meaning}",
        ]
    lines += [
        f"caged from a circle of      {1e3 * CAGE * (task.radius + task.tips.tip_radius):.4g} mm",
        f"radii                       caged from {1e3 * caged:.4g} mm, three contacts from {1e3 * touched:.4g} mm,"
        f" up to {1e3 * fits:.4g} mm",
    ]
    return "\n".join(lines)


def _radii(task: Task) -> tuple[float, float, float]:
    return held_radii(task.tips.tip_radius, task.tips.open_radius, task.tips.closed_radius)


def _heading(task: Task) -> str:
    tips = task.tips
    return (
        f"three tips of radius {1e3 * tips.tip_radius:g} mm, circle from {1e3 * tips.open_radius:g} to"
        f" {1e3 * tips.closed_radius:g} mm; a cylinder of radius {1e3 * task.radius:g} mm, friction {task.friction:g}\n"
    )


def descent_record(plan: Descending, most: int, trial: Trial | None) -> Record:
    """`palmar tips plan --json`."""
    certain = is_certain(plan)
    return {
        "guaranteed": certain,
        "approaches_max": descents(plan) if certain else None,
        "policy": _policy(plan) if certain else None,
        "reason": None if certain else f"no plan of at most {most} approaches was found among the moves tried",
        "trial": None
        if trial is None
        else {
            "caught": trial.caught,
            "lost": trial.lost,
            "given_up": trial.given_up,
            "approaches_most": trial.most,
            "approaches_mean": trial.mean,
        },
    }


def _policy(plan: Descending) -> Record:
    if isinstance(plan, Closing):
        return {"move": "stay and close" if plan.there else "close", **_stand(plan.stand), "margin_m": plan.margin}
    if isinstance(plan, Descent):
        branches = [{"felt": list(each.felt), "then": _policy(each.then)} for each in plan.branches]
        return {"move": "come down", **_stand(plan.stand), "branches": branches}
    return {"move": "lost"}


def _stand(stand: Stand) -> Record:
    return {"x_m": stand.x, "y_m": stand.y, "turn_rad": stand.turn, "circle_m": stand.opening}


def descent_text(task: Task, plan: Descending, most: int, trial: Trial | None) -> str:
    """`palmar tips plan`."""
    lines = [_heading(task)]
    if is_certain(plan):
        number = descents(plan)
        lines += [f"Certain, in at most {number} approach{'es' if number > 1 else ''}.", "", *_told(plan, "")]
    else:
        lines.append(f"No plan: none of at most {most} approaches was found among the moves tried.")
    if trial is not None:
        lines += [
            "",
            f"trial: {trial.caught} caught, {trial.lost} lost in closing, {trial.given_up} left by the plan;"
            f" {trial.mean:.2f} approaches in the mean",
        ]
    return "\n".join(lines)


def _told(plan: Descending, indent: str) -> Iterator[str]:
    if isinstance(plan, Closing):
        if plan.there:
            yield f"{indent}stay and close"
        else:
            yield f"{indent}come down at {_at(plan.stand)} and close; {1e3 * plan.margin:.3g} mm to spare"
    elif isinstance(plan, Descent):
        yield f"{indent}come down at {_at(plan.stand)}"
        for each in plan.branches:
            yield f"{indent}  {' and '.join(each.felt)}:"
            yield from _told(each.then, indent + "    ")


def _at(stand: Stand) -> str:
    x, y, turn = 1e3 * stand.x + 0.0, 1e3 * stand.y + 0.0, degrees(stand.turn)
    return f"({x:.1f}, {y:.1f}) mm, turned {turn:.0f} deg, circle {1e3 * stand.opening:.1f} mm"


def closing_heights(task: Task, height: float, table_friction: float) -> Record:
    """At which heights of their centres (m) the tips may close on a cylinder of a height (m): `palmar tips region --height`.

    From where they clear the table to where the cylinder still slides for certain, and the tips meet its side.
    """
    tip = task.tips.tip_radius
    pushes = push_heights(task.radius, table_friction, task.friction)
    bands = rim_bands(task.radius, height, tip, (task.friction, table_friction))
    low, high = tip, min(pushes.surely, height - tip)
    reason = None
    if low > high:
        what = "is lower than a tip" if height - tip < low else "topples at every height that clears the table"
        reason = f"the cylinder {what}"
    return {
        "allowed_m": None if reason else [low, high],
        "reason": reason,
        "slides_up_to_m": _known(pushes.surely),
        "topples_on_landing_from_m": _known(bands.topples),
    }


def heights_text(heights: Record) -> str:
    """The lines that `palmar tips region --height` adds."""
    if heights["allowed_m"] is None:
        return f"heights of the tips         none: {heights['reason']}"
    low, high = heights["allowed_m"]
    rim = heights["topples_on_landing_from_m"]
    said = f"heights of the tips         {1e3 * low:.4g} to {1e3 * high:.4g} mm: there it slides and does not topple"
    landing = "never topples it" if rim is None else f"topples it from {1e3 * rim:.4g} mm from the axis on"
    return f"{said}\na tip landing on its rim    {landing}"


def topple_record(heights: PushHeights, bands: RimBands, push: Loads) -> Record:
    """`palmar tips topple --json`; null: at no height, nowhere, never."""
    return {
        "push_height": {name: _known(each) for name, each in heights._asdict().items()},
        "rim_distance": {name: _known(each) for name, each in bands._asdict().items()},
        "push": {"first": push.first, "topples_N": _known(push.topples), "slides_N": _known(push.slides)},
    }


def _known(value: float) -> float | None:
    return None if value == inf else value


def topple_text(heights: PushHeights, bands: RimBands, push: Loads, tip_height: float) -> str:
    """`palmar tips topple`."""
    rows = [
        f"pushed at {1e3 * tip_height:g} mm without friction at the tip: it {push.first}",
        f"slides for certain if pushed below         {_mm(heights.surely)}",
        f"slides before a frictionless tip below     {_mm(heights.smooth)}",
        f"topples before a level rough tip above     {_mm(heights.level)}",
        "a vertical force on its top face never topples it",
        f"a tip comes to rest on the rim up to       {_mm(bands.lands)} from the axis",
        f"  slips but cannot move it up to           {_mm(bands.blocked)}",
        f"  topples it from                          {_mm(bands.topples)}",
    ]
    return "\n".join(rows)


def _mm(value: float) -> str:
    return "never" if value == inf else f"{1e3 * value:.4g} mm"
