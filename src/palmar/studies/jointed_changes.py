"""What would let two jointed line fingers hold a disk, and how the radii they hold move with the hand's dimensions.

The limits are closed forms of half palm, links and friction angle; their slopes are differences over a small step, and
the nearest sufficient value of a dimension is looked for on a grid and then bisected.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import atan, cos, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.closure.disk_2_2 import frictional_radii, structural_radii
from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
from palmar.mechanics.closure.sizing import Dimension
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.hand import Fingers
from palmar.models.objects import Disk
from palmar.studies.closure import Change, Slope, Verdict

Floats = NDArray[np.float64]
STEP = 1e-6
"""Of a difference, in half palm and links together, or rad."""
REACH, GRID, FINER, ROUNDS = 30.0, 601, 513, 3
"""Sufficient values are looked for up to so many times the length, and down to that part of it, on so many nodes."""
MOST_FRICTION = 100.0


@dataclass(frozen=True)
class _Dimensions:
    """Half palm, proximal and distal link (m), friction angle (rad): numbers, or one of them an array."""

    half_palm: float | Floats
    proximal: float | Floats
    distal: float | Floats
    alpha: float | Floats
    crossing: bool

    @property
    def largest(self) -> Floats:
        """The largest radius held (m); NaN where none is."""
        return np.asarray(largest_with_friction(self.half_palm, self.proximal, self.distal, self.alpha), dtype=float)

    @property
    def smallest(self) -> Floats:
        """Of straight fingers; 0 where fingers of one plane can bend until their tips meet."""
        body = np.asarray(self.half_palm), np.asarray(self.proximal) + np.asarray(self.distal)
        plain = structural_radii(*body, crossing=self.crossing).min
        low = (
            np.fmin(plain, frictional_radii(*body, self.alpha, crossing=self.crossing).min)
            if np.any(self.alpha)
            else plain
        )
        low = np.nan_to_num(np.asarray(low, dtype=float), nan=0.0)
        meet = (np.abs(np.asarray(self.proximal) - np.asarray(self.distal)) <= self.half_palm) & (
            self.half_palm <= body[1]
        )
        return np.where(meet & (not self.crossing), 0.0, low)


_FIELDS: dict[Dimension | int, str] = {Dimension.HALF_PALM: "half_palm", 1: "proximal", 2: "distal"}
_FRICTION: dict[Dimension | int, str] = {Dimension.FRICTION_ANGLE: "alpha"}


def changes_and_slopes(case: Case, verdict: Verdict) -> tuple[tuple[Change, ...], tuple[Slope, ...]]:
    """For two line links a finger without joint limits; links are counted from the palm."""
    hand, alpha = case.hand, case.contact.friction_angle
    proximal, distal = hand.finger_links
    plain = _Dimensions(hand.half_palm, proximal, distal, 0.0, hand.fingers is Fingers.CROSSING)
    rough = replace(plain, alpha=alpha)
    pairs = ((Closure.STRUCTURAL, plain, verdict.structural), (Closure.FRICTIONAL, rough, verdict.frictional))
    assert isinstance(case.object, Disk)
    radius = case.object.radius
    changes = [each for closure, at, held in pairs if not held for each in _changes(closure, at, radius)]
    slopes = [each for closure, at, _ in pairs for each in _slopes(closure, at)]
    return tuple(changes), tuple(slopes)


def _slopes(closure: Closure, at: _Dimensions) -> Iterator[Slope]:
    if np.isnan(at.largest):
        return
    size = float(at.half_palm + at.proximal + at.distal)
    for dimension, field in {**_FIELDS, **(_FRICTION if at.alpha else {})}.items():
        now, step = float(getattr(at, field)), STEP * (1.0 if field == "alpha" else size)
        moved = _with(at, field, now + step * np.array([-1.0, 0.0, 1.0]))
        scale = {"half_palm": 0.5, "alpha": cos(now) ** 2}.get(field, 1.0) / step
        low, high = scale * np.diff(moved.smallest), scale * np.diff(moved.largest)
        yield Slope(closure, dimension, (float(low[0]), float(low[1])), (float(high[0]), float(high[1])))


def _changes(closure: Closure, at: _Dimensions, radius: float) -> Iterator[Change]:
    for dimension, field in {**_FIELDS, **(_FRICTION if closure is Closure.FRICTIONAL else {})}.items():
        now = float(getattr(at, field))
        nodes = now * np.geomspace(1.0 / REACH, REACH, GRID)
        if field == "alpha":
            nodes = np.unique(np.append(np.linspace(0.0, atan(MOST_FRICTION), GRID), now))
        to = _nearest(at, field, nodes, radius)
        if to is not None:
            yield Change(closure, dimension, _shown(field, now), _shown(field, to))


def _nearest(at: _Dimensions, field: str, nodes: Floats, radius: float) -> float | None:
    """The value nearest to the present one, on the side that suffices of a bracket between nodes; None without one."""
    now = float(getattr(at, field))
    held = _holds(at, field, nodes, radius)
    ends = []
    for k in np.flatnonzero(held[1:] != held[:-1]):
        good, bad = (nodes[k + 1], nodes[k]) if held[k + 1] else (nodes[k], nodes[k + 1])
        for _ in range(ROUNDS):
            finer = np.linspace(bad, good, FINER)
            first = int(np.argmax(_holds(at, field, finer, radius) | (np.arange(FINER) == FINER - 1)))
            bad, good = finer[max(first - 1, 0)], finer[first]
        ends.append(float(good))
    return min(ends, key=lambda each: abs(each - now), default=None)


def _holds(at: _Dimensions, field: str, values: Floats, radius: float) -> NDArray[np.bool_]:
    moved = _with(at, field, values)
    return np.asarray((moved.smallest <= radius) & (radius <= moved.largest))


def _with(at: _Dimensions, field: str, values: Floats) -> _Dimensions:
    given: dict[str, Any] = {field: values}
    return replace(at, **given)


def _shown(field: str, value: float) -> float:
    """Half palm -> palm width, friction angle -> friction coefficient, as the case file has them."""
    return tan(value) if field == "alpha" else 2.0 * value if field == "half_palm" else value
