"""Brute-force decision whether a symmetric 4-jointed hand holds a disk without friction.

No limit radius and no formula for one is known here. The disk's centre lies on the axis at (0, y), y >= R. Links turn
about their joints; where one touches the disk is found by bisection on the distance between a point and a segment.
What is left free after the contacts of a case (the base joint's angle, or the height y) is scanned, and every peak
of the margin is refined.

A contact at elevation e (positive above the disk's equator) pushes the disk down if e > 0. With its mirror image it
leaves a vertical force only, so a set of contacts spans the plane positively if one pushes up and another one down; the
palm pushes up. The margin is the smaller of both shares, and of the distances by which the posture keeps its limits:
links neither overlap the disk nor go below the palm line, joint angles lie in [0, pi]. Links touch with their inner
side, the side to which they close. Where the elbow touches, both links do.

A disk counts as held if its margin exceeds a rounding error: limits themselves are left to closed forms.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

TINY = 1e-10
MAXIMUM_HALVINGS, HALVINGS, NODES = 42, 50, 160
AT_ONCE = 400
EVENLY = np.linspace(0.0, 1.0, NODES + 1)
FAR = -10.0


class Touching(Enum):
    """The links that carry the disk."""

    PROXIMAL_PALM = "proximal_palm"
    DISTAL_PALM = "distal_palm"
    DISTAL_PROXIMAL = "distal_proximal"
    DISTAL_PROXIMAL_PALM = "distal_proximal_palm"


@dataclass(frozen=True)
class Hands:
    """Hands and disks: arrays of one shape."""

    radius: Floats
    palm: Floats
    proximal: Floats
    distal: Floats

    def at(self, index: object) -> Hands:
        """The same, indexed as arrays are."""
        return Hands(*(each[index] for each in (self.radius, self.palm, self.proximal, self.distal)))  # type: ignore[index]


@dataclass(frozen=True)
class Link:
    """A link from (x, y) at ``angle``; ``side`` and ``depth`` of its point nearest to the disk's centre."""

    x: Floats
    y: Floats
    angle: Floats
    length: Floats

    @property
    def end(self) -> tuple[Floats, Floats]:
        return self.x + self.length * np.cos(self.angle), self.y + self.length * np.sin(self.angle)

    def nearest(self, height: Floats) -> tuple[Floats, Floats]:
        """Distance of the nearest point from the centre (0, height), and the sine of its elevation."""
        along_x, along_y = np.cos(self.angle), np.sin(self.angle)
        foot = np.clip(-self.x * along_x + (height - self.y) * along_y, 0.0, self.length)
        x, y = self.x + foot * along_x, self.y + foot * along_y - height
        distance = np.hypot(x, y)
        return distance, y / np.maximum(distance, 1e-300)


def touching(x: Floats, y: Floats, length: Floats, height: Floats, radius: Floats) -> Link:
    """The link that closes from a joint at (x, y) until it touches the disk; angle NaN where it cannot."""
    towards = np.arctan2(height - y, -x)
    apart = np.hypot(x, height - y)
    reaches = (apart - length <= radius) & (apart >= radius * (1.0 - 1e-13))
    low, high = np.zeros_like(apart), np.full_like(apart, np.pi)
    for _ in range(HALVINGS):
        turn = 0.5 * (low + high)
        foot = np.clip(apart * np.cos(turn), 0.0, length)
        overlaps = np.hypot(foot - apart * np.cos(turn), apart * np.sin(turn)) < radius
        low, high = np.where(overlaps, turn, low), np.where(overlaps, high, turn)
    return Link(x, y, np.where(reaches, towards - high, np.nan), length)


def bend(link: Link, base: Link) -> Floats:
    """Angle of the joint between two links, in (-pi, pi]."""
    return -np.remainder(base.angle - link.angle + np.pi, 2.0 * np.pi) + np.pi


def limits(base: Link, link: Link) -> Floats:
    """By how much both joint angles and the tip keep their limits."""
    turn = bend(link, base)
    return np.minimum.reduce([turn + TINY, np.pi - turn, base.angle + TINY, np.pi - base.angle, link.end[1] + TINY])


def proximal_palm(hands: Hands) -> Bools:
    """The distal link is out of the way: straight on, or bent outwards where the elbow touches."""
    r, zero = hands.radius, np.zeros_like(hands.radius)
    base = touching(hands.palm, zero, hands.proximal, r, r)
    distance, sine = base.nearest(r)
    free = np.zeros(r.shape, dtype=bool)
    for turn in (0.0, -0.5 * np.pi, -0.9 * np.pi):
        link = Link(*base.end, base.angle + turn, hands.distal)
        free |= (link.nearest(r)[0] >= r * (1.0 - 1e-9)) & (link.end[1] >= 0.0)
    return (sine > TINY) & free & (distance >= r * (1.0 - 1e-9))


def distal_proximal_palm(hands: Hands) -> Bools:
    r, zero = hands.radius, np.zeros_like(hands.radius)
    base = touching(hands.palm, zero, hands.proximal, r, r)
    sine = base.nearest(r)[1]
    elbow = np.hypot(base.end[0], base.end[1] - r)
    link = touching(*base.end, hands.distal, r, r)
    margin = np.minimum(np.maximum(sine, link.nearest(r)[1]), limits(base, link))
    at_elbow = (elbow <= r * (1.0 + 1e-9)) & (sine > TINY)
    return (np.nan_to_num(margin, nan=FAR) > TINY) | at_elbow


def distal_palm_margin(hands: Hands, share: Floats) -> Floats:
    """Margin with the base joint at ``share`` of half a turn."""
    r, zero = hands.radius, np.zeros_like(hands.radius * share)
    base = Link(hands.palm + zero, zero, np.pi * share, hands.proximal)
    clear = base.nearest(r)[0] / r - 1.0
    link = touching(*base.end, hands.distal, r, r)
    margin = np.minimum.reduce([link.nearest(r)[1], clear + TINY, limits(base, link)])
    return np.where(np.isnan(margin), FAR - np.hypot(base.end[0], base.end[1] - r), margin)


def distal_proximal_margin(hands: Hands, share: Floats) -> Floats:
    """Margin with the centre at ``share`` of the heights within reach."""
    r = hands.radius
    height = r + share * (hands.proximal + hands.distal + hands.palm)
    zero = np.zeros_like(height)
    base = touching(hands.palm + zero, zero, hands.proximal + zero, height, r + zero)
    low = base.nearest(height)[1]
    link = touching(*base.end, hands.distal + zero, height, r + zero)
    high = link.nearest(height)[1]
    spanning = np.maximum(np.minimum(-low, high), np.minimum(low, -high))
    margin = np.minimum(spanning, limits(base, link))
    at_elbow = np.hypot(base.end[0], base.end[1] - height) <= r * (1.0 + 1e-9)
    return np.where(np.isnan(margin) | at_elbow, FAR, margin)


def scanned(margin: Callable[[Hands, Floats], Floats], hands: Hands, shares: Floats) -> Bools:
    """Whether the margin exceeds a rounding error somewhere between the first and last of each row of ``shares``."""
    values = margin(hands.at((slice(None), None)), shares)
    best: Floats = values.max(axis=1)
    walled = np.pad(values, ((0, 0), (1, 1)), constant_values=-np.inf)
    peaks = (values >= walled[:, :-2]) & (values >= walled[:, 2:]) & (best <= TINY)[:, None]
    item, node = np.nonzero(peaks & (values != FAR))
    some = hands.at(item)
    low, high = shares[item, np.maximum(node - 1, 0)], shares[item, np.minimum(node + 1, shares.shape[1] - 1)]
    np.maximum.at(best, item, halved_maximum(lambda share: margin(some, share), low, high))
    return best > TINY


def distal_palm(hands: Hands) -> Bools:
    """Base angles are crowded where the proximal link comes to touch the disk, or points at its centre."""
    r, zero = hands.radius, np.zeros_like(hands.radius)
    touched = touching(hands.palm, zero, hands.proximal, r, r).angle
    place = np.where(np.isnan(touched), np.arctan2(r, -hands.palm), touched) / np.pi
    apart = 0.5 ** np.arange(1.0, 24.0)
    rows = [
        np.broadcast_to(EVENLY, (r.size, NODES + 1)),
        place[:, None],
        *(place[:, None] + s * apart for s in (-1, 1)),
    ]
    return scanned(distal_palm_margin, hands, np.sort(np.clip(np.hstack(rows), 0.0, 1.0), axis=1))


def distal_proximal(hands: Hands) -> Bools:
    return scanned(distal_proximal_margin, hands, np.broadcast_to(EVENLY, (hands.radius.size, NODES + 1)))


def halved_maximum(function: Callable[[Floats], Floats], low: Floats, high: Floats) -> Floats:
    """Largest value met by interval halving: of three places a quarter apart the best becomes the next middle."""
    middle, width = 0.5 * (low + high), 0.25 * (high - low)
    at_middle = function(middle)
    best = at_middle
    for _ in range(MAXIMUM_HALVINGS):
        places = np.stack([middle, middle - width, middle + width])
        values = np.stack([at_middle, function(places[1]), function(places[2])])
        choice = values.argmax(axis=0)[None]
        middle, at_middle = (np.take_along_axis(each, choice, 0)[0] for each in (places, values))
        best, width = np.maximum(best, at_middle), 0.5 * width
    return best


def holds(case: Touching, radius: ArrayLike, palm: ArrayLike, proximal: ArrayLike, distal: ArrayLike) -> Bools:
    """Whether the links of ``case`` hold the disk; half palm and links broadcast against the radii."""
    columns = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (radius, palm, proximal, distal)))
    flat = Hands(*(each.ravel() for each in columns))
    decide = {
        Touching.PROXIMAL_PALM: proximal_palm,
        Touching.DISTAL_PROXIMAL_PALM: distal_proximal_palm,
        Touching.DISTAL_PALM: distal_palm,
        Touching.DISTAL_PROXIMAL: distal_proximal,
    }[case]
    pieces = [slice(at, at + AT_ONCE) for at in range(0, max(flat.radius.size, 1), AT_ONCE)]
    return np.concatenate([decide(flat.at(piece)) for piece in pieces]).reshape(columns[0].shape)
