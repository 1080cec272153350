"""The source's rule (section 3.4.2): put the middle of the palm under the middle of what is known, approach again.

As a policy it has no choice in it, so it needs no search; where it ends in a proof, so does the search, with no more
approaches. It stops, as the source does, when the belief is small enough: here when it fits into the closing region.
"""

from __future__ import annotations

from shapely.geometry.base import BaseGeometry

from palmar.behaviours.approach import sweep
from palmar.behaviours.planner import Planner
from palmar.behaviours.policy import Approach, Branch, Lost, Policy


def recentring(planner: Planner, belief: BaseGeometry, most: int) -> Policy:
    """The rule's policy for a belief within ``most`` approaches, fingers at the first opening."""
    closing = planner.closing(belief)
    if closing is not None:
        return closing
    left, _, right, _ = belief.bounds
    swept = None if most == 0 else sweep(belief, planner.openings[0].profile, 0.5 * (left + right), planner.doubt)
    if swept is None or all(each.sensor is None for each in swept.felt):
        return Lost(belief)
    branches = tuple(
        Branch(each.sensor, each.belief, recentring(planner, each.belief, most - 1)) for each in swept.felt
    )
    return Approach(belief, swept.x, swept.y, swept.distance, planner.openings[0].angle, branches)
