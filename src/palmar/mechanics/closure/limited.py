"""Disks held by a symmetric hand whose joints have limits, for fingers of up to three links: a search over stances.

Link after link closes from its lowest angle until it meets its limit, the palm line or the disk (rho = R + half thickness
from the centre); how far, as a share of that, is free. The link that is to touch goes on to the disk. A stance holds if a
contact can push the disk down (elevation e >= -alpha) and the palm, or a contact at e <= alpha, can push it up: the
palm, a link below the highest contact, or with friction the contact itself. Its ``margin`` is the least of these
angles, of what is left to every limit, and of the reach that is left, so a disk is held if the greatest margin over the
free shares, and over the height off the palm, is not negative. That margin is continuous; it is sought on grids that are
narrowed around the best, for all radii at once, and the radii are where it changes sign.

Fingers pass the disk on the outside: the folded hold of small disks (docs/derivations/four_jointed.md) is not looked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from itertools import product
from math import pi, sin

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.closure.closing_links import ClosingLinks, LimitedHand
from palmar.mechanics.closure.stance import Stance

Floats = NDArray[np.float64]
MOST_LINKS = 3
SMALLEST = 1e-3
"""Least radius looked at, as a share of half the hand: one held there stands for all smaller ones."""
RADII, CLOSER_RADII, FINER_RADII, ROUNDS = 97, 9, 33, 3
FIRST_NODES, NODES = (1, 101, 31, 11), (1, 9, 5, 5)
"""Nodes along each unknown of a grid, for 0 to 3 unknowns."""
COARSE_LEVELS, LEVELS = (1, 8, 12, 14), (1, 30, 140, 80)
NARROWING = (0.0, 0.55, 0.88, 0.8)
"""Slow where a ridge of the margin may lie askew in the grid."""
STRIDES = np.array([-2.0, -0.5, 0.5, 1.0, 2.0, 4.0, 8.0])
"""Steps ahead along the last moves, in their length, tried beside the grid."""
HELD, LIMIT = 1e-7, -1e-6
"""Margins (rad, or share of the hand) from which a disk counts as held, and down to which the stance at a limit is shown.

A margin below the root of the rounding error is no hold: without friction, tips that meet at the equator have none.
"""
NEARLY = 0.2
"""A peak of the margin down to minus this is looked at more closely."""
PROMINENT = 5e-3
"""By how much a peak rises above the lower of its neighbours at least; less may be the coarse search."""


@dataclass(frozen=True)
class LimitedRadii:
    """Intervals of radii (m) that are held, in ascending order, and the stance with the largest disk."""

    intervals: tuple[tuple[float, float], ...]
    largest: Stance | None


def limited_radii(hand: LimitedHand) -> LimitedRadii:
    """The radii held within the joint limits; intervals narrower than about a tenth of a radius may be missed.

    A disk held at a thousandth of half the hand counts as held down to 0.
    """
    s = sin(hand.friction_angle)
    most = (2.0 / max(1.0 - s, 1e-9) if s > 0.0 else 0.64) * hand.size
    radii = np.geomspace(SMALLEST * hand.size, most, RADII)
    margins = _greatest(_ways(hand), radii, COARSE_LEVELS)
    radii, margins = _closer(hand, radii, margins)
    held = margins >= HELD
    changes = np.flatnonzero(held[1:] != held[:-1])
    ends = [_end(hand, (float(radii[at]), float(radii[at + 1])), bool(held[at])) for at in changes]
    if held[0]:
        ends = [0.0, *ends]
    if not ends:
        return LimitedRadii((), None)
    return LimitedRadii(tuple(zip(ends[::2], ends[1::2], strict=True)), stance_at(hand, ends[-1]))


def stance_at(hand: LimitedHand, radius: float) -> Stance | None:
    """The stance with the greatest margin for a disk of ``radius`` (m), None where it is not held."""
    found = [_searched(each, np.array([radius]), LEVELS) for each in _ways(hand)]
    best = max(found, key=lambda each: float(each.margin[0]))
    if best.margin[0] < LIMIT:
        return None
    way = best.way
    return Stance(
        radius,
        float(best.height[0]),
        tuple(best.angles[:, 0].tolist()),
        way.last,
        float(best.elevation[0]),
        way.carrier,
    )


def _greatest(ways: Iterable[_Way], radii: Floats, levels: tuple[int, ...]) -> Floats:
    return np.asarray(np.maximum.reduce([_searched(way, radii, levels).margin for way in ways]))


def _closer(hand: LimitedHand, radii: Floats, margins: Floats) -> tuple[Floats, Floats]:
    """The scan with more radii around its peaks that only just fail, and about every end of an interval."""
    walled = np.pad(margins, 1, constant_values=-np.inf)
    peak = (
        (margins >= walled[:-2]) & (margins >= walled[2:]) & (margins > np.minimum(walled[:-2], walled[2:]) + PROMINENT)
    )
    held = margins >= HELD
    near = peak & ~held & (margins > -NEARLY)
    edge = np.zeros_like(near)
    edge[:-1] |= held[1:] != held[:-1]
    edge[1:] |= held[1:] != held[:-1]
    more = [
        np.geomspace(radii[max(at - 1, 0)], radii[min(at + 1, radii.size - 1)], CLOSER_RADII)
        for at in map(int, np.flatnonzero(near | edge))
    ]
    if not more:
        return radii, margins
    finer = np.setdiff1d(np.concatenate(more), radii)
    values = _greatest(_ways(hand), finer, LEVELS)
    order = np.argsort(np.concatenate([radii, finer]))
    return np.concatenate([radii, finer])[order], np.concatenate([margins, values])[order]


def _end(hand: LimitedHand, between: tuple[float, float], held_below: bool) -> float:
    """Where holding ends or begins between two radii: the side that is held.

    The last held radius counts, whatever the search missed before it: a stance that was found is there.
    """
    low, high = between
    ways = [way for way in _ways(hand) if _searched(way, np.array(between), LEVELS).margin.max() > -NEARLY]
    for _ in range(ROUNDS):
        radii = np.linspace(low, high, FINER_RADII)
        held = _greatest(ways, radii, LEVELS) >= HELD
        held[0], held[-1] = held_below, not held_below
        at = int(np.flatnonzero(held)[-1]) + 1 if held_below else int(np.flatnonzero(held)[0])
        low, high = float(radii[at - 1]), float(radii[at])
    return low if held_below else high


def _ways(hand: LimitedHand) -> Iterator[_Way]:
    """Link ``last`` pushes the disk down; what pushes it up."""
    for last in range(1, len(hand.links) + 1):
        yield from (_Way(hand, last, carrier) for carrier in range(last))
        if hand.friction_angle > 0.0:
            yield _Way(hand, last, None)


@dataclass(frozen=True)
class _Found:
    """For every radius the greatest margin, and what it was found at: arrays (radii), angles (links, radii)."""

    way: _Way
    margin: Floats
    height: Floats
    angles: Floats
    elevation: Floats


def _searched(way: _Way, radii: Floats, levels: tuple[int, ...]) -> _Found:
    """The greatest margin over the unknowns, each in [0, 1], by grids narrowed around the best of every radius."""
    count, rows = way.unknowns, np.arange(radii.size)
    middle, moved, half = np.full((radii.size, count), 0.5), np.zeros((radii.size, count)), 0.5
    best: _Found | None = None
    for level in range(levels[count]):
        offsets = np.broadcast_to(half * _grid(count, level), (radii.size, *_grid(count, level).shape))
        if level and count > 1:
            offsets = np.concatenate([offsets, moved[:, None, :] * STRIDES[:, None]], axis=1)
        places = np.clip(middle[:, None, :] + offsets, 0.0, 1.0)
        tried = way.stances(radii[:, None], places)
        pick = tried.margin.argmax(axis=1)
        margin, height, elevation = (each[rows, pick] for each in (tried.margin, tried.height, tried.elevation))
        chosen = _Found(way, margin, height, tried.angles[:, rows, pick], elevation)
        better = np.ones(radii.size, bool) if best is None else chosen.margin > best.margin
        step = np.where(better[:, None], places[rows, pick] - middle, 0.0)
        moved = np.where(better[:, None], 0.5 * moved * (level > 1) + step * (level > 0), moved)
        middle = middle + step
        best = chosen if best is None else _taken(better, chosen, best)
        half *= NARROWING[count] if level else 4.0 / FIRST_NODES[count]
    assert best is not None
    return best


@cache
def _grid(count: int, level: int) -> Floats:
    """Places (N, ``count``) about 0: at first an even grid, then one turned and stretched in another way each time."""
    steps = np.linspace(-1.0, 1.0, NODES[count] if level else FIRST_NODES[count])
    grid = np.array(list(product(steps, repeat=count))).reshape(steps.size**count, count)
    if level == 0 or count < 2:
        return grid
    chance = np.random.default_rng(level)
    turned = np.linalg.qr(chance.normal(size=(count, count)))[0]
    return np.asarray(grid * 10.0 ** -chance.uniform(0.0, 1.5, count) @ turned)


def _taken(better: NDArray[np.bool_], new: _Found, old: _Found) -> _Found:
    return replace(
        old,
        margin=np.where(better, new.margin, old.margin),
        height=np.where(better, new.height, old.height),
        angles=np.where(better, new.angles, old.angles),
        elevation=np.where(better, new.elevation, old.elevation),
    )


@dataclass(frozen=True)
class _Way:
    """Link ``last`` (from 1) touches highest; the palm (``carrier`` 0), a link before it, or friction (None) carries."""

    hand: LimitedHand
    last: int
    carrier: int | None

    @property
    def unknowns(self) -> int:
        """Links that stop somewhere before the disk, and the height of a disk off the palm."""
        return self.last - 1 - bool(self.carrier) + (self.carrier != 0)

    def stances(self, radius: Floats, shares: Floats) -> _Found:
        """Stances for radii (K, 1) and shares (K, N, unknowns)."""
        hand, alpha = self.hand, self.hand.friction_angle
        free = iter(np.moveaxis(shares, -1, 0))
        radius = np.broadcast_to(radius, shares.shape[:2])
        height = radius + (next(free) * hand.size if self.carrier != 0 else 0.0)
        finger = ClosingLinks(hand, radius + hand.half_thickness, height)
        margin = np.full(radius.shape, np.inf)
        elevation = margin
        for k in range(1, len(hand.links) + 1):
            if k == self.last:
                elevation = finger.touch()
                margin = np.minimum(margin, np.minimum(elevation, pi - elevation) + alpha)
                margin = np.minimum(margin, alpha - elevation) if self.carrier is None else margin
            elif k == self.carrier:
                margin = np.minimum(margin, alpha - finger.touch())
            else:
                finger.stay_clear(next(free) if k < self.last else None)
            margin = np.minimum(margin, finger.margin)
        return _Found(self, margin, height, np.array(finger.angles), elevation)
