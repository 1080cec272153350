"""What a world is to a behaviour: something to observe, to act on, and to ask at the end what became of the object."""

from __future__ import annotations

from typing import Protocol

from palmar.models.case import Case
from palmar.models.motion import Command, Observation
from palmar.models.outcome import Outcome
from palmar.worlds.planar.bits import Sensing


class World(Protocol):
    """One hand and one object, from a start on; the planar world and others are such."""

    @property
    def tick(self) -> float:
        """Seconds between two observations."""
        ...

    @property
    def settled(self) -> bool:
        """Whether nothing moves under the last command, or the object cannot be carried any further."""
        ...

    @property
    def broken(self) -> bool:
        """Whether it cannot be carried any further: an invalid start, or a motion that could not be found."""
        ...

    @property
    def ambiguous(self) -> bool:
        """Whether the laws of the world admitted several motions somewhere on the way, of which it took one."""
        ...

    @property
    def pose(self) -> tuple[float, float, float]:
        """Of the object: x, y (m), theta (rad) in the frame where the hand started."""
        ...

    def observe(self) -> Observation:
        """What the hand feels and knows of itself now."""
        ...

    def act(self, command: Command, seconds: float) -> float:
        """Let a command hold for so long, or as long as it allows; returns the seconds it held."""
        ...

    def outcome(self) -> Outcome:
        """What has become of the object, were this the end."""
        ...


class WorldMaker(Protocol):
    """Makes a world of a case, the object's frame at ``start`` (m, rad) in the hand frame, the fingers open.

    ``tick``: seconds between two observations; ``sensing``: faults of the sensors, None as the case says; ``massive``:
    whether touch does not move the object while only the arm moves. Raises NotCoveredError for what the world does not
    have.
    """

    def __call__(
        self, case: Case, start: tuple[float, float, float], *, tick: float, sensing: Sensing | None, massive: bool
    ) -> World:
        """The world."""
        ...
