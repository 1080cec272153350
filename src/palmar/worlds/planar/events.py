"""What happens on the way: touches, parts let go, stalls and the end, each at its time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from palmar.worlds.planar.table import TableWorld, Trace, trace

TOUCHING = 1e-7
"""A gap below this share of the finger's length counts as contact."""
_FRAMES = 400
_HALVINGS = 40


@dataclass(frozen=True)
class Event:
    """At base angle ``psi`` (rad) of the moving fingers: touch, leave, stall or end, and the part of the hand."""

    psi: float
    kind: str
    body: str


def events(world: TableWorld, start: tuple[float, float], outcome: str) -> tuple[Event, ...]:
    """The events of one start in order; the last one is the end, its body the outcome."""
    whole = trace(world, start, _FRAMES)
    touching = _contacts(world, whole)
    found = [*_changes(world, start, whole, touching), *_stalls(world, whole)]
    last = float(whole.fingers[-1].max())
    found.append(Event(last, "end", outcome))
    return tuple(sorted(found, key=lambda each: (each.psi, each.kind == "end")))


def _contacts(world: TableWorld, poses: Trace) -> dict[str, NDArray[np.bool_]]:
    """For every part of the hand and every frame, whether it touches the disk."""
    hand = world.hand
    near = TOUCHING * hand.length
    x, y = poses.poses[:, 0], poses.poses[:, 1]
    found = {"palm": (np.abs(x) <= hand.half_palm) & (y - hand.radius < near)}
    for column, name, side in ((0, "right", 1.0), (1, "left", -1.0)):
        psi = poses.fingers[:, column]
        px, c, s = side * x - hand.half_palm, np.cos(psi), np.sin(psi)
        along = np.clip(px * c + y * s, 0.0, hand.length)
        touching = np.hypot(px - along * c, y - along * s) - hand.radius - hand.half_thickness < near
        on_tip = along >= hand.length * (1.0 - 1e-12)
        found[f"{name}_link"], found[f"{name}_tip"] = touching & ~on_tip, touching & on_tip
    return found


def _changes(
    world: TableWorld, start: tuple[float, float], whole: Trace, touching: dict[str, NDArray[np.bool_]]
) -> Iterator[Event]:
    """Touches and losses, each bisected between the two frames that show it."""
    for body, flags in touching.items():
        if flags[0]:
            yield Event(float(whole.psi[0]), "touch", body)
        for k in np.flatnonzero(flags[1:] != flags[:-1]):
            before, after = float(whole.psi[k]), float(whole.psi[k + 1])
            for _ in range(_HALVINGS):
                middle = 0.5 * (before + after)
                if _touches(world, start, middle)[body] == flags[k]:
                    before = middle
                else:
                    after = middle
            yield Event(after, "touch" if flags[k + 1] else "leave", body)


def _touches(world: TableWorld, start: tuple[float, float], psi: float) -> dict[str, bool]:
    ends = world.ends([start], last=psi)
    moment = Trace(np.array([psi]), ends.poses, np.minimum(ends.fingers, psi))
    return {body: bool(flags[0]) for body, flags in _contacts(world, moment).items()}


def _stalls(world: TableWorld, whole: Trace) -> Iterator[Event]:
    for column, name in ((0, "right_finger"), (1, "left_finger")):
        stopped = float(whole.fingers[-1, column])
        if stopped < world.hand.last - 1e-12:
            yield Event(stopped, "stall", name)
