"""The motion of an object pushed at its contacts, on any limit surface.

The exact solution for an ellipsoid is iterated: each pass solves the contact problem with the tangent metric at the
last motion, which is Newton's method for the complementarity problem (quadratic; two to six passes). Where it has not
settled after ``NEWTON_PASSES`` the secant metric takes over: without friction, and for one contact in a fixed mode,
every such pass lowers the power lost, so it converges. Derived and measured in docs/derivations/limit_surface.md.

Coulomb's law can admit several motions, or none (the object is wedged and the hand stalls). Of several, the one
nearest to the guess comes first. Others are sought among those of the last ellipsoid, each followed to its own end;
every one returned is verified, and tests compare the search with an exhaustive one.
"""

from __future__ import annotations

from math import inf, sqrt

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.contact_solve import MOTION_WIDTH, SAME, Workspace, copy_motion, solve_contacts
from palmar.mechanics.pushing.limit_surface import ELLIPSOID, LimitSurface, secant_metric, tangent_metric
from palmar.mechanics.pushing.metric import Metric, Triple, squared

Floats = NDArray[np.float64]
JAMMED, NOT_CONVERGED = 0, -1
NEWTON_PASSES, SECANT_PASSES = 20, 400
NEWTON_CHANGE, SECANT_CHANGE = 1e-8, 1e-11
"""Relative change of the motion at which a pass is the last."""
STARTS = 5


@compiled
def solve_motion(surface: LimitSurface, contacts: Floats, count: int, guess: Triple, space: Workspace) -> int:
    """Admissible motions, written into ``space.motions`` (see contact_solve); returns how many there are.

    1: the motion is unique as far as the search goes. More: Coulomb's law does not decide; the first continues
    ``guess`` (a twist; (0, 0, 0) if none is known). JAMMED = 0: no motion is admissible. NOT_CONVERGED = -1.
    Loads are in units of the total friction with the table.
    """
    if surface.kind == ELLIPSOID:
        return _on_ellipsoid(surface, contacts, count, guess, space)
    first, candidates = JAMMED, 0
    for start in range(STARTS):
        x, y, w = guess if start == 0 else _other_start(surface, contacts, start)
        first, candidates = _follow(surface, contacts, count, x, y, w, space)
        if first >= 0:
            break
    if first < 0:
        return JAMMED if candidates == 0 else NOT_CONVERGED
    copy_motion(space.trial, first, space.motions, 0)
    if candidates == 1:
        return 1
    for k in range(candidates):
        copy_motion(space.trial, k, space.candidates, k)
    return _others(surface, contacts, count, first, candidates, space)


@compiled
def start_metric(surface: LimitSurface) -> Metric:
    """The ellipsoid that stands in for the surface while no motion is known."""
    return 1.0, 0.0, 1.0, 0.0, 0.0, surface.length**2


@compiled
def _on_ellipsoid(surface: LimitSurface, contacts: Floats, count: int, guess: Triple, space: Workspace) -> int:
    metric = start_metric(surface)
    found = solve_contacts(metric, contacts, count, space.trial, space.rows)
    if found == 0:
        return JAMMED
    first = _nearest(metric, space.trial, found, guess[0], guess[1], guess[2])
    for k in range(found):
        row = 0 if k == first else (k + 1 if k < first else k)
        copy_motion(space.trial, k, space.motions, row)
        power = squared(metric, space.trial[k, 0], space.trial[k, 1], space.trial[k, 2])
        for column in range(3, MOTION_WIDTH):
            space.motions[row, column] /= sqrt(power) if power > 0.0 else 1.0
    return found


@compiled
def _others(surface: LimitSurface, contacts: Floats, count: int, first: int, candidates: int, space: Workspace) -> int:
    """Follow the other motions of the last ellipsoid and append those that lead somewhere new."""
    metric, found = start_metric(surface), 1
    speed2 = 0.0
    for i in range(count):
        speed2 = max(speed2, contacts[i, 4] ** 2 + contacts[i, 5] ** 2)
    for k in range(candidates):
        if k == first:
            continue
        row = space.candidates[k]
        index, _ = _follow(surface, contacts, count, row[0], row[1], row[2], space)
        if index < 0:
            continue
        known = False
        new = space.trial[index]
        for j in range(found):
            old = space.motions[j]
            apart = squared(metric, new[0] - old[0], new[1] - old[1], new[2] - old[2])
            known = known or apart <= 100.0 * SAME * SAME * speed2
        if not known:
            copy_motion(space.trial, index, space.motions, found)
            found += 1
    return found


@compiled
def _follow(
    surface: LimitSurface, contacts: Floats, count: int, x: float, y: float, w: float, space: Workspace
) -> tuple[int, int]:
    """Iterate from (x, y, w), always taking the nearest motion: (its row in ``space.trial``, number of rows).

    The row is -1 if there is none (0 rows) or no convergence.
    """
    found = 0
    for k in range(NEWTON_PASSES + SECANT_PASSES):
        metric = start_metric(surface)
        if x != 0.0 or y != 0.0 or w != 0.0:
            metric = tangent_metric(surface, x, y, w) if k < NEWTON_PASSES else secant_metric(surface, x, y, w)
        found = solve_contacts(metric, contacts, count, space.trial, space.rows)
        if found == 0:
            return -1, 0
        index = _nearest(metric, space.trial, found, x, y, w)
        row = space.trial[index]
        change = squared(metric, row[0] - x, row[1] - y, row[2] - w)
        x, y, w = row[0], row[1], row[2]
        limit = NEWTON_CHANGE if k < NEWTON_PASSES else SECANT_CHANGE
        if change <= limit * limit * squared(metric, x, y, w):
            return index, found
    return -1, found


@compiled
def _nearest(metric: Metric, motions: Floats, found: int, x: float, y: float, w: float) -> int:
    """Row of the motion nearest to (x, y, w); the first of equally near ones."""
    best, least = 0, inf
    for k in range(found):
        apart = squared(metric, motions[k, 0] - x, motions[k, 1] - y, motions[k, 2] - w)
        if apart < least:
            best, least = k, apart
    return best


@compiled
def _other_start(surface: LimitSurface, contacts: Floats, start: int) -> Triple:
    """Further guesses: none, with the hand's first point, and turning either way at that speed."""
    ux, uy = contacts[0, 4], contacts[0, 5]
    if start == 1:
        return 0.0, 0.0, 0.0
    turn = (abs(ux) + abs(uy)) / surface.length
    if start == 2:
        return ux, uy, 0.01 * turn
    return ux, uy, turn if start == 3 else -turn
