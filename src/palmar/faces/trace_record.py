"""A run of a behaviour as a JSON record: what became of it, and, where it is to be kept, every row."""

from __future__ import annotations

from typing import Any

from palmar.behaviours.verdict import Verdict
from palmar.models.case_file import dump_case, parse_case
from palmar.models.motion import Observation
from palmar.models.outcome import Outcome
from palmar.studies.run_behaviour import BehaviourRun
from palmar.worlds.run import Ended, Row, Trace


def run_record(done: BehaviourRun) -> dict[str, Any]:
    """`palmar behaviours run CASE --json`: fingers left, then right; lengths m, angles rad, times s."""
    trace, last = done.trace, done.trace.rows[-1]
    return {
        "behaviour": done.case.behaviour.name.value,
        "outcome": trace.outcome.value,
        "caught": trace.outcome.caught,
        "verdict": done.verdict.value,
        "ended": trace.ended.value,
        "ambiguous": trace.ambiguous,
        "massive": done.massive,
        "seconds": last.seen.time,
        "start": _pose(done.start),
        "final": {
            **_pose(last.pose),
            "finger_rad": [list(last.seen.left), list(last.seen.right)],
            "arm": _pose(last.seen.arm),
        },
        "peak_force_N": _peaks(trace),
        "events": [{"t_s": each.time, "kind": each.kind, "what": each.what} for each in trace.happenings],
    }


def whole_record(done: BehaviourRun) -> dict[str, Any]:
    """The record with the case and every row, from which ``read_record`` makes the run again."""
    reasons = list(dict.fromkeys(row.why for row in done.trace.rows))
    return {
        **run_record(done),
        "case": dump_case(done.case),
        "sensors": list(done.trace.sensors),
        "reasons": reasons,
        "rows": [
            {
                "t_s": row.seen.time,
                "arm": list(row.seen.arm),
                "right_rad": list(row.seen.right),
                "left_rad": list(row.seen.left),
                "object": list(row.pose),
                "bits": bits_text(row.seen.bits),
                "held_up": bits_text(row.seen.stalled),
                "force_N": _left_first(row.seen.forces),
                "moment_N_m": _left_first(row.seen.moments),
                "track": None if row.seen.track is None else list(row.seen.track),
                "why": reasons.index(row.why),
            }
            for row in done.trace.rows
        ],
    }


def read_record(record: dict[str, Any], name: str) -> BehaviourRun:
    """The run of a ``whole_record``; raises KeyError, TypeError, ValueError or InputError for anything else."""
    rows = tuple(_row(each, record["reasons"]) for each in record["rows"])
    sensors = tuple(str(each) for each in record["sensors"])
    if not rows or any(len(each.seen.bits) != len(sensors) for each in rows):
        raise ValueError("rows are missing or have another number of bits than there are sensors")
    trace = Trace(rows, sensors, Outcome(record["outcome"]), Ended(record["ended"]), bool(record["ambiguous"]))
    start = record["start"]
    place = float(start["x_m"]), float(start["y_m"]), float(start["theta_rad"])
    case = parse_case(record["case"], name)
    return BehaviourRun(case, place, bool(record["massive"]), trace, Verdict(record["verdict"]))


def _left_first(pair: tuple[float, float] | None) -> list[float] | None:
    return None if pair is None else [pair[1], pair[0]]


def _peaks(trace: Trace) -> dict[str, float] | None:
    """The largest force on each finger; None of a world that tells none."""
    right, left = trace.peak_forces or (None, None)
    return None if right is None or left is None else {"left": left, "right": right}


def bits_text(bits: tuple[bool, ...]) -> str:
    """One digit a bit."""
    return "".join("1" if each else "0" for each in bits)


def text_bits(text: str) -> tuple[bool, ...]:
    """The bits of ``bits_text``."""
    if set(text) - {"0", "1"}:
        raise ValueError("bits are 0 or 1")
    return tuple(each == "1" for each in text)


def _row(each: dict[str, Any], reasons: list[str]) -> Row:
    right, left = (tuple(float(angle) for angle in each[name]) for name in ("right_rad", "left_rad"))
    held, told = text_bits(each["held_up"]), each.get("track")
    track = None if told is None else (*_three(told[:3]), float(told[3]))
    forces, moments = (_right_first(each.get(name)) for name in ("force_N", "moment_N_m"))
    seen = Observation(
        float(each["t_s"]), right, left, text_bits(each["bits"]), (held[0], held[1]), _three(each["arm"]), track,
        forces, moments,
    )  # fmt: skip
    return Row(seen, _three(each["object"]), str(reasons[each["why"]]))


def _right_first(pair: list[Any] | None) -> tuple[float, float] | None:
    if pair is None:
        return None
    left, right = (float(each) for each in pair)
    return right, left


def _three(given: list[Any]) -> tuple[float, float, float]:
    x, y, theta = (float(each) for each in given)
    return x, y, theta


def _pose(pose: tuple[float, float, float]) -> dict[str, float]:
    return {"x_m": pose[0], "y_m": pose[1], "theta_rad": pose[2]}
