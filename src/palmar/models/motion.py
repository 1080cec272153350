"""What a reflex sees and what it asks for: one observation in, one command out, at every tick."""

from __future__ import annotations

from dataclasses import dataclass

Joints = tuple[float, ...]
"""Of one finger, from the base joint to the tip: angles (rad) or rates (rad/s), closing counted positive."""

Track = tuple[float, float, float, float]
"""Of the object, in the frame where the hand started: x, y (m), vx, vy (m/s)."""


@dataclass(frozen=True)
class Observation:
    """At ``time`` (s): joint angles, which sensors fire, which fingers are held up, and the pose of the arm.

    ``bits`` has one entry for each sensor stretch, in the order of the layout. ``stalled`` (right, left): the finger was
    told to move and does not, because something holds it up by force: the object, the palm, a joint's end, the other
    finger. ``arm`` is (x, y, theta), m and rad, of the hand in the frame where it started. ``track`` is what a tracker
    tells of the object, with its delay and errors; None without one.
    """

    time: float
    right: Joints
    left: Joints
    bits: tuple[bool, ...] = ()
    stalled: tuple[bool, bool] = (False, False)
    arm: tuple[float, float, float] = (0.0, 0.0, 0.0)
    track: Track | None = None


@dataclass(frozen=True)
class Command:
    """Joint rates (rad/s) of both fingers and velocity (m/s) of the arm, until the next command.

    It holds for ``longest`` seconds at most, so that a motion can end between two ticks. ``stop`` ends the behaviour.
    ``why`` says in a few words what it is for.
    """

    right: Joints
    left: Joints
    velocity: tuple[float, float] = (0.0, 0.0)
    longest: float | None = None
    stop: bool = False
    why: str = ""

    @property
    def moves_fingers(self) -> bool:
        """Whether any joint is told to move."""
        return any(self.right) or any(self.left)
