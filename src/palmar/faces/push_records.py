"""Pushes and what was identified from them as the JSON records of the command line, in SI units and radians."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from palmar.mechanics.pushing.push import Pushed
from palmar.studies.identify import NAMES, Identified
from palmar.studies.pushes import EndErrors


@dataclass(frozen=True)
class Trial:
    """An identification on some of the pushes, and end errors on the others: as the case says, and as identified."""

    found: Identified
    before: EndErrors
    after: EndErrors
    share: float
    seed: int


def push_record(pushed: Pushed, errors: EndErrors | None) -> dict[str, Any]:
    """`palmar push CASE --paths FILE --json`: one pose a row, in order; errors where the file holds recorded ends."""
    return {
        "poses": pushed.poses.tolist(),
        "outcomes": [each.name.lower() for each in pushed.outcomes],
        "ambiguous": pushed.ambiguous.tolist(),
        "mean_errors": None if errors is None else mean_record(errors),
    }


def trial_record(trial: Trial) -> dict[str, Any]:
    """`palmar identify CASE --pushes FILE --json`; every ``..._error`` is one standard error."""
    found, offsets = trial.found, trial.found.registration
    return {
        "friction": found.friction,
        "friction_error": found.friction_error,
        "length_m": found.length,
        "length_error_m": found.length_error,
        "centre_m": list(found.centre),
        "centre_error_m": list(found.centre_error),
        "pressure": {name: float(value) for name, value in found.pressure._asdict().items()},
        "covariance": {"of": list(NAMES), "values": found.covariance.tolist()},
        "registration": {
            "path_m": list(offsets.path),
            "outline_m": list(offsets.outline),
            "turn_rad": offsets.turn,
            "starts": offsets.starts,
        },
        "pushes": {"fitted": found.pushes, "tested": len(trial.after.position)},
        "share": trial.share,
        "seed": trial.seed,
        "mean_errors": {"before": mean_record(trial.before), "after": mean_record(trial.after)},
    }


def mean_record(errors: EndErrors) -> dict[str, float]:
    """Mean distance and mean angle between predicted and recorded ends."""
    return {"position_m": float(errors.position.mean()), "angle_rad": float(errors.angle.mean())}


def shape_list(shapes: Sequence[str]) -> str:
    """The shapes that a file of pushes names, for a message."""
    return ", ".join(dict.fromkeys(each for each in shapes if each)) or "none"
