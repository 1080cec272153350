"""Search for the descents that surely end in a grasp, as few in the worst case as are found on a grid of moves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import cos, hypot, pi, sin

import numpy as np
import shapely
from shapely import affinity
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.descent import Branch, Closing, Descending, Descent, Reach, Stand, Stuck, ends_of

WAYS, OPENINGS = 4, 12
"""Turns (within 120 degrees) and openings tried for a descent."""
THIRD = 2.0 * pi / 3.0
ROUND, NEAR = 0.99, 0.02
"""Share of its circle from which a belief counts as round; share of the radius within which two middles are one."""
ALIKE = 1e-6
"""Share of area, and of rho, by which a belief may differ from another, turned, to be solved by its plan, turned."""


def fewest_descents(
    reach: Reach, belief: BaseGeometry, most: int, openings: tuple[float, ...] | None = None
) -> Descending:
    """A plan with as few approaches as found, up to ``most``; with ``openings`` (m) only these are tried for a descent."""
    tried = openings if openings is not None else _openings(reach)
    for number in range(1, most + 1):
        found = _solved(reach, belief, number, tried, choose=number == 2)
        if found is not None:
            return found
    return Stuck(belief)


def _openings(reach: Reach) -> tuple[float, ...]:
    """Circles (m) from where the tips nearly touch each other, and the widest."""
    low, high = max(reach.tips.touching, reach.tips.closed_radius), reach.tips.open_radius
    return tuple(float(each) for each in np.linspace(low, high, OPENINGS))


def _solved(
    reach: Reach, belief: BaseGeometry, most: int, openings: tuple[float, ...], *, choose: bool = False
) -> Descending | None:
    """A plan with at most so many approaches: the first found, or the one with the most room; None where none was found."""
    closing = reach.closing(belief)
    if closing is not None or most < 2:
        return closing
    best: Descent | None = None
    for stand in _stands(belief, openings, reach.turns):
        found = _descent(reach, belief, stand, most, openings)
        if found is not None and (best is None or least_margin(found) > least_margin(best)):
            best = found
        if best is not None and not choose:
            break
    return best


def least_margin(plan: Descending) -> float:
    """The smallest distance (m) by which a belief may be shifted where the hand comes down to close; 0 without a proof."""
    moves = [each for each in ends_of(plan) if not (isinstance(each, Closing) and each.there)]
    return min((each.margin if isinstance(each, Closing) else 0.0 for each in moves), default=0.0)


def _stands(belief: BaseGeometry, openings: tuple[float, ...], most: int) -> Iterator[Stand]:
    """Places tried: the middle of the belief and of the circle around it, at each opening and at ``most`` turns or fewer."""
    circle, radius = shapely.minimum_bounding_circle(belief).centroid, float(shapely.minimum_bounding_radius(belief))
    middles = [(belief.centroid.x, belief.centroid.y), (circle.x, circle.y)]
    apart = hypot(middles[0][0] - circle.x, middles[0][1] - circle.y)
    turns = 1 if belief.area > ROUND * pi * radius**2 else min(WAYS, most)
    for x, y in middles[: 1 if apart < NEAR * radius else 2]:
        for k in range(turns):
            for opening in openings:
                yield Stand(x, y, THIRD * k / turns, opening)


def _descent(
    reach: Reach, belief: BaseGeometry, stand: Stand, most: int, openings: tuple[float, ...]
) -> Descent | None:
    """The descent there with plans for all that may be felt; the largest belief is looked at first."""
    outcomes = sorted(reach.outcomes(belief, stand), key=lambda each: -float(each[1].area))
    if outcomes and outcomes[0][1].area > (1.0 - 1e-9) * belief.area:
        return None if reach.closing(belief, stand) is None else _only(reach, belief, stand, outcomes[0])
    done: list[Branch] = []
    for felt, left in outcomes:
        then: Descending | None = _as_before(reach, left, done, stand) or reach.closing(left, stand)
        then = then or _solved(reach, left, most - 1, openings)
        if then is None:
            return None
        done.append(Branch(felt, left, then))
    return Descent(belief, stand, tuple(sorted(done, key=lambda each: each.felt)))


def _only(
    reach: Reach, belief: BaseGeometry, stand: Stand, outcome: tuple[tuple[str, ...], BaseGeometry]
) -> Descent | None:
    """A descent that tells nothing is worth it only where it closes at once."""
    closing = reach.closing(outcome[1], stand)
    return Descent(belief, stand, (Branch(*outcome, closing),)) if closing is not None else None


def _as_before(reach: Reach, left: BaseGeometry, done: list[Branch], stand: Stand) -> Descending | None:
    """The plan of a branch whose belief, turned by a third about the hand, holds this one but for less than its margins."""
    slack = ALIKE * reach.rho
    for each in done:
        if abs(float(each.belief.area - left.area)) > ALIKE * left.area or least_margin(each.then) <= 2.0 * slack:
            continue
        for angle in (THIRD, -THIRD):
            image = affinity.rotate(each.belief, angle, origin=(stand.x, stand.y), use_radians=True)
            if image.buffer(slack).covers(left):
                return _turned(each.then, angle, (stand.x, stand.y))
    return None


def _turned(plan: Descending, angle: float, about: tuple[float, float]) -> Descending:
    """The plan turned as a whole; its proofs hold as before."""
    belief = affinity.rotate(plan.belief, angle, origin=about, use_radians=True)
    if isinstance(plan, Stuck):
        return Stuck(belief)
    c, s = cos(angle), sin(angle)
    x, y = plan.stand.x - about[0], plan.stand.y - about[1]
    stand = replace(plan.stand, x=about[0] + c * x - s * y, y=about[1] + s * x + c * y, turn=plan.stand.turn + angle)
    if isinstance(plan, Closing):
        return replace(plan, belief=belief, stand=stand)
    branches = tuple(
        Branch(
            each.felt,
            affinity.rotate(each.belief, angle, origin=about, use_radians=True),
            _turned(each.then, angle, about),
        )
        for each in plan.branches
    )
    return Descent(belief, stand, branches)
