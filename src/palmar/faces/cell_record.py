"""What the trials of the 3-D cell came to, as a record."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from palmar.studies.cell_trials import CellReport


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
    }
