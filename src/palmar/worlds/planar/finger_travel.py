"""How far a finger may go on: to the ends of its joints, and until a link lies on the palm."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi, sin

from palmar.models.hand import Hand
from palmar.models.motion import Joints

HALVINGS = 60
AT_LIMIT = 1e-9
"""A joint this near (rad) to its end has reached it."""
MOMENT = 1e-9
"""Time (s) over which the height of a link that lies on the palm is seen to fall or to rise."""


@dataclass(frozen=True)
class FingerTravel:
    """Link lengths (m), distance h (m) of surface from joint line, (lowest, highest) angle (rad) of each joint."""

    links: tuple[float, ...]
    half_thickness: float
    limits: tuple[tuple[float, float], ...]

    def allowed(self, angles: Joints, rates: Joints) -> Joints:
        """The rates without those of joints that are at their end."""
        return tuple(
            0.0 if (rate > 0.0 and angle >= high - AT_LIMIT) or (rate < 0.0 and angle <= low + AT_LIMIT) else rate
            for angle, rate, (low, high) in zip(angles, rates, self.limits, strict=True)
        )

    def to_joint_end(self, angles: Joints, rates: Joints) -> float:
        """Time (s) until the first joint is at its end; inf if none gets there."""
        times = [inf]
        for angle, rate, (low, high) in zip(angles, rates, self.limits, strict=True):
            if rate != 0.0:
                times.append(((high if rate > 0.0 else low) - angle) / rate)
        return max(min(times), 0.0)

    def to_palm(self, angles: Joints, rates: Joints, span: float) -> float:
        """Time (s) until a link lies on the palm, looked for at the end of ``span`` (s), as short as a tick; else inf."""
        if not any(rates):
            return inf
        if self._is_down(angles):
            falls = self._lowest(_after(angles, rates, MOMENT)) < self._lowest(angles)
            return 0.0 if falls else inf
        if not self._is_down(_after(angles, rates, span)):
            return inf
        low, high = 0.0, span
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if self._is_down(_after(angles, rates, middle)):
                high = middle
            else:
                low = middle
        return high

    def _nodes(self, angles: Joints) -> list[tuple[float, float]]:
        """(height of the far end (m), direction (rad)) of each link."""
        height, direction, nodes = 0.0, 0.0, []
        for length, angle in zip(self.links, angles, strict=True):
            direction += angle
            height += length * sin(direction)
            nodes.append((height, direction))
        return nodes

    def _is_down(self, angles: Joints) -> bool:
        return any(y <= self.half_thickness and direction > 0.5 * pi for y, direction in self._nodes(angles))

    def _lowest(self, angles: Joints) -> float:
        return min(y for y, direction in self._nodes(angles) if direction > 0.5 * pi - 1e-6)


def travel_of(hand: Hand) -> FingerTravel:
    """A hand's fingers; joints without limits end where a link would lie on the one before it."""
    distal = hand.joint_limits[1:] if hand.joint_limits is not None else ((-pi, pi),) * (len(hand.finger_links) - 1)
    return FingerTravel(hand.finger_links, hand.half_thickness, (hand.base_limits, *distal))


def _after(angles: Joints, rates: Joints, time: float) -> Joints:
    return tuple(angle + rate * time for angle, rate in zip(angles, rates, strict=True))
