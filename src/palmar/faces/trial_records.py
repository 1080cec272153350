"""Records of trials in a world: a region put to the test, and limits found by trial and error."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from palmar.regions.region import Region

if TYPE_CHECKING:
    from palmar.studies.limits import Limit
    from palmar.studies.validate import Tried, Validation


def validation_record(result: Validation, region: Region, settings: dict[str, Any]) -> dict[str, Any]:
    """`palmar validate CASE --json`."""
    surprises = [_tried(each) for each in result.surprises]
    return {
        "samples": len(result.tried),
        **{
            side: {
                word: result.count(inside=inside, caught=caught) for word, caught in (("caught", True), ("lost", False))
            }
            for side, inside in (("inside", True), ("outside", False))
        },
        "worst": surprises[0] if surprises else None,
        "surprises": surprises,
        "agreement": _agreement(result),
        "guarantee": region.guarantee.value,
        "area_m2": region.area,
        "reason": region.reason,
        **settings,
    }


def limits_record(found: tuple[Limit, ...], settings: dict[str, Any]) -> dict[str, Any]:
    """`palmar testbed limits CASE --json`."""
    return {
        "trials": sum(len(each.trials) for each in found),
        "limits": [
            {
                "angle_rad": each.angle,
                "limit_m": each.distance,
                "predicted_m": each.predicted,
                "difference_m": None if each.difference is None else each.difference,
                "trials": [
                    {"distance_m": one.distance, "placed_m": list(one.placed), "outcome": one.outcome.value}
                    for one in each.trials
                ],
            }
            for each in found
        ],
        **settings,
    }


def _agreement(result: Validation) -> dict[str, Any] | None:
    """With the planar world, None where that is the world."""
    same, alike = (result.agreeing(exactly=each) for each in (True, False))
    if same is None:
        return None
    return {"same": same, "alike": alike, "disputed": [_tried(each) for each in result.disputed]}


def _tried(each: Tried) -> dict[str, Any]:
    x, y, theta = each.start
    return {
        "x_m": x,
        "y_m": y,
        "theta_rad": theta,
        "inside": each.inside,
        "boundary_distance_m": each.distance,
        "outcome": each.outcome.value,
        "planar": None if each.planar is None else each.planar.value,
        "planar_changes_within_m": each.aside,
    }
