"""A run of a behaviour as a film: the hand, the object, which sensors fire, and what the hand does and why."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from palmar.faces.plots.gif import Picture, rendered, write_gif
from palmar.faces.plots.region_picture import millimetre_ticks
from palmar.faces.plots.sheet import MARGIN, Extent, Pad, Room, sheet
from palmar.faces.plots.style import HEADING_SIZE, Role
from palmar.faces.plots.trace_picture import draw_row, draw_still, extent_of
from palmar.studies.run_behaviour import BehaviourRun
from palmar.worlds.run import Row

ROOM = Room(Pad(3.0, 6.0, 3.0, 5.0), Pad(12.0, 11.0, 2.0, 3.0), Pad(0.0, 4.0, 0.0, 0.0))
MOST, DELAY, LAST = 120, 60, 2500
"""Pictures at most; milliseconds of a picture, and of the last."""


def write_trace_film(path: Path, done: BehaviourRun) -> None:
    """Write a GIF of a run, at equal steps of time."""
    rows, extent = _shown(done), extent_of(done.case, done.trace.rows)
    write_gif(path, [_picture(done, each, extent) for each in rows], DELAY, LAST)


def _shown(done: BehaviourRun) -> list[Row]:
    """Rows at equal steps of time, the last one being the end."""
    rows = done.trace.rows
    times = np.array([row.seen.time for row in rows])
    wanted = np.linspace(times[0], times[-1], min(len(rows), MOST))
    return [rows[k] for k in np.searchsorted(times, wanted, side="right") - 1]


def _picture(done: BehaviourRun, row: Row, extent: Extent) -> Picture:
    page = sheet([[extent]], title=f"{done.case.behaviour.name.value}: {row.seen.time:.2f} s", room=ROOM)
    axes = page.panels[0][0]
    millimetre_ticks(axes)
    draw_still(axes, done.case, done.trace.rows[0])
    draw_row(axes, done.case, row, ghost=False)
    ended = row is done.trace.rows[-1]
    firing = [name for name, fires in zip(done.trace.sensors, row.seen.bits, strict=True) if fires]
    felt = f"feels {', '.join(firing)}" if firing else ("feels nothing" if done.trace.sensors else "")
    page.write((MARGIN, MARGIN + 5.0), felt, size=HEADING_SIZE, role=Role.CAPTION)
    words = f"{row.why}: {done.trace.outcome.value}" if ended else row.why
    page.write((MARGIN, MARGIN), words, size=HEADING_SIZE, bold=True, role=Role.CAPTION)
    return rendered(page.figure)
