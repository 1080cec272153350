"""A run of a behaviour in one picture: where hand and object began and ended, their ways, and where sensors fired."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from palmar.faces.plots.hand import (
    WALL_ROOM,
    draw_finger,
    draw_object,
    draw_palm,
    draw_wall,
    finger_points,
    object_reach,
)
from palmar.faces.plots.region_picture import millimetre_ticks
from palmar.faces.plots.sheet import MM, Extent, Pad, Room, sheet
from palmar.faces.plots.strokes import DASHES, disc, stroke
from palmar.faces.plots.style import FINE, NORMAL, Role
from palmar.models.case import Case
from palmar.studies.run_behaviour import BehaviourRun
from palmar.worlds.run import Row

ROOM = Room(Pad(3.0, 3.0, 3.0, 5.0), Pad(12.0, 11.0, 2.0, 3.0), Pad(0.0, 0.0, 0.0, 0.0))
MOST_GHOSTS = 6
WAY_LEVEL = 6.5
MARK = 0.008
"""Diameter of a mark where a sensor fired, as a share of the picture's width."""


def trace_picture(done: BehaviourRun) -> Figure:
    """The first pose and those where the hand goes on to something else as ghosts, the last in full; frame of the start."""
    case, rows = done.case, done.trace.rows
    extent = extent_of(case, rows)
    title = f"{done.case.behaviour.name.value}: {done.trace.outcome.value} after {rows[-1].seen.time:.2f} s"
    page = sheet([[extent]], title=title, footer=_footer(done), room=ROOM)
    axes = page.panels[0][0]
    millimetre_ticks(axes)
    for row in _ghosts(rows):
        draw_row(axes, case, row, ghost=True)
    draw_row(axes, case, rows[-1], ghost=False)
    _ways(axes, case, rows)
    draw_still(axes, case, rows[0])
    for row in _firings(rows):
        disc(axes, (MM * row.pose[0], MM * row.pose[1]), MM * MARK * extent.size[0], Role.HELD, level=WAY_LEVEL + 0.5)
    return page.figure


def draw_row(axes: Axes, case: Case, row: Row, *, ghost: bool) -> None:
    """Hand and object at one observation."""
    at = _palm(case, row)
    draw_palm(axes, case.hand, at=at, ghost=ghost)
    for joints, left in ((row.seen.left, True), (row.seen.right, False)):
        draw_finger(axes, case.hand, joints, left=left, at=at, ghost=ghost)
    draw_object(axes, case.object, row.pose[:2], row.pose[2], ghost=ghost)


def draw_still(axes: Axes, case: Case, first: Row) -> None:
    """The wall, if there is one, and the object where it was at first."""
    if case.support.wall is not None:
        draw_wall(axes, case.support.wall)
    draw_object(axes, case.object, first.pose[:2], first.pose[2], ghost=True)


def _palm(case: Case, row: Row) -> tuple[float, float]:
    """Where the middle of the palm is (m): where the arm is told to be, unless a wall keeps it back."""
    x, y, _ = row.seen.arm
    return x, case.palm_ahead(row.seen.right, row.seen.left, y)


def _ways(axes: Axes, case: Case, rows: tuple[Row, ...]) -> None:
    """Of the object, and of the middle of the palm."""
    for points, role, dashes, width in (
        ([row.pose[:2] for row in rows], Role.OBJECT, "-", NORMAL),
        ([_palm(case, row) for row in rows], Role.DIMENSION, DASHES, FINE),
    ):
        way = MM * np.array(points)
        if np.ptp(way, axis=0).max() > 0.0:
            stroke(axes, way, role, level=WAY_LEVEL, width=width, dashes=dashes)


def _ghosts(rows: tuple[Row, ...]) -> list[Row]:
    """The first row, and rows where the hand does something else; the first few if there are many."""
    changes = [rows[0]]
    changes += [row for before, row in pairwise(rows[:-1]) if row.why != before.why]
    return changes[:MOST_GHOSTS]


def _firings(rows: tuple[Row, ...]) -> list[Row]:
    """Rows in which a sensor begins to fire."""
    return [
        row
        for before, row in pairwise(rows)
        if any(now and not then for now, then in zip(row.seen.bits, before.seen.bits, strict=True))
    ]


def extent_of(case: Case, rows: tuple[Row, ...]) -> Extent:
    """All that is shown of a run."""
    size, thick = object_reach(case.object), case.hand.half_thickness
    shown = [*_ghosts(rows), rows[-1]]
    points = [np.array([row.pose[:2] for row in rows]) + corner for corner in (-size, size)]
    for row in shown:
        for joints, left in ((row.seen.left, True), (row.seen.right, False)):
            finger = finger_points(case.hand, joints, left=left) + _palm(case, row)
            points += [finger - thick, finger + thick]
    every = np.concatenate(points)
    if case.support.wall is not None:
        every = np.vstack([every, [every[0, 0], case.support.wall + WALL_ROOM * np.ptp(every[:, 1])]])
    (left_end, bottom), (right_end, top) = every.min(axis=0), every.max(axis=0)
    return Extent(float(left_end), float(bottom), float(right_end), float(top))


def _footer(done: BehaviourRun) -> str:
    what = "Grey: where it began, and where the hand went on to something else. "
    fired = "Dots: where the object was when a sensor began to fire. " if done.trace.sensors else ""
    return f"{what}{fired}The hand's own verdict: {done.verdict.value}."
