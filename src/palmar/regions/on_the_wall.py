"""Of objects that rest on a wall: where along it they may be to be caught (section 3.3.3, against a constraining surface).

Such an object has one coordinate less, so the region is a set of intervals of x. Starts on a grid along the wall are carried
by the stepping kernel, and every end of a run of caught ones is bisected. What may happen between two neighbours of the
grid is not bounded: ``sampled``.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from palmar.geometry.polygon import turned
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import moved_poses, slider_body
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.regions.moving import ArmMotion, caught

Floats = NDArray[np.float64]
Spans = tuple[tuple[float, float], ...]
NODES = 512
"""Starts along a finger's length."""
HALVINGS = 14


def resting_height(case: Case) -> float:
    """y (m) of the object's frame where the object, at the case's orientation, rests on the wall."""
    assert case.support.wall is not None
    thing = case.object
    top = thing.radius if isinstance(thing, Disk) else float(turned(thing.vertices, case.start.theta)[:, 1].max())
    return case.support.wall - top


def resting_spans(case: Case, arm: ArmMotion) -> Spans:
    """Intervals of x (m) from which an object that rests on the case's wall is caught."""
    slider = slider_of(case.object, case.support)
    body, motion = slider_body(slider, case.contact.friction), straight_motion(case.hand, case.support.wall)
    height = resting_height(case)

    def held(x: Floats) -> NDArray[np.bool_]:
        poses = np.column_stack([x, np.full(len(x), height), np.full(len(x), case.start.theta)])
        return caught(motion, body, moved_poses(slider.centre, poses, 1.0), arm)

    length = case.hand.finger_length
    side = case.hand.half_palm + length + body.reach + float(np.hypot(*slider.centre))
    x = np.linspace(-side, side, 2 * round(NODES * side / length) + 1)
    found = np.concatenate([[False], held(x), [False]])
    begins, ends = np.flatnonzero(found[1:] & ~found[:-1]), np.flatnonzero(found[:-1] & ~found[1:]) - 1
    step = float(x[1] - x[0])
    low, high = _bisected(held, x[begins], -step), _bisected(held, x[ends], step)
    return tuple((float(a), float(b)) for a, b in zip(low, high, strict=True) if b > a)


def _bisected(held: Callable[[Floats], NDArray[np.bool_]], inside: Floats, step: float) -> Floats:
    """The last caught place between each caught one and its lost neighbour at ``step`` (m)."""
    outside = inside + step
    for _ in range(HALVINGS):
        if len(inside) == 0:
            break
        middle = 0.5 * (inside + outside)
        yes = held(middle)
        inside, outside = np.where(yes, middle, inside), np.where(yes, outside, middle)
    return inside
