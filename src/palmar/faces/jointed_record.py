"""Closure of jointed fingers, and maps of it, as the JSON records of the command line."""

from __future__ import annotations

from typing import Any

from palmar.faces.records import changes_record, slopes_record
from palmar.mechanics.closure.stance import Stance
from palmar.models.hand import Hand
from palmar.studies.closure import RadiusRange
from palmar.studies.closure_map import ClosureMap
from palmar.studies.jointed_closure import JointedClosure
from palmar.studies.jointed_reason import Intervals, carriers


def jointed_record(hand: Hand, result: JointedClosure) -> dict[str, Any]:
    """`palmar closure CASE --json` for fingers with joints."""
    verdict = result.object
    return {
        "structural": _held(result.structural, result.intervals[0]),
        "frictional": _held(result.frictional, result.intervals[1]),
        "object": {"structural": verdict.structural, "frictional": verdict.frictional, "reason": verdict.reason},
        "cases": {name: _case(known) for name, known in result.cases.items()},
        "largest": _hold(hand, result.largest[1]),
        "kept_straight": {"structural": _range(result.straight[0]), "frictional": _range(result.straight[1])},
        "changes": changes_record(result.changes),
        "slopes": slopes_record(result.slopes),
        "notes": list(result.notes),
    }


def map_record(result: ClosureMap) -> dict[str, Any]:
    """`palmar closure map --json`: flat lists; no grasp or no such hand is NaN here and null in JSON."""
    return {
        "distal": result.distal.tolist(),
        "proximal": result.proximal.tolist(),
        "radius_max": {name: each.tolist() for name, each in result.radius_max.items()},
        "radius_min": {name: each.tolist() for name, each in result.radius_min.items()},
    }


def _range(radii: RadiusRange | None) -> dict[str, float] | None:
    return None if radii is None else {"radius_min_m": radii.radius_min, "radius_max_m": radii.radius_max}


def _case(known: Intervals) -> dict[str, Any] | None:
    if not known:
        return None
    ends = {"radius_min_m": known[0][0], "radius_max_m": known[-1][1]}
    return ends if len(known) == 1 else {**ends, "intervals_m": [list(each) for each in known]}


def _held(radii: RadiusRange | None, intervals: Intervals) -> dict[str, Any] | None:
    known = _range(radii)
    return {**known, "intervals_m": [list(each) for each in intervals]} if known and intervals else known


def _hold(hand: Hand, hold: Stance | None) -> dict[str, Any] | None:
    if hold is None:
        return None
    return {
        "radius_m": hold.radius,
        "centre_m": [0.0, hold.height],
        "right_joints_m": hold.joints(hand.half_palm, hand.finger_links)[: hold.last].tolist(),
        "right_angles_rad": list(hold.angles),
        "contacts": carriers(hold),
    }
