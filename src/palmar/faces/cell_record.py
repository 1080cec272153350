"""What the trials of the 3-D cell came to, as a record."""

from __future__ import annotations

from dataclasses import asdict
from math import inf
from typing import TYPE_CHECKING, Any

from palmar.geometry.planar_set import coordinates

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from palmar.behaviours.cell.grasp_height import GraspHeights
    from palmar.studies.cell_prediction import Predicted
    from palmar.studies.cell_trials import CellReport
    from palmar.studies.cell_workspace import Workspace
    from palmar.worlds.cell.timing import Timing


def cell_record(report: CellReport, note: str | None = None) -> dict[str, Any]:
    """Of a report: counts, settings, and every trial; ``note``: why the eye is not the one that was asked for."""
    asked = report.trials
    return {
        "task": asked.kind.value,
        "trials": asked.number,
        "success": report.success,
        "unsafe": report.unsafe,
        "failures": report.failures,
        "approaches": {str(number): count for number, count in report.approaches.items()},
        "late_replies": sum(each.missed for each in report.results),
        "eye": asked.eye.value,
        "eye_note": note,
        "seed": asked.seed,
        "error_m": asked.error,
        "exact_error": asked.exact,
        "tension_noise_n": asked.tension_noise,
        "vision_latency_s": asked.latency,
        "wrist_turn_rad": asked.turn,
        "fault": asked.fault.value,
        "simulated_s": sum(each.seconds for each in report.results),
        "real_time_factor": report.real_time_factor,
        "results": [asdict(each) for each in report.results],
        "real_time": bool(report.timings),
    } | (timing_record(report) if report.timings else {})


def timing_record(report: CellReport) -> dict[str, Any]:
    """How well trials in real time kept their times (s), all of them together; and one by one."""
    from palmar.worlds.cell.timing import percentiles

    kept = report.kept
    return {
        "jitter_s": percentiles(each.late for each in kept),
        "slipped_s": sum(each.slipped for each in kept),
        "reply_s": percentiles(each.replies for each in kept),
        "requests": sum(each.asked for each in kept),
        "missed_deadlines": sum(each.missed for each in kept),
        "malformed_replies": sum(each.malformed for each in kept),
        "sightings": {
            name: sum(getattr(each.sightings, name) for each in kept)
            for name in ("received", "stale", "dropped", "malformed")
        },
        "real_time_priority": bool(kept) and all(each.ranked for each in kept),
        "timings": [None if each is None else _of_one(each) for each in report.timings],
    }


def _of_one(timing: Timing) -> dict[str, Any]:
    return {
        "fault_s": timing.fault_s,
        "at_rest_s": timing.at_rest,
        "real_time_factor": timing.simulated / timing.wall,
        "most_late_s": float(timing.late.max()),
        "slowest_reply_s": float(timing.replies.max()) if len(timing.replies) else None,
    }


def prediction_record(task: str, found: tuple[Predicted, ...], heights: GraspHeights | None) -> dict[str, Any]:
    """Of `palmar cell predict`: radii of the errors that are allowed, and for a pick at which heights the tips push."""
    return {
        "task": task,
        "certain": [
            {
                "approaches": each.approaches,
                "error_m": each.error,
                "along_across_m": each.along_across,
                "why": each.why,
                "guarantee": each.guarantee.value,
            }
            for each in found
        ],
        "heights": None if heights is None else heights_record(heights),
    }


def heights_record(heights: GraspHeights) -> dict[str, Any]:
    """Of the palm and the tips over the table (m), as `GraspHeights` has them."""
    return {
        "palm_m": [heights.lowest, heights.highest],
        "pushes_m": list(heights.pushes),
        "slides_up_to_m": None if heights.bound == inf else heights.bound,
        "topples_at_rim_m": heights.rim,
        "refusal": heights.refusal,
    }


def workspace_record(
    task: str, found: Workspace, at: tuple[float, float], error: float, region: BaseGeometry
) -> dict[str, Any]:
    """Of `palmar cell workspace`: GeoJSON coordinates in m, of places in the base, of the region about the axis."""
    with_error, served = found.with_error(error), found.served(region, at)
    return {
        "task": task,
        "guarantee": found.guarantee.value,
        "spacing_m": found.spacing,
        "palm_heights_m": list(found.heights),
        "area_m2": found.places.area,
        "places": coordinates(found.places),
        "error_m": error,
        "area_with_error_m2": with_error.area,
        "places_with_error": coordinates(with_error),
        "at_m": list(at),
        "room_m": found.room(at),
        "served": found.room(at) >= error,
        "region_area_m2": region.area,
        "region_served": coordinates(served),
        "region_share": served.area / region.area,
    }
