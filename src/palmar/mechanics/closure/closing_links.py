"""A hand with joint limits, and its fingers as they close link by link until they meet a limit, the palm line or a disk."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class LimitedHand:
    """Half palm and links (m), (lowest, highest) angle of each joint (rad), friction angle, half thickness (m)."""

    half_palm: float
    links: tuple[float, ...]
    limits: tuple[tuple[float, float], ...]
    friction_angle: float = 0.0
    half_thickness: float = 0.0
    crossing: bool = True
    coupling: tuple[float, float, float] | None = None
    """(base angle, distal angle, ratio): the second joint is never behind distal + ratio (psi - base); None: it is free.

    The linkage of one motor a finger: the joints turn together until the first link is held up, then the next goes on.
    """

    @property
    def size(self) -> float:
        """Half palm and finger (m)."""
        return self.half_palm + sum(self.links)


class ClosingLinks:
    """Places one link of the right finger after the other, outside a disk at (0, height); arrays of one shape throughout.

    ``margin`` is what the last link left to its limits (rad, or share of the hand), negative if it broke one; ``rho`` is the
    distance that joint lines keep from the centre (m), ``angles`` the joints' so far (rad).
    """

    def __init__(self, hand: LimitedHand, rho: Floats, height: Floats) -> None:
        self._hand, self._rho, self._height = hand, rho, height
        self._x, self._y = np.full(rho.shape, hand.half_palm), np.zeros(rho.shape)
        self._direction = np.zeros(rho.shape)
        self.angles: list[Floats] = []
        self.margin = np.full(rho.shape, np.inf)

    def touch(self) -> Floats:
        """The next link closes on the disk; returns the elevation of its contact (rad)."""
        low, high, met, reach, tangent = self._next()
        self._place(met, np.minimum.reduce([met - low, high - met, reach]))
        x, y = self._x, self._y - self._height
        return np.where(tangent, met - 0.5 * pi, np.arctan2(y, x))

    def stay_clear(self, share: Floats | None) -> None:
        """The next link closes by this share of the way to disk or limit; None: as nearly straight on as it can."""
        low, high, met, reach, _ = self._next()
        far = np.maximum(np.where(reach < 0.0, high, np.minimum(high, met)), low)
        place = np.clip(self._direction, low, far) if share is None else low + share * (far - low)
        left = np.where(reach < 0.0, high - low, np.minimum(high, met) - low)
        self._place(place, left)

    def _next(self) -> tuple[Floats, Floats, Floats, Floats, NDArray[np.bool_]]:
        """Lowest and highest direction (rad), that which meets the disk, reach left (share), whether met tangentially."""
        hand, k = self._hand, len(self.angles)
        length, (low, high) = hand.links[k], hand.limits[k]
        behind: Floats | float = low
        if hand.coupling is not None and k == 1:
            base, bend, ratio = hand.coupling
            behind = np.maximum(low, bend + ratio * (self.angles[0] - base))
        dip = np.arcsin(np.clip(self._y / length, 0.0, 1.0))
        free = self._y >= length
        lowest = np.where(free, -np.inf, -dip)
        highest = np.where(free, np.inf, pi + dip)
        far = np.hypot(self._x, self._height - self._y)
        towards = np.mod(np.arctan2(self._height - self._y, -self._x), 2.0 * pi)
        tau = np.sqrt(np.maximum(far**2 - self._rho**2, 0.0))
        low_side = (self._rho - length + far) * (self._rho + length - far)
        high_side = (far + length - self._rho) * (far + length + self._rho)
        tip = 2.0 * np.arctan2(np.sqrt(np.maximum(low_side, 0.0)), np.sqrt(np.maximum(high_side, 0.0)))
        tangent = tau <= length
        aside = np.where(tangent, np.arctan2(self._rho, tau), tip)
        reach = (length + self._rho - far) / hand.size
        self._inside = np.where(far < self._rho * (1.0 - 1e-12), (far - self._rho) / hand.size, np.inf)
        return (
            np.maximum(self._direction + behind, lowest), np.minimum(self._direction + high, highest),
            towards - aside, reach, tangent,
        )  # fmt: skip

    def _place(self, direction: Floats, left: Floats) -> None:
        length = self._hand.links[len(self.angles)]
        self.angles.append(direction - self._direction)
        self._direction = direction
        self._x, self._y = self._x + length * np.cos(direction), self._y + length * np.sin(direction)
        self.margin = np.minimum(left, self._inside)
        if not self._hand.crossing:
            self.margin = np.minimum(self.margin, (self._x - self._hand.half_thickness) / self._hand.size)
