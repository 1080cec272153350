"""A run of a behaviour under feedback, to play like a closing motion: what is felt and done are its events."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.faces.plots.film_scene import VERDICTS, angle_words, pace_of, place_words
from palmar.faces.plots.hand import object_reach
from palmar.faces.studio.answers.drawing import MM, bounds, finger_lines, millimetres
from palmar.geometry.polygon import turned
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.jointed_motion import JOINTED_CLOSING
from palmar.models.support import SupportKind
from palmar.studies.run_behaviour import BehaviourRun, Circumstances, run_behaviour
from palmar.worlds.run import Row
from palmar.worlds.world import WorldMaker

FRAMES = 241
Floats = NDArray[np.float64]
_DONE = {"fires": "feels something", "quiet": "feels nothing more", "held_up": "is held up"}


def is_simulated(case: Case) -> bool:
    """Whether ``palmar simulate`` carries the case's motion; else ``palmar behaviours run`` does."""
    return case.behaviour.name is BehaviourName.CLOSE or case.behaviour.name in JOINTED_CLOSING


def performed(case: Case, begin: tuple[float, ...], make: WorldMaker | None) -> BehaviourRun:
    """As ``palmar behaviours run --start``; ``begin``: x, y, theta, vx, vy in SI."""
    x, y, theta, vx, vy = begin
    if case.support.kind is SupportKind.FREE:
        case = case.model_copy(update={"start": case.start.model_copy(update={"velocity": (vx, vy)})})
    return run_behaviour(case, (x, y, theta), Circumstances(make=make))


def motion_of(done: BehaviourRun) -> dict[str, Any]:
    """Everything that moves, at equal steps of time, in the frame in which the hand started."""
    rows, case, outcome = _shown(done), done.case, done.trace.outcome
    lines = [_lines(case, row) for row in rows]
    x, y, theta = done.trace.rows[-1].pose
    duration, reach = rows[-1].seen.time, object_reach(case.object)
    centres = np.array([row.pose[:2] for row in rows])
    return {
        "outcome": outcome.value,
        "caught": outcome.caught,
        "verdict": f"{VERDICTS[outcome]}; it ends at {place_words(x, y)}, turned {angle_words(theta)}",
        "duration_s": duration,
        "pace": pace_of(duration),
        "times_s": [row.seen.time for row in rows],
        "poses": [[MM * row.pose[0], MM * row.pose[1], float(np.degrees(row.pose[2]))] for row in rows],
        "right_mm": [millimetres(right) for right, _ in lines],
        "left_mm": [millimetres(left) for _, left in lines],
        "fingers_deg": [np.degrees([*row.seen.right, *row.seen.left]).tolist() for row in rows],
        "palm_mm": [MM * _ahead(case, row) for row in rows],
        "contacts_mm": [[] for _ in rows],
        "events": _events(done),
        "bounds_mm": bounds([*(each for pair in lines for each in pair), centres - reach, centres + reach]),
    }


def _shown(done: BehaviourRun) -> list[Row]:
    """Rows at equal steps of time, the last one being the end."""
    rows = done.trace.rows
    times = np.array([row.seen.time for row in rows])
    wanted = np.linspace(times[0], times[-1], min(len(rows), FRAMES))
    return [rows[k] for k in np.searchsorted(times, wanted, side="right") - 1]


def _lines(case: Case, row: Row) -> tuple[Floats, Floats]:
    """Joints and tips (m) of both fingers of a hand that its arm has moved."""
    middle = np.array([row.seen.arm[0], _ahead(case, row)])
    right, left = finger_lines(case.hand, row.seen.right, row.seen.left)
    return turned(right, row.seen.arm[2]) + middle, turned(left, row.seen.arm[2]) + middle


def _ahead(case: Case, row: Row) -> float:
    """How far the palm has advanced (m)."""
    return case.palm_ahead(row.seen.right, row.seen.left, row.seen.arm[1])


def _events(done: BehaviourRun) -> list[dict[str, Any]]:
    return [
        {"t_s": each.time, "words": _words(each.kind, each.what), "kind": each.kind, "body": each.what}
        for each in done.trace.happenings
    ]


def _words(kind: str, what: str) -> str:
    """Words without underscores, and numbers with one decimal."""
    short = re.sub(r"\d+\.\d{2,}", lambda found: f"{float(found[0]):.1f}", what.replace("_", " "))
    return f"{short} {_DONE[kind]}" if kind in _DONE else short
