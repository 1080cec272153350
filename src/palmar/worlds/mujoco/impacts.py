"""Impacts in free space: contacts as damped springs that give a wanted restitution in the steps that MuJoCo takes.

A contact's force per effective mass is k d - c v at depth d and speed of separation v, never a pull. In continuous time the
restitution is that of Schwager and Poeschel (2007). MuJoCo's step changes the speed first and the depth after it. With
theta = omega dt = 0.03 that returned up to 7 % less or 1 % more, depending on where in a step the contact began, for there
the damper's force jumps. Therefore steps are cut so that a contact begins with one (``Flight``), and k and c are those whose
steps, run one by one, give the restitution. Without damping, k makes an impact last a whole number of steps: energy stays.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import hypot, pi, sin
from typing import Any

from palmar.worlds.mujoco.engine import mujoco

CONTACT_TIME = 5e-3
"""Duration of an impact without damping (s)."""
MOST_DAMPED = 5.0
"""Largest damping ratio of a contact: restitution 0.01; less than that is not told from it."""
GAP = 1e-3
"""Distance (m) from which an approach is watched; contacts that are further apart are not looked for in between."""
CHUNK = 8
"""Steps at once while nothing is near."""
LATE = 1e-3
"""By so much of a step a contact begins before the next one does."""
LONGEST_IMPACT = 100_000
"""Steps."""
PROBE = 0.1
"""Length of the first step, in steps, near another geom."""
SHORT = 1e-6
"""Spans that are shorter, in steps, are none."""


def spring_of(restitution: float, step: float) -> tuple[float, float]:
    """Stiffness (1/s^2) and damping (1/s) per effective mass of contacts in steps of so much (s)."""
    angle = pi / max(2, round(CONTACT_TIME / step))
    theta = 2.0 * sin(0.5 * angle)
    low, high = 0.0, MOST_DAMPED
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if returned(middle, theta) > restitution else (low, middle)
    return (theta / step) ** 2, 2.0 * low * theta / step


def returned(ratio: float, theta: float) -> float:
    """Share of its speed with which a body leaves a spring of this damping ratio; theta: natural frequency times step."""
    depth, speed = LATE * theta, -1.0
    for _ in range(LONGEST_IMPACT):
        if depth <= 0.0:
            break
        push = max(0.0, depth - 2.0 * ratio * speed)
        if push == 0.0 and speed > 0.0:
            break
        speed += theta * push
        depth -= theta * speed
    return max(0.0, speed)


@dataclass
class Flight:
    """A scene in free space, with geom ``thing`` whose x and y are the coordinates from ``first`` on.

    ``tilt_loss``: see ``_tilted``; ``ahead``: by how much (s) the scene is further than it was told to go.
    """

    model: Any
    data: Any
    thing: int
    first: int
    tilt_loss: float = 0.0
    ahead: float = 0.0
    distances: dict[tuple[int, int], float] = field(default_factory=dict)
    before: tuple[float, float] | None = None

    def go(self, seconds: float, step: float) -> None:
        """Let the scene go on; contacts of the thing begin at the start of a step, and no step of theirs is cut."""
        left = seconds - self.ahead
        while left > SHORT * step:
            if self.data.time > 0.0 and not self.data.ncon and left > CHUNK * step:
                self.model.opt.timestep = step
                mujoco.mj_step(self.model, self.data, CHUNK)
                left -= CHUNK * step
            else:
                left -= self._go_by(left, step)
        self.ahead = -left

    def _go_by(self, left: float, step: float) -> float:
        """One step; returns how long (s) it was."""
        mujoco.mj_step1(self.model, self.data)
        now, span = self._near(), min(step, left)
        if now and min(now.values()) < 0.0:
            span = step
        for pair, distance in now.items():
            if pair not in self.distances:
                span = min(span, PROBE * step)  # to know how fast they approach
                break
            approach = (self.distances[pair] - distance) / self.model.opt.timestep
            if 0.0 <= distance < approach * span:
                span = distance / approach + LATE * step
        self.model.opt.timestep, self.distances = span, now
        if self.tilt_loss > 0.0:
            self._tilted(bool(now) and min(now.values()) < 0.0)
        mujoco.mj_step2(self.model, self.data)
        return span

    def _tilted(self, touching: bool) -> None:
        """An impact above a puck's middle tilts it; its edge strikes the table, and friction there slows it (section 6.2.2).

        The edge's impulse is in proportion to that of the impact, so the puck loses ``tilt_loss`` of the speed
        that the impact has given it, at once when it is over, but does not go back.
        """
        velocity = self.data.qvel[self.first : self.first + 2]
        x, y = float(velocity[0]), float(velocity[1])
        if touching and self.before is None:
            self.before = x, y
        elif not touching and self.before is not None:
            given, speed = hypot(x - self.before[0], y - self.before[1]), hypot(x, y)
            if speed > 0.0:
                velocity *= max(0.0, 1.0 - self.tilt_loss * given / speed)
            self.before = None

    def _near(self) -> dict[tuple[int, int], float]:
        """Distances (m) of the pairs of geoms that are near each other, one of them the thing."""
        if not self.data.ncon:
            return {}
        found = zip(self.data.contact.geom.tolist(), self.data.contact.dist.tolist(), strict=True)
        return {(one, other): distance for (one, other), distance in found if self.thing in (one, other)}
