"""Brute-force decision whether a 2-jointed hand (one link a finger) can hold a disk.

No limit radius is known here. Both fingers turn to the same angle until they touch a disk whose centre lies
on the axis of symmetry at (0, y), y >= R; the touching angle is found by root search on the distance between
a point and a segment, and the forces of the touching bodies are asked to balance. All heights y at which the
fingers can touch the disk are scanned, and every local maximum of the margin is refined.

Force balance. Write e for the elevation of the contact seen from the disk's centre (positive above the
equator). By symmetry only the vertical forces of the two fingers and of the palm have to cancel; their
moments do so by themselves. A finger pushes along any line within the friction angle a of the contact normal,
and the palm pushes up. So there is a balance on the palm if e >= -a, and away from it if |e| <= a.

Only first contacts of a closing finger are looked at. A finger that has already passed the disk touches it
with its back, and closing moves it away.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

# Margins are angles in radians, or lengths over the finger length; above -TINY counts as held, so that a
# limit is held.
TINY = 1e-11
EPS = float(np.finfo(np.float64).eps)
GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
GOLDEN_STEPS = 50
ROOT_STEPS = 80
ITEMS_AT_ONCE = 2048
# Scanned heights with the contact on the link, and with the contact on the tip.
LINK_NODES, TIP_NODES = 56, 40


@dataclass(frozen=True)
class Grips:
    """Hands and disks to decide on: float arrays of one shape, in metres and radians."""

    radius: Floats
    half_palm: Floats
    length: Floats
    half_thickness: Floats
    friction_angle: Floats
    psi_limits: tuple[float, float]
    crossing: bool

    @property
    def touching(self) -> Floats:
        """Distance of the disk's centre from the joint line at contact, R + h."""
        return self.radius + self.half_thickness

    def at(self, index: Any) -> Grips:
        """The same hands and disks, indexed as arrays are."""
        return replace(
            self,
            radius=self.radius[index],
            half_palm=self.half_palm[index],
            length=self.length[index],
            half_thickness=self.half_thickness[index],
            friction_angle=self.friction_angle[index],
        )


def nearest_on_finger(grips: Grips, psi: Floats, height: Floats) -> tuple[Floats, Floats, Floats]:
    """Vector (x, y) from the disk's centre to the nearest point of the right joint line, and its length."""
    along_x, along_y = np.cos(psi), np.sin(psi)
    foot = np.clip(height * along_y - grips.half_palm * along_x, 0.0, grips.length)
    x = grips.half_palm + foot * along_x
    y = foot * along_y - height
    return x, y, np.hypot(x, y)


def contact_angle(grips: Grips, height: Floats) -> Floats:
    """Finger angle at which the closing right finger first touches the disk; the height must be reachable.

    The distance falls while the finger turns towards the ray from its base to the centre, so one root lies
    between the open finger and that ray. Newton steps on the distance, halving the bracket where a step
    leaves it.
    """
    low = np.zeros_like(height)
    high = np.pi - np.arctan2(height, grips.half_palm)
    psi = 0.5 * (low + high)
    noise = 4.0 * EPS * np.hypot(grips.half_palm, height)
    for _ in range(ROOT_STEPS):
        x, y, distance = nearest_on_finger(grips, psi, height)
        gap = distance - grips.touching
        low, high = np.where(gap >= 0.0, psi, low), np.where(gap >= 0.0, high, psi)
        # The nearest point turns about the base; its motion towards the centre shortens the distance.
        rate = (y * (x - grips.half_palm) - x * (y + height)) / np.maximum(distance, EPS)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = psi - gap / rate
        target = np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
        settled = (np.abs(gap) <= noise) | (np.abs(target - psi) <= 2.0 * EPS)
        if settled.all():
            break
        psi = np.where(settled, psi, target)
    return psi


def posture(grips: Grips, height: Floats) -> tuple[Floats, Floats]:
    """Elevation of the right contact, and by how much the finger keeps its limits (negative: breaks one)."""
    psi = contact_angle(grips, height)
    x, y, _ = nearest_on_finger(grips, psi, height)
    slack = np.minimum(psi - grips.psi_limits[0], grips.psi_limits[1] - psi)
    tip_above_palm = (grips.length * np.sin(psi) - grips.half_thickness) / grips.length
    slack = np.where(psi > 0.5 * np.pi, np.minimum(slack, tip_above_palm), slack)
    if not grips.crossing:
        tip_off_axis = (grips.half_palm + grips.length * np.cos(psi) - grips.half_thickness) / grips.length
        slack = np.minimum(slack, tip_off_axis)
    return np.arctan2(y, x), slack


def touchable_heights(grips: Grips) -> tuple[Floats, Floats, Floats]:
    """Heights of the centre: lowest, where the contact passes from link to tip, highest; NaN where none.

    The disk is not below the palm and does not overlap the finger's base; it is no farther from the base than
    the finger can reach.
    """
    base, touching = grips.half_palm, grips.touching

    def height_at(distance_from_base: Floats) -> Floats:
        square = (distance_from_base - base) * (distance_from_base + base)
        return np.sqrt(np.maximum(square, 0.0))

    low = np.maximum(grips.radius, height_at(touching))
    highest = height_at(grips.length + touching)
    reached = np.hypot(base, low) <= (grips.length + touching) * (1.0 + 4.0 * EPS)
    low = np.where(reached, low, np.nan)
    high = np.maximum(low, highest)
    return low, np.clip(height_at(np.hypot(grips.length, touching)), low, high), high


def palm_posture(grips: Grips) -> tuple[Floats, Floats]:
    """Elevation and slack (see `posture`) with the disk on the palm; -inf where the fingers cannot touch."""
    low, _, _ = touchable_heights(grips)
    possible = low <= grips.radius * (1.0 + 4.0 * EPS)
    elevation = np.full_like(low, -np.inf)
    slack = np.full_like(low, -np.inf)
    elevation[possible], slack[possible] = posture(grips.at(possible), grips.radius[possible])
    return elevation, slack


def pinch_margin(grips: Grips, height: Floats) -> Floats:
    """At least 0 where two opposed contacts alone hold the disk with its centre at this height."""
    elevation, slack = posture(grips, height)
    return np.minimum(grips.friction_angle - np.abs(elevation), slack)


def scanned_heights(grips: Grips) -> Floats:
    """Heights to look at, a row for each disk, crowded at the ends of the link and of the tip phase."""

    def crowded(first: Floats, last: Floats, count: int) -> Floats:
        share = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, count))
        return first[:, None] + (last - first)[:, None] * share

    low, on_link, high = touchable_heights(grips)
    return np.hstack([crowded(low, on_link, LINK_NODES)[:, :-1], crowded(on_link, high, TIP_NODES)])


def golden_maximum(function: Callable[[Floats], Floats], low: Floats, high: Floats) -> Floats:
    """Largest value met by a golden section search, for a function with one peak in [low, high]."""
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = function(left), function(right)
    best = np.maximum(at_left, at_right)
    for _ in range(GOLDEN_STEPS):
        falls = at_left > at_right
        low, high = np.where(falls, low, left), np.where(falls, right, high)
        fresh = np.where(falls, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        value = function(fresh)
        left, right = np.where(falls, fresh, right), np.where(falls, left, fresh)
        at_left, at_right = np.where(falls, value, at_right), np.where(falls, at_left, value)
        best = np.maximum(best, value)
        if (best >= 0.0).all():
            break
    return best


def pinches(grips: Grips) -> Bools:
    """Whether two opposed contacts hold the disk at some height; `grips` are flat."""
    heights = scanned_heights(grips)
    margin = np.full_like(heights, -np.inf)
    reached = ~np.isnan(heights[:, 0])
    margin[reached] = pinch_margin(grips.at(reached).at((slice(None), None)), heights[reached])
    best: Floats = margin.max(axis=1)
    walled = np.pad(margin, ((0, 0), (1, 1)), constant_values=-np.inf)
    peaks = (margin >= walled[:, :-2]) & (margin >= walled[:, 2:])
    item, node = np.nonzero(peaks & (reached & (best < 0.0))[:, None])
    some = grips.at(item)
    low = heights[item, np.maximum(node - 1, 0)]
    high = heights[item, np.minimum(node + 1, heights.shape[1] - 1)]
    np.maximum.at(best, item, golden_maximum(lambda height: pinch_margin(some, height), low, high))
    return best >= -TINY


def structural(grips: Grips) -> Bools:
    """Whether palm and two contacts at or above the equator hold the disk; `grips` are flat."""
    elevation, slack = palm_posture(grips)
    return np.minimum(elevation, slack) >= -TINY


def frictional(grips: Grips) -> Bools:
    """Whether the disk is held on the palm or by two opposed contacts; the latter only with friction."""
    elevation, slack = palm_posture(grips)
    held = np.minimum(elevation + grips.friction_angle, slack) >= -TINY
    rest = np.flatnonzero(~held & (grips.friction_angle > 0.0))
    held[rest] = pinches(grips.at(rest))
    return held


def _decide(decision: Callable[[Grips], Bools], values: tuple[ArrayLike, ...], **hand: Any) -> Bools:
    """Broadcast, decide piece by piece to save memory; `values` in the order of the fields of `Grips`."""
    columns = np.broadcast_arrays(*(np.asarray(value, dtype=np.float64) for value in values))
    radius, half_palm, length, half_thickness, friction_angle = (column.ravel() for column in columns)
    grips = Grips(radius, half_palm, length, half_thickness, friction_angle, **hand)
    pieces = (slice(start, start + ITEMS_AT_ONCE) for start in range(0, max(radius.size, 1), ITEMS_AT_ONCE))
    held = np.concatenate([decision(grips.at(piece)) for piece in pieces])
    return held.reshape(columns[0].shape)


def holds_structurally(
    radius: ArrayLike,
    half_palm: ArrayLike,
    finger_length: ArrayLike,
    half_thickness: ArrayLike = 0.0,
    *,
    crossing: bool = True,
    psi_limits: tuple[float, float] = (0.0, math.pi),
) -> Bools:
    """Whether the hand holds a disk against its palm without friction.

    All lengths in metres, broadcast against each other; the result has their common shape. `half_thickness`
    is the radius of the finger capsule about its joint line. With `crossing` false the right finger's tip
    stays at x >= half_thickness. `psi_limits` are the joint limits in radians, 0 = fully open.
    """
    values = (radius, half_palm, finger_length, half_thickness, 0.0)
    return _decide(structural, values, psi_limits=psi_limits, crossing=crossing)


def holds_with_friction(
    radius: ArrayLike,
    half_palm: ArrayLike,
    finger_length: ArrayLike,
    friction_angle: ArrayLike,
    half_thickness: ArrayLike = 0.0,
    *,
    crossing: bool = True,
    psi_limits: tuple[float, float] = (0.0, math.pi),
) -> Bools:
    """Whether the hand holds a disk, on its palm or between two fingers, with friction.

    The friction angle is in radians, arctan of Coulomb's coefficient; the rest as in `holds_structurally`,
    whose answer this is where the friction angle is 0.
    """
    values = (radius, half_palm, finger_length, half_thickness, friction_angle)
    return _decide(frictional, values, psi_limits=psi_limits, crossing=crossing)
