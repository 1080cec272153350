"""The runtime: a behaviour and a world, tick by tick, until the behaviour ends; and what happened, to be kept."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

from palmar.behaviours.reflex import Reflex
from palmar.models.motion import Joints, Observation
from palmar.models.outcome import Outcome
from palmar.worlds.world import World

LONGEST = 600.0
"""A behaviour that has not ended after so long (s) is cut off."""


class Ended(Enum):
    """Why a run is over."""

    STOPPED = "stopped"
    """The behaviour ended by itself."""
    CUT_OFF = "cut_off"
    """It went on for longer than allowed."""
    BROKEN = "broken"
    """The world could not go on: an invalid start, or a motion that could not be found."""


@dataclass(frozen=True)
class Row:
    """One observation, the object's pose with it (both in the frame of the start), and what was done next, and why."""

    seen: Observation
    pose: tuple[float, float, float]
    why: str


@dataclass(frozen=True)
class Happening:
    """At ``time`` (s): a sensor ``fires`` or is ``quiet`` again, a finger is ``held_up``, or the behaviour ``does``."""

    time: float
    kind: str
    what: str


@dataclass(frozen=True)
class Trace:
    """A run from its first observation to its last. ``sensors`` names the bits; ``ambiguous``: see ``feedback``."""

    rows: tuple[Row, ...]
    sensors: tuple[str, ...]
    outcome: Outcome
    ended: Ended
    ambiguous: bool = False

    @property
    def happenings(self) -> tuple[Happening, ...]:
        """Every change of bits, of fingers held up, and of what the behaviour does."""
        found: list[Happening] = []
        bits: tuple[bool, ...] = (False,) * len(self.sensors)
        stalled, why = (False, False), ""
        for row in self.rows:
            time = row.seen.time
            for name, before, now in zip(self.sensors, bits, row.seen.bits, strict=True):
                if before != now:
                    found.append(Happening(time, "fires" if now else "quiet", name))
            for side, before, now in zip(("right_finger", "left_finger"), stalled, row.seen.stalled, strict=True):
                if now and not before:
                    found.append(Happening(time, "held_up", side))
            if row.why != why:
                found.append(Happening(time, "does", row.why))
            bits, stalled, why = row.seen.bits, row.seen.stalled, row.why
        return tuple(found)

    @property
    def peak_forces(self) -> tuple[float, float] | None:
        """Largest force (N) on the right and the left finger; None of a world that tells none."""
        told = [row.seen.forces for row in self.rows if row.seen.forces is not None]
        return (max(each[0] for each in told), max(each[1] for each in told)) if told else None

    @property
    def joints(self) -> tuple[Joints, Joints]:
        """Final joint angles (rad), right and left."""
        return self.rows[-1].seen.right, self.rows[-1].seen.left


def run(world: World, reflex: Reflex[Any], sensors: tuple[str, ...] = (), longest: float = LONGEST) -> Trace:
    """Let a behaviour act on a world until it ends, or for ``longest`` (s) at most."""
    seen = world.observe()
    state = reflex.begin(seen)
    rows: list[Row] = []
    ended = Ended.BROKEN
    while not world.broken:
        state, command = reflex.step(state, seen)
        rows.append(Row(seen, world.pose, command.why))
        if command.stop or seen.time >= longest:
            ended = Ended.STOPPED if command.stop else Ended.CUT_OFF
            break
        world.act(command, world.tick)
        seen = world.observe()
    if ended is Ended.BROKEN:
        rows.append(Row(seen, world.pose, "the world cannot go on"))
    return Trace(tuple(rows), sensors, world.outcome(), ended, world.ambiguous)
