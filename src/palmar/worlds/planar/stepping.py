"""Closing on any disk or convex polygon on a table, by the stepping kernel: thick, colliding and jointed hands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.pushing.closing import Ends
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.closing_events import ENDS, HALTS, LEAVES, STALLS, STICKS, TOUCHES
from palmar.mechanics.pushing.closing_frames import carry_frames
from palmar.mechanics.pushing.closing_steps import BATCH_TOLERANCE, TOLERANCE, carry, carry_all
from palmar.mechanics.pushing.hand_pose import HandMotion
from palmar.mechanics.pushing.polygon_contacts import Body
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import moved_poses, slider_body
from palmar.models.case import Case
from palmar.worlds.planar.events import Event
from palmar.worlds.planar.table import Trace

Floats = NDArray[np.float64]
MOST_EVENTS = 400
BATCH = 300
"""More starts than these are carried to the tolerance for batches."""
_KINDS = {TOUCHES: "touch", LEAVES: "leave", STICKS: "stick", STALLS: "stall", ENDS: "end"}


@dataclass(frozen=True)
class SteppingWorld:
    """A closing hand and a body; the body's frame is carried to its centre of pressure at ``centre`` (m) and back."""

    motion: HandMotion
    body: Body
    centre: tuple[float, float]

    def ends(self, starts: ArrayLike) -> Ends:
        """How each start (N, 3) = x, y, theta of the object's frame ends: to ``BATCH_TOLERANCE`` if there are many."""
        poses = moved_poses(self.centre, np.asarray(starts, dtype=float), 1.0)
        tolerance = BATCH_TOLERANCE if len(poses) > BATCH else TOLERANCE
        codes, ends, _ = carry_all(self.motion, self.body, poses, tolerance=tolerance)
        return Ends(codes, moved_poses(self.centre, ends[:, :3], -1.0), ends[:, 3:])

    def trace(self, start: tuple[float, float, float], frames: int) -> Trace:
        """Poses of the object's frame at ``frames`` equal steps of the closing angle."""
        last = max(self.motion.last, float(self.ends([start]).fingers.max()))
        angles = np.linspace(self.motion.first, last, frames)
        poses, fingers = carry_frames(
            self.motion, self.body, moved_poses(self.centre, np.array([start]), 1.0)[0], angles
        )
        return Trace(angles, moved_poses(self.centre, poses, -1.0), fingers)

    def events(self, start: tuple[float, float, float], outcome: str) -> tuple[Event, ...]:
        """The events of one start in order; the last one is the end, its body the outcome."""
        x, y, theta = moved_poses(self.centre, np.array([start]), 1.0)[0]
        end, log = carry(self.motion, self.body, x, y, theta, events=MOST_EVENTS)
        known = [self.event(float(psi), int(kind), int(who)) for psi, kind, who in log if int(kind) != ENDS]
        return (*known, Event(max(end.right, end.left), "end", outcome))

    def event(self, psi: float, kind: int, who: int) -> Event:
        """What the kernel's log calls by numbers."""
        if kind == HALTS:
            return Event(psi, "halt", "arm")
        if kind == STALLS:
            return Event(psi, "stall", ("right_finger", "left_finger")[who])
        count = len(self.motion.links)
        finger, joint = divmod(who - 1, count)
        if who == 0 or who > 2 * count:
            return Event(psi, _KINDS.get(kind, "slide"), "palm" if who == 0 else "wall")
        part = f"{('right', 'left')[finger]}_link" + (f"_{joint + 1}" if count > 1 else "")
        return Event(psi, _KINDS.get(kind, "slide"), part)


def stepping_world(case: Case) -> SteppingWorld:
    """The world of a case on a table."""
    slider = slider_of(case.object, case.support)
    return SteppingWorld(
        straight_motion(case.hand, case.support.wall), slider_body(slider, case.contact.friction), slider.centre
    )
