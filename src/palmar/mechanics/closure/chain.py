"""The largest disk held by a symmetric hand with any number of links a finger, by a small exact optimisation.

Seen from the disk's centre (0, y) joint k lies at distance rho_k and polar angle phi_k; tau_k = sqrt(rho_k^2 - rho^2) is
its tangent to the circle that joint lines may not cut, rho = R + half thickness. A link of length l between two joints
stays clear of that circle if and only if tau_{k-1} + tau_k >= l, and turns phi by the angle opposite l in the triangle
of l and both distances. Link m touches with its inside if tau_{m-1} <= l_m, else with its tip.

A disk is held on the palm if some link can touch it at elevation e >= -alpha, alpha being the friction angle. Off the
palm, a link before m that touches at or below the equator may carry it instead, or with friction the contact itself,
|e| <= alpha. So the greatest elevation is sought over tau_1 ... tau_{m-1} (and y): the sum over the links is largest along
a best path through grids of tangent lengths, which are then narrowed around it. The largest R is the last zero of that
elevation. Links after m are out of the way. It agrees with the closed forms of one and two links.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, hypot, sin

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
FIRST_NODES = {0: 1, 1: 241, 2: 61}
MANY_NODES, NODES, NARROWING, LEVELS, COARSE_LEVELS = 31, 11, 0.5, 44, 6
PEAK_LEVELS, PEAK_STEPS = 16, 30
RADII, FEWER_RADII = 25, 9
"""Radii scanned for the last sign change, the fewer where a hold is known and only larger ones are sought."""
ROUNDING = 1e-15
GOLDEN = (5.0**0.5 - 1.0) / 2.0
NEARLY = 0.1
"""A scan that stays this far (rad) below the limit everywhere has not missed a narrow hold."""
OUT = -1e3
"""Elevation (rad) that stands for: cannot touch."""


@dataclass(frozen=True)
class Chain:
    """A hand with line or capsule links, in m and rad; joints turn freely inwards."""

    half_palm: float
    links: tuple[float, ...]
    friction_angle: float = 0.0
    half_thickness: float = 0.0


@dataclass(frozen=True)
class Hold:
    """A disk of ``radius`` with its centre at (0, ``height``) (m) and the right finger's ``joints`` (last, 2).

    Link ``last`` (from 1) has the highest contact, at ``elevation`` (rad); ``carrier`` is the link that carries the disk,
    0 for the palm, None for friction at the highest contact.
    """

    radius: float
    height: float
    joints: Floats
    last: int
    elevation: float
    carrier: int | None


def largest_hold(chain: Chain) -> Hold | None:
    """The largest disk the hand holds (limits count as held), None where it holds none."""
    best = _pinched(chain)
    for last in range(len(chain.links), 0, -1):
        for carrier in range(last):
            found = _largest(_Reach(chain, last, carrier), best.radius if best else 0.0)
            best = found or best
    return best


def _pinched(chain: Chain) -> Hold | None:
    """Held off the palm by friction alone: links along the palm line, the last one leaning out by the friction angle."""
    s, c = sin(chain.friction_angle), cos(chain.friction_angle)
    best: Hold | None = None
    for last, length in enumerate(chain.links, 1):
        base = chain.half_palm + sum(chain.links[: last - 1])
        rho = (base + length * s) / c
        radius, height = rho - chain.half_thickness, length * c + rho * s
        if s > 0.0 and height >= radius > (best.radius if best else 0.0):
            along = chain.half_palm + np.cumsum([0.0, *chain.links[: last - 1]])
            joints = np.stack([along, np.zeros_like(along)], axis=1)
            best = Hold(radius, height, joints, last, -chain.friction_angle, None)
    return best


def _largest(reach: _Reach, beyond: float) -> Hold | None:
    """The largest disk with a radius above ``beyond`` (m).

    A hand of half length l holds none above 2 l / pi without friction, and none above 2 l / (1 - sin alpha) with it.
    """
    chain = reach.chain
    scale, s = chain.half_palm + sum(chain.links), sin(chain.friction_angle)
    above = (2.0 / max(1.0 - s, 1e-9) if s > 0.0 else 0.64) * scale
    low = max(beyond * (1.0 + 1e-12), 1e-4 * scale)
    if low >= above:
        return None
    count = FEWER_RADII if beyond > 0.0 else RADII
    scanned = np.geomspace(above, low, count)
    values = np.array([reach.highest(float(radius), COARSE_LEVELS)[0] for radius in scanned])
    held = np.flatnonzero(values >= 0.0)
    if held.size:
        at = int(held[0])
        while at > 0 and reach.highest(float(scanned[at - 1]))[0] >= 0.0:  # a coarse search may miss a hold
            at -= 1
        inside, above = float(scanned[at]), float(scanned[max(at - 1, 0)])
    else:
        best = int(values.argmax())
        if values[best] < -NEARLY:
            return None
        ends = float(scanned[min(best + 1, count - 1)]), float(scanned[max(best - 1, 0)])
        inside, above = _peak(lambda r: reach.highest(r, PEAK_LEVELS)[0], *ends), ends[1]
    found, hold = reach.highest(inside)
    if found < 0.0:
        return None
    if reach.highest(above)[0] < 0.0:
        return reach.highest(_zero(lambda r: reach.highest(r)[0], inside, above, 1e-14 * scale))[1]
    return hold


def _zero(function: Callable[[float], float], low: float, high: float, within: float) -> float:
    """Where a function passes from >= 0 at low to below 0 at high: secants of the Illinois rule."""
    at_low, at_high = function(low), function(high)
    for step in range(80):
        if high - low <= within:
            break
        place = low + (high - low) * at_low / (at_low - at_high) if step % 4 < 3 else 0.5 * (low + high)
        place = min(max(place, low + 0.1 * within), high - 0.1 * within)
        value = function(place)
        if value >= 0.0:
            low, at_low, at_high = place, value, 0.5 * at_high
        else:
            high, at_high, at_low = place, value, 0.5 * at_low
    return low


def _peak(function: Callable[[float], float], low: float, high: float) -> float:
    """Where a function with one peak in [low, high] is largest: a golden section search, left once above 0."""
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = function(left), function(right)
    for _ in range(PEAK_STEPS):
        if max(at_left, at_right) >= 0.0:
            break
        if at_left > at_right:
            high, right, at_right = right, left, at_left
            left = high - GOLDEN * (high - low)
            at_left = function(left)
        else:
            low, left, at_left = left, right, at_right
            right = low + GOLDEN * (high - low)
            at_right = function(right)
    return left if at_left > at_right else right


@dataclass(frozen=True)
class _Reach:
    """How high link ``last`` can touch a disk carried by the palm (``carrier`` 0) or by a link before it."""

    chain: Chain
    last: int
    carrier: int

    def highest(self, radius: float, levels: int = LEVELS) -> tuple[float, Hold]:
        """Greatest elevation above -alpha (rad), and the posture that has it."""
        total = self.chain.half_palm + sum(self.chain.links)
        free = self.last - 1 - (self.carrier > 0)
        low, high = self._within_reach(radius, total)
        middles, halves, rise = 0.5 * (low + high), 0.5 * (high - low), 0.5 * total
        unknown, height, best, posture = free + (self.carrier > 0), radius + rise, OUT, None
        for level in range(levels if unknown else 1):
            steps = np.linspace(-1.0, 1.0, NODES if level else FIRST_NODES.get(unknown, MANY_NODES))
            grids = [np.maximum(middle + half * steps, 0.0) for middle, half in zip(middles, halves, strict=True)]
            heights = np.maximum(height + rise * steps, radius) if self.carrier else np.array([radius])
            value, at, taus, joints = self._best_path(radius, heights, grids)
            if value > best or posture is None:
                best, height, middles = value, at, taus
                posture = Hold(radius, at, joints, self.last, value, self.carrier)
            halves, rise = NARROWING * halves, NARROWING * rise
        assert posture is not None
        return best + self.chain.friction_angle, posture

    def _within_reach(self, radius: float, total: float) -> tuple[Floats, Floats]:
        """Smallest and largest tangent lengths of the joints that are free, from how far the links before them reach."""
        rho, w = radius + self.chain.half_thickness, self.chain.half_palm
        nearest, farthest = hypot(w, radius), hypot(w, radius + (total if self.carrier else 0.0))
        reach = np.cumsum(self.chain.links[: self.last - 1])
        reach = reach[np.arange(1, reach.size + 1) != self.carrier]
        low = np.maximum(nearest - reach, rho) ** 2 - rho**2
        return np.sqrt(np.maximum(low, 0.0)), np.sqrt(np.maximum((farthest + reach) ** 2 - rho**2, 0.0))

    def _best_path(self, radius: float, heights: Floats, grids: list[Floats]) -> tuple[float, float, Floats, Floats]:
        """Greatest elevation over the grids: angles add up link by link, and the best predecessor is kept.

        Rows are heights of the centre, columns tangent lengths of the joint before the next link. Returns the
        elevation, the height, the tangent lengths chosen, and the joints.
        """
        rho, w = radius + self.chain.half_thickness, self.chain.half_palm
        square = w**2 + heights**2 - rho**2
        tau = np.sqrt(np.maximum(square, 0.0))[:, None]
        phi = np.where(square >= 0.0, -np.arctan2(heights, w), OUT)[:, None]
        left = iter(grids)
        passed: list[tuple[Floats, Floats, Indices | None]] = [(tau, phi, None)]
        pick: Indices | None
        for k, length in enumerate(self.chain.links[: self.last - 1], 1):
            if k == self.carrier:
                tau, phi, pick = *_carried(tau, phi, length, rho), None
            else:
                tau, phi, pick = _stepped(tau, phi, length, next(left), rho)
            phi = np.where(heights[:, None] + np.hypot(tau, rho) * np.sin(phi) >= -ROUNDING, phi, OUT)
            passed.append((tau, phi, pick))
        ends = phi + _contact_angle(tau, rho, self.chain.links[self.last - 1])
        row, column = (int(each) for each in np.unravel_index(int(ends.argmax()), ends.shape))
        value = float(ends[row, column])
        taus: list[float] = []
        joints: list[tuple[float, float]] = []
        for tau, phi, pick in reversed(passed):
            far, angle = np.hypot(tau[row, column], rho), phi[row, column]
            joints.append((far * np.cos(angle), heights[row] + far * np.sin(angle)))
            if pick is not None:
                taus.append(tau[row, column])
                column = int(pick[row, column])
        return value, float(heights[row]), np.array(taus[::-1]), np.array(joints[::-1])


def _carried(tau: Floats, phi: Floats, length: float, rho: float) -> tuple[Floats, Floats]:
    """A link that touches with its inside, at or below the equator."""
    after = length - tau
    first, second = np.arctan2(tau, rho), np.arctan2(after, rho)
    reached = (phi > 0.5 * OUT) & (after >= 0.0)
    return np.maximum(after, 0.0), np.where(reached, np.minimum(phi, -first) + first + second, OUT)


def _stepped(tau: Floats, phi: Floats, length: float, grid: Floats, rho: float) -> tuple[Floats, Floats, Indices]:
    """A link that stays clear, from each tangent length to those of ``grid``; with the best predecessor of each."""
    near, far = np.hypot(tau, rho)[:, :, None], np.hypot(grid, rho)
    sides = (length - near + far) * (length + near - far), (near + far - length) * (near + far + length)
    turned = 2.0 * np.arctan2(np.sqrt(np.maximum(sides[0], 0.0)), np.sqrt(np.maximum(sides[1], 0.0)))
    possible = (sides[0] >= 0.0) & (sides[1] >= 0.0) & (tau[:, :, None] + grid >= length - ROUNDING)
    angles = np.where(possible, phi[:, :, None] + turned, OUT)
    pick = angles.argmax(axis=1)
    return np.broadcast_to(grid, pick.shape), np.maximum(angles.max(axis=1), OUT), pick


def _contact_angle(tau: Floats, rho: float, length: float) -> Floats:
    """Angle from the last joint to the contact: tangent, or from the sides of the triangle with the tip."""
    elbow = np.hypot(tau, rho)
    sides = (length + rho - elbow) * (length - rho + elbow), (rho + elbow - length) * (rho + elbow + length)
    tip = 2.0 * np.arctan2(np.sqrt(np.maximum(sides[0], 0.0)), np.sqrt(np.maximum(sides[1], 0.0)))
    return np.where(tau <= length, np.arctan2(tau, rho), np.where(sides[0] >= 0.0, tip, OUT))
