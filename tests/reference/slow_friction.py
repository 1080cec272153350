"""Brute-force decision whether a 4-jointed hand holds a disk with friction; see `slow_closure` for the search.

Contacts may lean by the friction angle a, so one at elevation e can push up if e <= a and down if e >= -a. The height of
the centre and the base joint's angle are searched on a grid that narrows around its best place, from the best places
of the coarsest grid.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .slow_closure import FAR, TINY, Floats, Hands, Link, limits, touching

Bools = NDArray[np.bool_]
COARSE, FINE, ZOOMS, STARTS = 81, 7, 45, 6


def margin(hands: Hands, alpha: Floats, height: Floats, angle: Floats) -> Floats:
    """By how much the distal link, closing from this posture of the proximal one, holds the disk; > 0 is held."""
    zero = np.zeros_like(height)
    base = Link(hands.palm + zero, zero, angle, hands.proximal)
    clear = base.nearest(height)[0] / hands.radius - 1.0
    link = touching(*base.end, hands.distal, height, hands.radius + zero)
    e = np.arcsin(np.clip(link.nearest(height)[1], -1.0, 1.0))
    found = np.minimum.reduce([e + alpha, np.where(height > hands.radius, alpha - e, 1.0), clear, limits(base, link)])
    return np.where(np.isnan(found), FAR - np.hypot(base.end[0], base.end[1] - height), found)


def proximal_alone(hands: Hands, alpha: Floats) -> Bools:
    """Whether the proximal links hold it alone, or with the palm, at one of many heights."""
    shares = np.concatenate([[0.0], np.geomspace(1e-7, 1.0, 2000)])
    height = hands.radius + shares[:, None] * (hands.proximal + hands.palm + hands.radius)
    base = touching(hands.palm + 0.0 * height, 0.0 * height, hands.proximal, height, hands.radius + 0.0 * height)
    e = np.arcsin(np.clip(base.nearest(height)[1], -1.0, 1.0))
    held = (e > TINY - alpha) & ((shares == 0.0)[:, None] | (e < alpha - TINY))
    return np.asarray(np.any(held & ~np.isnan(base.angle), axis=0))


def holds_with_friction(
    radius: ArrayLike,
    palm: ArrayLike,
    proximal: ArrayLike,
    distal: ArrayLike,
    friction_angle: ArrayLike,
    nodes: int = COARSE,
) -> Bools:
    """Whether palm and links, or links alone, hold the disk with a friction angle (rad) above 0; flat arrays.

    ``nodes`` a side of the coarsest grid.
    """
    columns = (
        np.atleast_1d(np.asarray(each, dtype=float)) for each in (radius, palm, proximal, distal, friction_angle)
    )
    r, w, p, q, alpha = np.broadcast_arrays(*columns)
    held = proximal_alone(Hands(r, w, p, q), alpha)
    for i in np.flatnonzero(~held):
        hand = Hands(*(each[i : i + 1, None, None] for each in (r, w, p, q)))
        held[i] = _searched(hand, alpha[i : i + 1, None, None], nodes)
    return held


def _searched(hand: Hands, alpha: Floats, nodes: int) -> bool:
    top = float((hand.proximal + hand.distal + hand.radius).item())
    lowest = float(hand.radius.item())
    for on_palm in (True, False):
        heights = np.array([0.0]) if on_palm else np.linspace(0.0, 1.0, nodes) ** 2 + 1e-12
        y, psi = np.meshgrid(heights, np.linspace(0.0, 1.0, nodes), indexing="ij")
        values = margin(hand, alpha, lowest + top * y[None], np.pi * psi[None])[0]
        for at in np.argsort(values, axis=None)[::-1][: STARTS * nodes // COARSE]:
            start = float(y.flat[at]), float(psi.flat[at]), 3.0 / nodes
            if _narrowed(hand, alpha, (lowest, top), start, on_palm):
                return True
    return False


def _narrowed(
    hand: Hands, alpha: Floats, span: tuple[float, float], start: tuple[float, float, float], on_palm: bool
) -> bool:
    (lowest, top), (y, psi, half) = span, start
    steps = np.linspace(-1.0, 1.0, FINE)
    for _ in range(ZOOMS):
        heights = np.array([0.0]) if on_palm else np.maximum(y + half * steps, 1e-12)
        grid = np.meshgrid(heights, np.clip(psi + half * steps, 0.0, 1.0), indexing="ij")
        values = margin(hand, alpha, lowest + top * grid[0][None], np.pi * grid[1][None])[0]
        at = int(values.argmax())
        if values.flat[at] > TINY:
            return True
        y, psi, half = float(grid[0].flat[at]), float(grid[1].flat[at]), 0.7 * half
    return False
