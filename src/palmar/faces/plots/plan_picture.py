"""A plan's hardest branch, drawn move by move: where the object may be, what is felt, and the proof at the end."""

from __future__ import annotations

from dataclasses import replace
from math import degrees

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from shapely import MultiPolygon, affinity
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.policy import (
    Approach,
    Close,
    Lost,
    Policy,
    approaches,
    is_guaranteed,
    leaves,
    seen_turned,
)
from palmar.faces.plan_record import sensor_name
from palmar.faces.plots.areas import LEGEND_ROW, Band, draw_area, legend
from palmar.faces.plots.facts import Fact, write_facts
from palmar.faces.plots.hand import draw_hand, draw_object, finger_points
from palmar.faces.plots.region_picture import ROOM, millimetre_ticks
from palmar.faces.plots.sheet import MARGIN, Extent, sheet
from palmar.faces.plots.style import Role
from palmar.geometry.planar_set import areal
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.regions.exact import exact_region
from palmar.studies.plan import Plan

BELIEF = Band(Role.LARGEST, "where the object's centre may be", 2.0)
FELT = Band(Role.HELD, "where it may be once this sensor has fired", 3.0)
OTHER = Band(Role.SMALLEST, "where it may be once another has", 2.5, dashes=(0, (2, 1)))
REGION = Band(Role.CENTRE, "from here closing catches it for certain", 1.0)
BANDS = (BELIEF, FELT, OTHER, REGION)
MOST_PANELS = 4
LEAST = 1.5e-3
"""Beliefs thinner than this share of the picture are drawn that thick."""


def plan_picture(case: Case, plan: Plan) -> Figure:
    """A panel for each move of the branch with the most approaches, then the least margin, each in the hand's frame."""
    whole = _hardest(plan.found.policy)
    branch = _shortened(whole)
    extents = [[_extent(case, policy, plan)] for policy, _ in branch]
    room = replace(ROOM, sides=replace(ROOM.sides, bottom=LEGEND_ROW * 2 + 2.0))
    page = sheet(
        extents,
        title="Where the object may be, move by move",
        footer=_footer(plan, len(whole) - len(branch)),
        room=room,
    )
    for (policy, sensor), (axes,), (extent,) in zip(branch, page.panels, extents, strict=True):
        millimetre_ticks(axes)
        if isinstance(policy, Approach):
            _draw_approach(axes, case, policy, sensor, extent)
        else:
            _draw_end(axes, case, policy, plan, extent)
        write_facts(page, axes, _facts(policy, sensor, plan))
    legend(page, (MARGIN, page.box(page.panels[-1][0]).bottom - ROOM.outside.bottom), list(BANDS))
    return page.figure


def _hardest(policy: Policy) -> list[tuple[Policy, int | None]]:
    """Moves from the root to the hardest end, each with the sensor that then fires (None: nothing, or the end)."""
    if isinstance(policy, Close) and policy.otherwise is not None:
        return [(policy, None), *_hardest(policy.otherwise)]
    if not isinstance(policy, Approach):
        return [(policy, None)]
    worst = max(
        policy.branches, key=lambda each: (_is_lost(each.then), approaches(each.then), -_least_margin(each.then))
    )
    return [(policy, worst.sensor), *_hardest(worst.then)]


def _is_lost(policy: Policy) -> bool:
    return not is_guaranteed(policy)


def _least_margin(policy: Policy) -> float:
    return min(each.place.margin if isinstance(each, Close) else 0.0 for each in leaves(policy))


def _shortened(branch: list[tuple[Policy, int | None]]) -> list[tuple[Policy, int | None]]:
    """The first and last moves of a branch too long for a picture."""
    return branch if len(branch) <= MOST_PANELS else branch[: MOST_PANELS // 2] + branch[-(MOST_PANELS // 2) :]


def _extent(case: Case, policy: Policy, plan: Plan) -> Extent:
    """Hand and belief, seen from the hand as it stands for this move."""
    x, y = _stand(policy)
    left, bottom, right, top = _seen(policy).bounds
    size = case.object.radius if isinstance(case.object, Disk) else 0.0
    opening = policy.opening if not isinstance(policy, Lost) else case.hand.open
    reach = abs(finger_points(case.hand, (opening,))).max(axis=0) + case.hand.half_thickness
    seen = Extent(left - x - size, bottom - y - size, right - x + size, top - y + size)
    seen = seen.joined(Extent(-reach[0], -case.hand.half_thickness, reach[0], reach[1]))
    return seen.joined(Extent(*_region(case, policy, plan).bounds)) if isinstance(policy, Close) else seen


def _region(case: Case, policy: Close, plan: Plan) -> MultiPolygon:
    opened = case.model_copy(update={"hand": case.hand.model_copy(update={"open": policy.opening})})
    return exact_region(opened, plan.closure).centre


def _seen(policy: Policy) -> BaseGeometry:
    """The belief as the hand sees it once it has turned."""
    return policy.belief if isinstance(policy, Lost) else seen_turned(policy.belief, policy.turn)


def _stand(policy: Policy) -> tuple[float, float]:
    if isinstance(policy, Approach):
        return policy.x, policy.y
    return (policy.place.x, policy.place.y) if isinstance(policy, Close) else (0.0, 0.0)


def _draw_approach(axes: Axes, case: Case, policy: Approach, sensor: int | None, extent: Extent) -> None:
    thick = LEAST * max(extent.size)
    draw_area(axes, areal(affinity.translate(_seen(policy), -policy.x, -policy.y).buffer(thick)), BELIEF)
    for each in policy.branches:
        if each.sensor is not None:
            draw_area(axes, areal(each.belief.buffer(thick)), FELT if each.sensor == sensor else OTHER)
    draw_hand(axes, case.hand, policy.opening)


def _draw_end(axes: Axes, case: Case, policy: Policy, plan: Plan, extent: Extent) -> None:
    x, y = _stand(policy)
    thick = LEAST * max(extent.size)
    if isinstance(policy, Close):
        draw_area(axes, _region(case, policy, plan), REGION)
        draw_hand(axes, case.hand, policy.opening)
    else:
        draw_hand(axes, case.hand, case.hand.open)
    belief = affinity.translate(_seen(policy), -x, -y)
    draw_area(axes, areal(belief.buffer(thick)), BELIEF)
    middle = belief.representative_point()
    draw_object(axes, case.object, (middle.x, middle.y), fill=0.5)


def _facts(policy: Policy, sensor: int | None, plan: Plan) -> list[Fact]:
    """What the move is, and what it leads to."""
    left, bottom, right, top = (1e3 * each for each in _seen(policy).bounds)
    known = ("the object is known within", f"{right - left:.4g} mm across, {top - bottom:.4g} mm along", BELIEF.role)
    if isinstance(policy, Approach):
        felt = sensor_name(sensor, plan) or "nothing is felt"
        head = f"{_turning(policy.turn)}pproach, at most {1e3 * policy.distance:.4g} mm, until a sensor fires"
        return [("", head, Role.CAPTION), known, ("then, say", felt, FELT.role)]
    if isinstance(policy, Close):
        margin = f"{1e3 * policy.place.margin:.3g} mm"
        what = "Close: caught for certain" if policy.otherwise is None else "Close: caught if it is here"
        return [("", what, Role.CAPTION), known, ("to spare", margin, REGION.role)]
    return [("", "No way on", Role.LOST), known]


def _turning(turn: float) -> str:
    return "A" if turn == 0.0 else f"Turn by {degrees(turn):.4g} deg, a"


def _footer(plan: Plan, left_out: int) -> str:
    between = f" {left_out} moves in its middle are left out." if left_out else ""
    moved, off = (f"{1e3 * each:.4g} mm" for each in (plan.doubt.displacement, plan.doubt.pose_error))
    return f"The hardest branch.{between} Object moves at most {moved} before it is felt, pose error at most {off}."
