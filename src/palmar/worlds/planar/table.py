"""Closing on an object on a table: from a case and its starts to how each ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.closing import Ends, close_disk
from palmar.mechanics.pushing.closing_case import closing_hand
from palmar.mechanics.pushing.closing_tables import ClosingHand, Tables, build_tables
from palmar.mechanics.pushing.limit_surface import LimitSurface
from palmar.mechanics.pushing.resting import slider_of
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.support import SupportKind


@dataclass(frozen=True)
class TableWorld:
    """A hand that closes on a disk on a table; built once for a case, then asked for any number of starts."""

    hand: ClosingHand
    surface: LimitSurface
    tables: Tables

    def ends(self, starts: ArrayLike, *, last: float | None = None) -> Ends:
        """How each start (N, 2), in m, ends; ``last`` (rad) stops the fingers earlier."""
        hand = self.hand
        if last is not None:
            hand = hand._replace(last=min(last, hand.last), alone=min(last, hand.alone))
        return close_disk(hand, self.surface, starts, self.tables)


def refuse_uncovered(case: Case) -> None:
    """Raise NotCoveredError for cases that no planar kernel carries on a table."""
    if case.support.kind is not SupportKind.TABLE:
        raise NotCoveredError('support.kind = "free": this world is the table')
    if case.ranges:
        raise NotCoveredError("a simulation takes plain numbers, not ranges")


def covered(case: Case) -> bool:
    """Whether the event-to-event kernel carries the case: disks pressed about their centre, before no wall."""
    refuse_uncovered(case)
    centred = isinstance(case.object, Disk) and case.support.pressure_centre == (0.0, 0.0)
    return centred and case.support.wall is None


def table_world(case: Case) -> TableWorld:
    """The event-to-event world of a case; raises NotCoveredError where it does not cover it."""
    if not covered(case) or not isinstance(case.object, Disk):
        raise NotCoveredError("this needs a disk pressed about its centre, and no wall")
    hand = closing_hand(case.hand, case.object.radius, case.contact.friction)
    surface = slider_of(case.object, case.support).surface
    return TableWorld(hand, surface, build_tables(hand, surface))


@dataclass(frozen=True)
class Trace:
    """One start over time: base angles psi (K,) of fingers that do not stall, poses (K, 3), base angles (K, 2).

    Where a finger's joints all move, instead of base angles those of all joints (K, 2 links), right finger's first.
    """

    psi: NDArray[np.float64]
    poses: NDArray[np.float64]
    fingers: NDArray[np.float64]


def trace(world: TableWorld, start: tuple[float, float], frames: int) -> Trace:
    """Poses at ``frames`` equal steps of the closing angle: the motion stopped at each of them."""
    last = max(world.hand.last, float(world.ends([start]).fingers.max()))
    angles = np.linspace(world.hand.first, last, frames)
    ends = [world.ends([start], last=float(angle)) for angle in angles]
    poses = np.concatenate([each.poses for each in ends])
    fingers = np.concatenate([each.fingers for each in ends])
    return Trace(angles, poses, np.minimum(fingers, angles[:, None]))
