"""A traced outline moved inwards by a margin, with corners added to it where the inset is found to leave the set.

Between two corners that lie on the true outline a chord may cut off a corner of what is not in the set. So the curve half
a margin inside is asked about at places a margin apart: along every edge, and once at every corner. From a place that is
not in the set one goes inwards until one is, halves the way back to the true outline, and puts a corner there; the new
edges are looked at in the same way. What pokes in and shows at none of the places is less than a margin wide where it
crosses that curve; a corner with an opening of 90 degrees or more then reaches no deeper than another half of a margin,
so that the inset by a whole margin is clear of it.
"""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, log2

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Asked = Callable[[Floats, Floats, NDArray[np.int64]], Bools]
"""Which of the points (N,), (N,), m, are in the set; the numbers (N,) tell places of the outline apart."""
ROUNDS = 12
HALVINGS = 6


def bulged(ring: Floats, known: Bools, inside: Asked, margin: float) -> tuple[Floats, Bools]:
    """The ring, and ``known``, with a corner out from the middle of edges beyond which, by a margin, the set goes on."""
    span = np.roll(ring, -1, axis=0) - ring
    length = np.hypot(span[:, 0], span[:, 1])
    out = np.stack([span[:, 1], -span[:, 0]], axis=1) / np.where(length > 0.0, length, 1.0)[:, None]
    edges = np.flatnonzero(~known & (length > 2.0 * margin))
    base, out = ring[edges] + 0.5 * span[edges], out[edges]
    beyond = inside(base[:, 0] + margin * out[:, 0], base[:, 1] + margin * out[:, 1], edges)
    edges, base, out = edges[beyond], base[beyond], out[beyond]
    low, high = np.full(len(edges), margin), 0.5 * length[edges]
    for _ in range(HALVINGS if len(edges) else 0):
        middle = 0.5 * (low + high)
        at = base + middle[:, None] * out
        yes = inside(at[:, 0], at[:, 1], edges)
        low, high = np.where(yes, middle, low), np.where(yes, high, middle)
    ring, fresh = _with_corners(ring, edges.astype(np.float64) + 0.5, base + low[:, None] * out)
    wide = np.zeros(len(ring), bool)
    wide[~fresh] = known
    return ring, wide


def refined(ring: Floats, known: Bools, inside: Asked, margin: float, deepest: float) -> tuple[Floats, Floats]:
    """The ring (N, 2) with the corners it needs, the set on its left; places (M, 2) inside it that stayed out.

    ``known`` (N,): edges, from each corner to the next, that are none of the outline. ``deepest``: how far inwards
    (m) one goes at once.
    """
    edge_done, corner_done = known.copy(), known | np.roll(known, 1)
    count, most, stuck = 0, 0, [np.empty((0, 2))]
    left = np.empty((0, 2))
    for _ in range(ROUNDS):
        base, inwards, key = _places(ring, edge_done, corner_done, margin)
        most = most or len(base)
        if len(base) > most:
            break
        at = base + 0.5 * margin * inwards
        numbers = count + np.arange(len(at))
        count += len(at)
        out = ~inside(at[:, 0], at[:, 1], numbers)
        left = at[out]
        if not out.any():
            break
        found, met = _back_in(base[out], inwards[out], numbers[out], inside, margin, deepest)
        stuck.append(left[~met])
        left = left[met]
        ring, fresh = _with_corners(ring, key[out][met], found[met])
        edge_done, corner_done = ~(fresh | np.roll(fresh, -1)), ~fresh
    return ring, np.concatenate([*stuck, left])


def _places(ring: Floats, edge_done: Bools, corner_done: Bools, margin: float) -> tuple[Floats, Floats, Floats]:
    """Of what is not done: places (K, 2) on the outline, directions inwards, and keys: corner k is k, on its edge more."""
    span = np.roll(ring, -1, axis=0) - ring
    length = np.hypot(span[:, 0], span[:, 1])
    along = span / np.where(length > 0.0, length, 1.0)[:, None]
    normal = np.stack([-along[:, 1], along[:, 0]], axis=1)
    edges = np.flatnonzero(~edge_done & (length > 0.0))
    counts = np.ceil(length[edges] / margin).astype(np.int64)
    which = np.repeat(edges, counts)
    past = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    share = (past + 0.5) / np.repeat(counts, counts)
    middle = normal + np.roll(normal, 1, axis=0)
    size = np.hypot(middle[:, 0], middle[:, 1])
    corners = np.flatnonzero(~corner_done & (size > 1e-9))
    return (
        np.concatenate([ring[which] + share[:, None] * span[which], ring[corners]]),
        np.concatenate([normal[which], middle[corners] / size[corners, None]]),
        np.concatenate([which + share, corners.astype(float)]),
    )


def _back_in(
    base: Floats, inwards: Floats, numbers: NDArray[np.int64], inside: Asked, margin: float, deepest: float
) -> tuple[Floats, Bools]:
    """From each place inwards to the set, and back to its outline (K, 2); whether it is met no deeper than ``deepest``."""
    low, high = np.full(len(base), 0.5 * margin), np.full(len(base), deepest)
    met = np.zeros(len(base), bool)
    for k in range(ceil(log2(deepest / margin)) + 1):
        depth = np.where(met, high, min(margin * 2.0**k, deepest))
        some = np.flatnonzero(~met)
        at = base[some] + depth[some, None] * inwards[some]
        yes = inside(at[:, 0], at[:, 1], numbers[some])
        high[some[yes]], low[some[~yes]] = depth[some[yes]], depth[some[~yes]]
        met[some[yes]] = True
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        at = base + middle[:, None] * inwards
        yes = inside(at[:, 0], at[:, 1], numbers)
        high, low = np.where(yes, middle, high), np.where(yes, low, middle)
    return base + high[:, None] * inwards, met


def _with_corners(ring: Floats, key: Floats, found: Floats) -> tuple[Floats, Bools]:
    """The ring with corners put at the places found, or moved there for keys of corners; which corners these are."""
    moved = key == np.floor(key)
    ring, fresh = ring.copy(), np.zeros(len(ring), bool)
    own = key[moved].astype(np.int64)
    ring[own], fresh[own] = found[moved], True
    order = np.argsort(np.concatenate([np.arange(len(ring), dtype=float), key[~moved]]), kind="stable")
    points = np.concatenate([ring, found[~moved]])[order]
    return points, np.concatenate([fresh, np.ones((~moved).sum(), bool)])[order]
