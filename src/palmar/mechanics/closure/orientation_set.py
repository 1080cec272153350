"""Sets of orientations as closed intervals, found from a yes or no at any orientation."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.closure.polygon_outline import FULL_TURN, Bools, Floats

IntervalArray = NDArray[np.float64]
"""Sorted disjoint closed intervals (K, 2) of angles in rad: starts in [0, 2 pi), an end above 2 pi wraps around."""

NARROW = 1e-9
"""Intervals narrower than this (rad) are single orientations, gaps narrower than this are closed."""
RESOLUTION = 1e-10
SECTIONS = 64


def orientation_set(holds: Callable[[Floats], Bools], samples: Floats) -> IntervalArray:
    """Intervals (K, 2) in rad on which a condition holds, from its values at samples in [0, 2 pi).

    The ends are found to within 1e-10 rad. What the samples do not show, an interval or a gap between two of them, is
    missed. A single sample at which alone the condition holds is returned as [sample, sample].
    """
    angles = np.unique(samples)
    held = holds(angles)
    if held.all():
        return np.array([[0.0, FULL_TURN]])
    if not held.any():
        return np.empty((0, 2))
    before = np.roll(held, 1)
    begins, ends = np.flatnonzero(held & ~before), np.flatnonzero(held & ~np.roll(held, -1))
    if ends[0] < begins[0]:
        ends = np.roll(ends, -1)
    previous, following = np.roll(angles, 1)[begins], np.roll(angles, -1)[ends]
    previous = np.where(previous < angles[begins], previous, previous - FULL_TURN)
    following = np.where(following > angles[ends], following, following + FULL_TURN)
    edges = _last_held(holds, np.concatenate([angles[begins], angles[ends]]), np.concatenate([previous, following]))
    starts, stops = edges[: len(begins)], edges[len(begins) :]
    stops = np.where(ends < begins, stops + FULL_TURN, stops)
    alone = stops - starts < NARROW
    starts, stops = np.where(alone, angles[begins], starts), np.where(alone, angles[begins], stops)
    return _joined(starts, stops)


def total_measure(intervals: IntervalArray) -> float:
    """Total length (rad) of disjoint intervals (K, 2)."""
    return float((intervals[:, 1] - intervals[:, 0]).sum())


def contains(intervals: IntervalArray, orientations: Floats) -> Bools:
    """Whether each orientation (M,) in rad, modulo a full turn, lies in one of the intervals, ends included."""
    angle = np.mod(orientations, FULL_TURN)[:, None]
    once = (angle >= intervals[:, 0]) & (angle <= intervals[:, 1])
    wrapped = angle + FULL_TURN <= intervals[:, 1]
    inside: Bools = np.logical_or.reduce(once | wrapped, axis=1)
    return inside


def _last_held(holds: Callable[[Floats], Bools], inside: Floats, outside: Floats) -> Floats:
    """Last orientation at which the condition holds on the way from one where it does to one where it does not."""
    inside, outside = inside.copy(), outside.copy()
    while np.abs(outside - inside).max() > RESOLUTION:
        shares = np.arange(1, SECTIONS) / SECTIONS
        between = inside[:, None] + (outside - inside)[:, None] * shares
        held = holds(between.ravel()).reshape(between.shape)
        run = np.where(held.all(axis=1), SECTIONS - 1, np.argmin(held, axis=1))
        steps = (outside - inside) / SECTIONS
        outside = np.where(run < SECTIONS - 1, inside + steps * (run + 1), outside)
        inside = inside + steps * run
    return inside


def _joined(starts: Floats, stops: Floats) -> IntervalArray:
    """Intervals with starts in [0, 2 pi), sorted, with the narrow gaps between them closed."""
    turns = np.floor(starts / FULL_TURN) * FULL_TURN
    starts, stops = starts - turns, stops - turns
    order = np.argsort(starts)
    starts, stops = starts[order], stops[order]
    following = np.append(starts[1:], starts[0] + FULL_TURN)
    narrow = following - stops < NARROW
    if narrow.all():
        return np.array([[0.0, FULL_TURN]])
    while narrow[-1]:  # let no interval that is to be joined to the next be the last one
        starts, stops, narrow = np.roll(starts, 1), np.roll(stops, 1), np.roll(narrow, 1)
        starts[0], stops[0] = starts[0] - FULL_TURN, stops[0] - FULL_TURN
    first = np.append(True, ~narrow[:-1])
    joined = np.column_stack([starts[first], stops[~narrow]])
    joined += np.where(joined[:, :1] < 0.0, FULL_TURN, 0.0)
    return joined[np.argsort(joined[:, 0])]
