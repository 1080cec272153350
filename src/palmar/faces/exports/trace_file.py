"""A run of a behaviour as a file, and back: JSON (SI) or CSV (mm, degrees) for programs, drawings and films for people."""

from __future__ import annotations

import csv
import io
import json
from math import degrees, radians
from pathlib import Path
from typing import Any

from palmar.errors import InputError
from palmar.faces.exports.whole_file import write_whole
from palmar.faces.records import finite
from palmar.faces.trace_record import read_record, whole_record
from palmar.models.text_file import read_text
from palmar.studies.run_behaviour import BehaviourRun

DRAWN = (".svg", ".pdf", ".png")
ENDINGS = (".json", ".csv", ".gif", *DRAWN)
LARGEST_FILE = 200_000_000
NOTE = "# "
"""Begins the CSV's first lines: everything but the rows, as one line of JSON."""
POSES = ("x_mm", "y_mm", "theta_deg")
TRACK = ("track_x_mm", "track_y_mm", "track_vx_mm_s", "track_vy_mm_s")
FORCES = ("force_left_N", "force_right_N", "moment_left_N_m", "moment_right_N_m")


def known_ending(path: Path) -> None:
    """Raise InputError unless the path's ending is one that can be written."""
    if path.suffix.lower() not in ENDINGS:
        raise InputError("--out", str(path), f"the name must end in one of {', '.join(ENDINGS)}")


def write_trace(path: Path, done: BehaviourRun) -> None:
    """Write a run whole or not at all; raises InputError for an unknown ending, OutputError where that fails."""
    known_ending(path)
    ending = path.suffix.lower()
    if ending in DRAWN:
        from palmar.faces.plots.style import save
        from palmar.faces.plots.trace_picture import trace_picture

        save(trace_picture(done), path)
        return
    if ending == ".gif":
        from palmar.faces.plots.trace_film import write_trace_film

        write_trace_film(path, done)
        return
    record = finite(whole_record(done))
    text = json.dumps(record, allow_nan=False) if ending == ".json" else _csv(record)
    write_whole(path, lambda partial: _write_text(partial, text))


def read_trace(path: Path) -> BehaviourRun:
    """The run in a JSON or CSV file that ``write_trace`` wrote; raises InputError in one line."""
    text = read_text(path, LARGEST_FILE)
    try:
        record = json.loads(text) if path.suffix.lower() == ".json" else _from_csv(text)
        return read_record(record, str(path))
    except (ValueError, KeyError, TypeError, IndexError, RecursionError):
        raise InputError(str(path), None, "is no trace that palmar behaviours run wrote (json or csv)") from None


def _write_text(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")


def _csv(record: dict[str, Any]) -> str:
    out = io.StringIO()
    out.write(NOTE + json.dumps({key: value for key, value in record.items() if key != "rows"}) + "\n")
    rows = record["rows"]
    joints, tracked, felt = (
        range(len(rows[0]["right_rad"])),
        *(rows[0][key] is not None for key in ("track", "force_N")),
    )
    writer = csv.writer(out, lineterminator="\n")
    angles = [f"{side}_{k + 1}_deg" for side in ("right", "left") for k in joints]
    writer.writerow(
        ["t_s", *(f"arm_{each}" for each in POSES), *angles, *(f"object_{each}" for each in POSES),
         *(TRACK if tracked else ()), *(FORCES if felt else ()), "bits", "held_up", "why"]
    )  # fmt: skip
    for row in rows:
        turned = [degrees(each) for each in (*row["right_rad"], *row["left_rad"])]
        # A leading mark keeps spreadsheets from reading 010 as ten.
        bits = (f"b{row[name]}" for name in ("bits", "held_up"))
        writer.writerow(
            [row["t_s"], *_to_file(row["arm"]), *turned, *_to_file(row["object"]),
             *(1e3 * each for each in row["track"] or ()), *(row["force_N"] or ()), *(row["moment_N_m"] or ()),
             *bits, record["reasons"][row["why"]]]
        )  # fmt: skip
    return out.getvalue()


def _from_csv(text: str) -> dict[str, Any]:
    first, _, rest = text.partition("\n")
    if not first.startswith(NOTE):
        raise ValueError("no first line")
    record: dict[str, Any] = json.loads(first.removeprefix(NOTE))
    known = {why: number for number, why in enumerate(record["reasons"])}
    record["rows"] = [_csv_row(row, known) for row in csv.DictReader(io.StringIO(rest))]
    return record


def _csv_row(row: dict[str, str], known: dict[str, int]) -> dict[str, Any]:
    def joints(side: str) -> list[float]:
        return [radians(float(value)) for key, value in row.items() if key.startswith(f"{side}_")]

    def pose(name: str) -> list[float]:
        x, y, theta = (float(row[f"{name}_{each}"]) for each in POSES)
        return [1e-3 * x, 1e-3 * y, radians(theta)]

    return {
        "t_s": row["t_s"],
        "arm": pose("arm"),
        "right_rad": joints("right"),
        "left_rad": joints("left"),
        "object": pose("object"),
        "track": [1e-3 * float(row[each]) for each in TRACK] if TRACK[0] in row else None,
        "force_N": [float(row[each]) for each in FORCES[:2]] if FORCES[0] in row else None,
        "moment_N_m": [float(row[each]) for each in FORCES[2:]] if FORCES[0] in row else None,
        "bits": row["bits"].removeprefix("b"),
        "held_up": row["held_up"].removeprefix("b"),
        "why": known[row["why"]],
    }


def _to_file(pose: list[float]) -> list[float]:
    return [1e3 * pose[0], 1e3 * pose[1], degrees(pose[2])]
