"""The least finger that reaches around a disk far enough to hold it, for a palm of any width, in closed form.

A disk of radius R is held if contacts reach up to the elevation -alpha on both sides, alpha being the friction angle.
From its base joint at (D, 0) a finger whose joint line may not come nearer than rho = R + h to the centre at (0, R) leads
there along a tangent of length t and then in pieces rho tan a, two for every link after the first: tan is convex, so the
2 (n - 1) pieces that share what is left of the way, A, are equal. Where the place at -alpha is seen from the base joint
(A <= 0) the straight way there is shortest; one link must do with that, or pinch the disk off the palm. Palm and links
together are shortest where all pieces are equal: half of a regular polygon, 4 n R tan((pi - 2 alpha) / 4 n) long. Derived
in docs/derivations/design.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, inf, pi, sin, tan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.mechanics.closure.disk_2_2 import Radii, frictional_radii, structural_radii

Floats = NDArray[np.float64]
NODES, ROUNDS = 801, 6
WIDEST = 4.0
"""Half palms looked at reach up to so many (R + h)."""
ROUNDING, SEEN = 1e-9, 1e-13


@dataclass(frozen=True)
class Wrap:
    """Fingers of ``links`` links, 2 ``half_thickness`` (m) thick, about disks of ``smallest`` to ``largest`` radius (m)."""

    links: int
    smallest: float
    largest: float
    friction_angle: float
    half_thickness: float = 0.0
    crossing: bool = True

    def least_length(self) -> float:
        """Length (m) of the shortest hand, palm and both fingers, whatever its proportions: line fingers' bound."""
        pieces = 4.0 * self.links
        return pieces * self.largest * tan((pi - 2.0 * self.friction_angle) / pieces)

    def least_finger(self, half_palm: ArrayLike) -> Floats:
        """The shortest finger (m) that holds the largest and the smallest disk, for half palms (m); inf where none does.

        The smallest asks for more where the palm is so wide that the fingers do not reach each other's base joint.
        """
        d = np.asarray(half_palm, dtype=float)
        small = replace(self, largest=self.smallest)
        _, left = small._tangent_and_rest(d)
        return np.maximum(self._around_one(d), np.where(left <= 0.0, small._straight_there(d), 0.0))

    def _around_one(self, d: Floats) -> Floats:
        tangent, left = self._tangent_and_rest(d)
        pieces = 2.0 * (self.links - 1)
        around = tangent + self._rho * pieces * np.tan(np.clip(left / pieces, 0.0, 1.5)) if pieces else inf
        found = np.where(left <= SEEN, self._straight_there(d), around)
        found = np.where(d**2 + self.largest**2 >= self._rho**2, found, inf)
        return np.minimum(found, self._pinched(d))

    def _pinched(self, d: Floats) -> Floats:
        """Off the palm, by friction alone: straight fingers lean out by alpha and touch at -alpha (equation 2.1)."""
        s, c = sin(self.friction_angle), cos(self.friction_angle)
        if s == 0.0:
            return np.full(d.shape, inf)
        length = np.maximum((self._rho * c - d) / s, 0.0)
        return np.where(length * c + self._rho * s >= self.largest, length, inf)

    def _straight_there(self, d: Floats) -> Floats:
        """Length (m) of a straight finger that touches at -alpha, or at the place nearest to its base joint above that."""
        x, y = self._top
        pointing = np.arctan2(self.largest, d) <= self.friction_angle
        return np.where(pointing, np.hypot(d, self.largest) - self._rho, np.hypot(x - d, y))

    def links_of(self, half_palm: float, finger: float) -> tuple[float, ...]:
        """Links (m) of a finger of that length: the pieces of the least one, what is more spread over all."""
        tangent, left = self._tangent_and_rest(np.array(half_palm))
        if self.links == 1 or left <= SEEN or finger >= float(self._pinched(np.array(half_palm))):
            return (finger / self.links,) * self.links
        piece = self._rho * tan(float(left) / (2.0 * (self.links - 1)))
        least = [float(tangent) + piece, *[2.0 * piece] * (self.links - 2), piece]
        return tuple(each * finger / sum(least) for each in least)

    def shortest(
        self, palm: tuple[float, float], finger: tuple[float, float], reach: float = 0.0
    ) -> tuple[float, float] | None:
        """Half palm and finger (m) of the shortest hand with half palm and finger in these limits; None where none is.

        ``reach`` (m): the finger is at least so long for another reason.
        """
        low, high = palm[0], min(palm[1], max(palm[0], WIDEST * self._rho))
        least, best = max(finger[0], reach), None
        for _ in range(ROUNDS):
            halves = np.linspace(low, high, NODES)
            halves = halves[halves > 0.0]
            fingers = np.maximum(self.least_finger(halves), least)
            total = np.where((fingers <= finger[1]) & self._holds_smallest(halves, fingers), halves + fingers, inf)
            at = int(total.argmin()) if len(total) else 0
            if len(total) == 0 or total[at] == inf:
                return best
            best = float(halves[at]), float(fingers[at])
            step = (high - low) / (NODES - 1)
            low, high = max(low, best[0] - step), min(high, best[0] + step)
        return best

    def straight_radii(self, half_palm: ArrayLike, finger: ArrayLike) -> Radii:
        """Radii (m) held by fingers kept straight."""
        h, crossing = self.half_thickness, self.crossing
        if self.friction_angle > 0.0:
            return frictional_radii(half_palm, finger, self.friction_angle, h, crossing=crossing)
        return structural_radii(half_palm, finger, h, crossing=crossing)

    def _holds_smallest(self, half_palm: Floats, finger: Floats) -> NDArray[np.bool_]:
        """Whether the smallest disk is held; fingers kept straight reach farthest along the palm."""
        usable = np.isfinite(finger) & (finger > self.half_thickness)
        radii = self.straight_radii(half_palm, np.where(usable, finger, 1.0))
        held = usable & (radii.min <= self.smallest * (1.0 + ROUNDING))
        if self.links == 1:
            held &= radii.max >= self.largest * (1.0 - ROUNDING)
        return held

    @property
    def _rho(self) -> float:
        return self.largest + self.half_thickness

    @property
    def _top(self) -> tuple[float, float]:
        """Where the joint line must come to (m)."""
        return self._rho * cos(self.friction_angle), self.largest - self._rho * sin(self.friction_angle)

    def _tangent_and_rest(self, d: Floats) -> tuple[Floats, Floats]:
        """Length (m) of the tangent from the base joint, and the angle (rad) left from where it touches to the top."""
        far = np.hypot(d, self.largest)
        tangent = np.sqrt(np.maximum(far**2 - self._rho**2, 0.0))
        touched = np.arccos(np.clip(self._rho / far, -1.0, 1.0)) - np.arctan2(self.largest, d)
        return tangent, -self.friction_angle - touched
