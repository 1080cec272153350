"""Results as the JSON records of the command line: SI units and radians, None where there is nothing."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from shapely import MultiPolygon

from palmar.geometry.planar_set import Circle, coordinates, seen_from_object
from palmar.mechanics.closure.sizing import Dimension
from palmar.models.outcome import Outcome
from palmar.regions.region import Region
from palmar.studies.closure import Change, ClosureAnswer, RadiusRange, Slope
from palmar.studies.sizing import Sizing

if TYPE_CHECKING:
    from palmar.mechanics.pushing.closing import Ends
    from palmar.studies.compare import Comparison
    from palmar.studies.simulate import Simulation

_NAMES = {
    Dimension.HALF_PALM: "palm_width",
    Dimension.FINGER_LENGTH: "finger_length",
    Dimension.FRICTION_ANGLE: "friction",
}


def finite(value: Any) -> Any:
    """The same nested value with None for every number that JSON does not know."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: finite(each) for key, each in value.items()}
    return [finite(each) for each in value] if isinstance(value, list | tuple) else value


def closure_record(result: ClosureAnswer) -> dict[str, Any]:
    """`palmar closure CASE --json`."""
    return {
        "structural": _range(result.structural),
        "frictional": _range(result.frictional),
        "object": {
            "structural": result.object.structural,
            "frictional": result.object.frictional,
            "reason": result.object.reason,
            **({} if result.polygon is None else {"polygon": result.polygon.record()}),
        },
        "changes": changes_record(result.changes),
        "slopes": slopes_record(result.slopes),
        "notes": list(result.notes),
    }


def changes_record(changes: tuple[Change, ...]) -> list[dict[str, Any]]:
    """Lengths in m, friction as such."""
    return [
        {"closure": each.closure.value, "dimension": _name(each.dimension), "now": each.now, "to": each.to}
        for each in changes
    ]


def slopes_record(slopes: tuple[Slope, ...]) -> list[dict[str, Any]]:
    """On decreasing and on increasing the dimension: m per m, or m per unit of friction."""
    return [
        {
            "closure": each.closure.value,
            "dimension": _name(each.dimension),
            "radius_min": list(each.radius_min),
            "radius_max": list(each.radius_max),
        }
        for each in slopes
    ]


def _name(dimension: Dimension | int) -> str:
    return _NAMES[dimension] if isinstance(dimension, Dimension) else f"link_{dimension}"


def sizing_record(result: Sizing) -> dict[str, Any]:
    """`palmar closure size --json`; an end of null means however large."""
    return {
        "sought": _NAMES[result.sought],
        "radius_min_m": result.radius_min,
        "radius_max_m": result.radius_max,
        "intervals_m": [list(each) for each in result.intervals],
        "reason": result.reason or None,
    }


def region_record(region: Region, *, from_object: bool = False) -> dict[str, Any]:
    """`palmar region CASE --json`; with ``from_object`` the sets hold hand positions relative to the object."""
    view = seen_from_object if from_object else (lambda given: given)
    return {
        **{name: coordinates(view(each)) for name, each in region_sets(region).items()},
        **region_facts(region, from_object=from_object),
    }


def region_sets(region: Region) -> dict[str, MultiPolygon]:
    """The sets (m) a region consists of, by their names in the record."""
    sets = {"centre": region.centre, "contact": region.contact, "whole": region.whole}
    sides = {"outer": region.outer, "certain": region.certain}
    return sets | {name: each for name, each in sides.items() if each is not None}


def region_facts(region: Region, *, from_object: bool = False) -> dict[str, Any]:
    """A region's record without its sets."""
    return {
        "model": region.model.value,
        "closure": region.closure.value,
        "guarantee": region.guarantee.value,
        "frame": "object" if from_object else "hand",
        "area_m2": region.area,
        "allowed_error": _circle(region.allowed_error, from_object),
        **({} if region.outer is None else {"band_m2": region.band}),
        **({} if region.certain is None else _simulated(region, region.certain)),
        **({} if region.resting is None else {"resting_m": region.resting}),
        "flattening_m": region.flattening,
        "reason": region.reason,
        "notes": list(region.notes),
    }


def comparison_record(result: Comparison) -> dict[str, Any]:
    """`palmar region CASE --compare A,B --json`."""
    return {
        "regions": {each.model.value: region_record(each) for each in result.regions},
        "reaches": [
            {
                "angle_rad": each.angle,
                "distance_m": dict(zip((region.model.value for region in result.regions), each.distances, strict=True)),
            }
            for each in result.reaches
        ],
        "differences": [
            {
                "promised_by": each.promised_by.value,
                "denied_by": each.denied_by.value,
                "area_m2": float(each.where.area),
                "where": coordinates(each.where),
                "start_m": list(each.start),
                "outcome": None if each.outcome is None else each.outcome.value,
                "end_m": None if each.end is None else list(each.end),
            }
            for each in result.differences
        ],
    }


def _simulated(region: Region, certain: MultiPolygon) -> dict[str, Any]:
    return {
        "certain_area_m2": float(certain.area),
        "theta_rad": list(region.orientations or ()),
        "spacing_m": region.spacing,
    }


def simulation_record(result: Simulation) -> dict[str, Any]:
    """`palmar simulate CASE --json`."""
    x, y, theta = result.pose
    return {
        "outcome": result.outcome.value,
        "caught": result.outcome.caught,
        "final": {"x_m": x, "y_m": y, "theta_rad": theta, "finger_rad": [list(result.left), list(result.right)]},
        "events": [{"t_s": time, "kind": each.kind, "body": each.body} for time, each in result.events],
    }


def starts_record(ends: Ends) -> dict[str, Any]:
    """`palmar simulate CASE --starts FILE --json`: one entry a row, in order."""
    outcomes = [Outcome.from_code(int(code)) for code in ends.codes]
    return {
        "results": [
            {"outcome": each.value, "caught": each.caught, "x_m": x, "y_m": y, "theta_rad": theta}
            for each, (x, y, theta) in zip(outcomes, ends.poses.tolist(), strict=True)
        ]
    }


def _range(radii: RadiusRange | None) -> dict[str, float] | None:
    return None if radii is None else {"radius_min_m": radii.radius_min, "radius_max_m": radii.radius_max}


def _circle(circle: Circle | None, from_object: bool) -> dict[str, Any]:
    if circle is None:
        return {"centre_m": None, "radius_m": 0.0}
    sign = -1.0 if from_object else 1.0
    return {"centre_m": [sign * each for each in circle.centre], "radius_m": circle.radius}
