"""A preshaped hand that turns a disk from a known direction to its palm (section 5.3.2, figure 5.10), in closed form.

The hand stands still, base joints at psi, distal joints curled by delta. Disks of radius R fly in along the unit vector d,
one beside the other. One that meets a distal link's inner side, with the normal n towards the disk, goes on along
d' = d - (1 + e) (d.n) n, without friction. All of them had and have the same direction, so where one comes to the palm, and
how far its path passes from any joint or tip, are linear in the place X of its contact on the link: those that reach the
palm without touching anything else on their way are an interval of X, and of the distance between their paths. So are those
that reach the palm directly.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, inf, sin

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Interval = tuple[float, float]
NOTHING: Interval = (inf, -inf)


@dataclass(frozen=True)
class PreshapedHand:
    """Half palm D, links (proximal, distal), half thickness h, disk's radius R (m); base and distal angle (rad)."""

    half_palm: float
    links: tuple[float, float]
    half_thickness: float
    radius: float
    base: float
    bend: float

    @property
    def size(self) -> float:
        """R + h (m): how far the disk's centre is from a link it touches."""
        return self.radius + self.half_thickness

    @property
    def palm_end(self) -> float:
        """How far (m) to a side the centre of a disk on the palm may be without touching a proximal link."""
        return self.half_palm - (self.size - self.radius * cos(self.base)) / sin(self.base)

    def points(self, side: float) -> Floats:
        """Base joint, elbow and tip (3, 2) of the right finger (side 1) or the left one (-1)."""
        steps = [self.links[0] * _unit(self.base), self.links[1] * _unit(self.base + self.bend)]
        points = np.cumsum([[self.half_palm, 0.0], *steps], axis=0)
        return points * np.array([side, 1.0])


def _unit(angle: float) -> Floats:
    return np.array([cos(angle), sin(angle)])


def across(direction: Floats) -> Floats:
    """The unit vector to the left of a direction: paths along it are told apart by their distance along this."""
    return np.array([-direction[1], direction[0]])


def direct_window(hand: PreshapedHand, direction: Floats) -> Interval:
    """Paths that reach the palm directly: least and largest distance (m) to the left of that through the palm's middle."""
    left = across(direction)
    if direction[1] >= 0.0 or hand.palm_end < 0.0:
        return NOTHING
    low, high = sorted(_shifted(x, hand.radius, left) for x in (-hand.palm_end, hand.palm_end))
    for side in (1.0, -1.0):
        passed = hand.points(side)[1:] @ left
        # The right finger lies to the left of a path towards the palm, the left finger to the right of it.
        if side > 0.0:
            high = min(high, float(passed.min()) - hand.size)
        else:
            low = max(low, float(passed.max()) + hand.size)
    return (low, high) if low < high else NOTHING


def redirected_window(hand: PreshapedHand, direction: Floats, restitution: float, side: float = 1.0) -> Interval:
    """Paths that meet the distal link's inner side and then the palm, as ``direct_window`` counts them."""
    mirror = np.array([side, 1.0])
    way = direction * mirror
    _, elbow, tip = hand.points(1.0)
    link = (tip - elbow) / hand.links[1]
    normal = across(link)
    if way @ normal >= 0.0:
        return NOTHING
    after = way - (1.0 + restitution) * (way @ normal) * normal
    if after[1] >= 0.0 or hand.palm_end < 0.0:
        return NOTHING
    found = _clipped(hand, way, after, link, elbow + hand.size * normal)
    if found is NOTHING:
        return NOTHING
    ends = [float((elbow + hand.size * normal + along * link) @ across(way)) for along in found]
    # Mirrored paths are counted from the other side.
    low, high = sorted(side * each for each in ends)
    return low, high


def _clipped(hand: PreshapedHand, way: Floats, after: Floats, link: Floats, first: Floats) -> Interval:
    """Places X (m) on the link of which centre paths in and out are clear, and end on the palm."""
    low, high = 0.0, hand.links[1]
    out = after / np.hypot(*after)
    base, elbow, _ = hand.points(1.0)
    steps = after[0] / after[1]

    def at_palm(along: float) -> float:
        centre = first + along * link
        return float(centre[0] + steps * (hand.radius - centre[1]))

    def beside(point: Floats, unit: Floats) -> tuple[float, float]:
        """How far a point is to the left of the path with contact at X: its value at 0 and its slope."""
        return float((point - first) @ across(unit)), float(-link @ across(unit))

    inner = across(_unit(hand.base))
    start, end = at_palm(0.0), at_palm(1.0)
    limits = [(hand.palm_end - start, start - end), (hand.palm_end + start, end - start)]
    if hand.bend > 0.0:  # the disk may touch the proximal link first
        limits.append((float((first - base) @ inner) - hand.size, float(link @ inner)))
    else:  # the elbow may be in its way
        value, slope = beside(elbow, out)
        limits.append((value - hand.size, slope))
    other = hand.points(-1.0)
    for point, unit in [(each, way) for each in other[1:]] + [(each, out) for each in other[1:]]:
        value, slope = beside(point, unit)
        limits.append((-value - hand.size, -slope))
    for value, slope in limits:  # value + slope X >= 0
        if slope > 0.0:
            low = max(low, -value / slope)
        elif slope < 0.0:
            high = min(high, -value / slope)
        elif value < 0.0:
            return NOTHING
    return (low, high) if low < high else NOTHING


def width(interval: Interval) -> float:
    """Of a window (m); 0 of none."""
    return max(interval[1] - interval[0], 0.0)


def _shifted(x: float, y: float, left: Floats) -> float:
    return float(np.array([x, y]) @ left)
