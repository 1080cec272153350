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
    tells of the object, with its delay and errors; None without one. ``forces`` (N; right, left) are the largest normal
    forces on the fingers since the last observation, ``moments`` (N m) those of the contacts about the base joints now,
    against closing; None in worlds whose impacts take no time.
    """

    time: float
    right: Joints
    left: Joints
    bits: tuple[bool, ...] = ()
    stalled: tuple[bool, bool] = (False, False)
    arm: tuple[float, float, float] = (0.0, 0.0, 0.0)
    track: Track | None = None
    forces: tuple[float, float] | None = None
    moments: tuple[float, float] | None = None


@dataclass(frozen=True)
class Command:
    """Joint rates (rad/s) of both fingers and velocity (m/s) of the arm, until the next command.

    It holds for ``longest`` seconds at most, so that a motion can end between two ticks. ``stop`` ends the behaviour.
    ``torques`` (N m; right, left) of the base joints' motors take the place of their rates, in worlds that tell forces; 0
    lets a finger go.
    ``why`` says in a few words what it is for.
    """

    right: Joints
    left: Joints
    velocity: tuple[float, float] = (0.0, 0.0)
    longest: float | None = None
    stop: bool = False
    why: str = ""
    torques: tuple[float | None, float | None] = (None, None)

    @property
    def moves_fingers(self) -> bool:
        """Whether any joint is told to move."""
        return any(self.right) or any(self.left)
