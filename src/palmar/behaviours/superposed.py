"""Searching: an uncertainty too large for one approach, or one closing, done piece by piece (section 3.4.3).

*Strips.* Approaches side by side, each over all of the depth, from one side of the belief to the other. Whatever a strip
touches is felt, and what is then known has a plan of its own; what it does not touch has not been moved and is left to
the next strip. So the proofs at the leaves are those of any plan.

*Closings.* Without touch the hand closes at one place, sees from its joints whether it holds anything, and goes on to
the next. Closing moves what it touches, also where it does not catch. So it proves something only if all that it may
touch on its way, and could be the object, is caught: what is known must lie in islands that are apart. In one
connected set that fits no region, the fingers push what lies beside the region, and nothing is known of it any more.
"""

from __future__ import annotations

from dataclasses import replace

import shapely
from shapely import affinity
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.approach import Sweep, grow
from palmar.behaviours.fewest import Fewest
from palmar.behaviours.placing import Place, place
from palmar.behaviours.planner import Opening, Planner
from palmar.behaviours.policy import Approach, Branch, Close, Lost, Policy, approaches, leaves
from palmar.behaviours.search import Found, Move, Search, width

MOST_STRIPS = 60
STRIP_SWEEPS = 20_000
"""Approaches looked at in all."""
ASIDE = 1e-6
"""How far a strip reaches beyond the side of a belief, as a share of the strip."""


def strips(planner: Planner, belief: BaseGeometry, most: int) -> Found:
    """Strips from the left or from the right, whichever takes fewer approaches; ``most`` from a touch on, it included.

    The hand faces as it stands.
    """
    straight = replace(planner, most_sweeps=STRIP_SWEEPS, directions=(0.0,))
    search = Search(straight, Fewest(straight))
    found = [_strips(search, belief, most, side, MOST_STRIPS) for side in (-1.0, 1.0)]
    best = min(found, key=lambda each: (left_over(each), approaches(each)))
    return Found(best, search.fewest.least(belief, approaches(best)), False, search.sweeps)


def left_over(policy: Policy) -> float:
    """Area (m^2) of all beliefs that a policy leaves without a proof."""
    return float(sum(each.belief.area for each in leaves(policy) if isinstance(each, Lost)))


def _strips(search: Search, belief: BaseGeometry, most: int, side: float, left: int) -> Policy:
    closing = search.closing(belief, 0.0)
    if closing is not None or left == 0:
        return closing or Lost(belief)
    for move in _along_the_side(search.planner, belief, side):
        swept = search.swept(move)
        branches = None if swept is None else _felt(search, swept, belief, most)
        if swept is None or branches is None:
            continue
        for rest in (each.belief for each in swept.felt if each.sensor is None):
            branches += (Branch(None, rest, _strips(search, rest, most, side, left - 1)),)
        return Approach(belief, swept.x, swept.y, swept.distance, move.opening.angle, branches)
    return Lost(belief)


def _along_the_side(planner: Planner, belief: BaseGeometry, side: float) -> list[Move]:
    """Approaches with an end of some piece of the profile at the side of a belief, the one that reaches farthest first."""
    left, _, right, _ = belief.bounds
    edge, off = (left, planner.doubt.off) if side < 0.0 else (right, -planner.doubt.off)
    found = []
    for each in planner.openings:
        reach = each.profile.right if side < 0.0 else -each.profile.left
        across = each.profile.right - each.profile.left
        for piece in each.profile.pieces:
            end = float(piece.points[0 if side < 0.0 else -1, 0])
            x = edge - end - 1.01 * off + side * (piece.blur + ASIDE * across)
            found.append((reach - side * x, Move(0.0, 0.0, belief, each, x, False)))
    return [move for _, move in sorted(found, key=lambda pair: -pair[0])]


def _felt(search: Search, swept: Sweep, belief: BaseGeometry, most: int) -> tuple[Branch, ...] | None:
    """A plan for whatever may be felt; None where there is none, or where nothing of the width is gained."""
    branches: list[Branch] = []
    for each in swept.felt:
        if each.sensor is None:
            if width(each.belief) >= width(belief) * (1.0 - ASIDE):
                return None
            continue
        plans = (search.solve(each.belief, depth, 0.0) for depth in range(most))
        then = next((each for each in plans if each is not None), None)
        if then is None:
            return None
        branches.append(Branch(each.sensor, each.belief, then))
    return tuple(branches)


def closings_only(planner: Planner, belief: BaseGeometry) -> Found:
    """Closings at one island of a belief after the other, several islands at once where they fit.

    As few as found: the islands at which the hand touches no other are tried from the largest group down.
    """
    return Found(_closings(planner, list(shapely.get_parts(belief))), 0, False, 0)


def _closings(planner: Planner, islands: list[BaseGeometry]) -> Policy:
    best: tuple[int, list[int], Close] | None = None
    for k in range(len(islands)):
        group = _group(planner, islands, k)
        rest = [each for j, each in enumerate(islands) if j not in group]
        closing = _apart(planner, shapely.union_all([islands[j] for j in group]), rest) if group else None
        if closing is not None and (best is None or len(group) > best[0]):
            best = len(group), group, closing
    if best is None:
        return Lost(shapely.union_all(islands))
    _, group, closing = best
    rest = [
        affinity.translate(each, -closing.place.x, -closing.place.y) for j, each in enumerate(islands) if j not in group
    ]
    return replace(closing, otherwise=_closings(planner, rest)) if rest else closing


def _group(planner: Planner, islands: list[BaseGeometry], first: int) -> list[int]:
    """Islands that fit together with the first one, the nearest asked first; none if it does not fit itself."""
    group: list[int] = []
    for j in sorted(range(len(islands)), key=lambda j: islands[first].distance(islands[j]) if j != first else -1.0):
        if planner.closing(shapely.union_all([islands[k] for k in (*group, j)])) is not None:
            group.append(j)
        elif not group:
            break
    return group


def _apart(planner: Planner, belief: BaseGeometry, rest: list[BaseGeometry]) -> Close | None:
    """The closing with the largest margin that touches nothing of the rest on its way; None without one."""
    doubtful = grow(belief, planner.doubt.pose_error)
    others = grow(shapely.union_all(rest), planner.doubt.pose_error)
    best: tuple[Place, Opening] | None = None
    for each in planner.openings:
        found = place(each.target, doubtful)
        if found is None or (best is not None and found.margin <= best[0].margin):
            continue
        if not affinity.translate(each.swept, found.x, found.y).intersects(others):
            best = found, each
    return None if best is None else Close(belief, best[0], best[1].angle)
