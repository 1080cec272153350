"""Which advance of the arm, before or while closing, makes the region large enough, with the least travel."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import Circle, inscribed_circle
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.models.case import Case
from palmar.models.support import SupportKind
from palmar.regions.moving import ArmMotion, moving_sets

SPACING = 1.0 / 64.0
"""Of simulated starts, in finger lengths."""
HALVINGS, FARTHEST = 7, 4.0
"""Steps of the search for the least travel, and the most travel looked at, in finger lengths."""


class Way(Enum):
    """How the arm moves; the source's two, and their combination."""

    FIRST = "move and grab"
    """All of the travel before the fingers move."""
    WHILE = "move while closing"
    """All of it while they close, evenly per radian."""
    BOTH = "half first"
    """Half of it before, half while they close."""

    def motion(self, travel: float, sweep: float) -> ArmMotion:
        """``travel`` (m) in all, over fingers that turn by ``sweep`` (rad)."""
        first = {Way.FIRST: travel, Way.WHILE: 0.0, Way.BOTH: 0.5 * travel}[self]
        return ArmMotion(first, (travel - first) / sweep)


@dataclass(frozen=True)
class Travel:
    """The least travel (m) found for an uncertainty, how it is divided, and the largest circle of the region then."""

    way: Way
    travel: float
    motion: ArmMotion
    room: Circle


def room_of(case: Case, motion: ArmMotion) -> Circle | None:
    """The largest circle (m) in the region of a motion; None if nothing is caught."""
    centre = moving_sets(case, motion, SPACING * case.hand.finger_length).centre
    return None if centre.is_empty else inscribed_circle(centre, 1e-3 * case.hand.finger_length)


def least_travel(case: Case, radius: float, way: Way) -> Travel | None:
    """The least travel with which any place known within ``radius`` (m) is caught; None within ``FARTHEST``.

    More travel is taken to allow no less error, as it does in every case looked at; the answer itself is simulated.
    """
    if case.support.kind is not SupportKind.TABLE or case.ranges:
        raise NotCoveredError("arm motions are for objects on a table, and plain numbers")
    motion = straight_motion(case.hand)
    sweep, length = motion.last - motion.first, case.hand.finger_length

    def tried(travel: float) -> Travel | None:
        arm = way.motion(travel, sweep)
        room = room_of(case, arm)
        return Travel(way, travel, arm, room) if room is not None and room.radius >= radius else None

    found = tried(0.0)
    if found is not None:
        return found
    low, high = 0.0, 0.25 * length
    while (found := tried(high)) is None:
        low, high = high, 2.0 * high
        if high > FARTHEST * length:
            return None
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        better = tried(middle)
        if better is None:
            low = middle
        else:
            high, found = middle, better
    return found
