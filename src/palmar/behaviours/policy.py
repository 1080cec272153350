"""A plan as a tree: approach, look which sensor fired, approach again or close. Every leaf is a proof or a failure.

Places are in the hand frame before the move. ``Close`` is a proof: its belief, put at its place, lies in the region of
the closing motion, so wherever in it the object is, it is caught.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from shapely.geometry.base import BaseGeometry

from palmar.behaviours.placing import Place


@dataclass(frozen=True)
class Close:
    """Put the hand at ``place``, open to ``opening`` (rad), and close."""

    belief: BaseGeometry
    place: Place
    opening: float


@dataclass(frozen=True)
class Branch:
    """What to do if this sensor fires (None: nothing is felt); ``belief`` is seen from where the hand then is."""

    sensor: int | None
    belief: BaseGeometry
    then: Policy


@dataclass(frozen=True)
class Approach:
    """Line up at (x, y) (m), fingers at ``opening`` (rad); go along y until a sensor fires, ``distance`` (m) at most."""

    belief: BaseGeometry
    x: float
    y: float
    distance: float
    opening: float
    branches: tuple[Branch, ...]


@dataclass(frozen=True)
class Lost:
    """No way on within the approaches allowed."""

    belief: BaseGeometry


Policy = Close | Approach | Lost


def approaches(policy: Policy) -> int:
    """Approaches in the worst case."""
    if isinstance(policy, Approach):
        return 1 + max((approaches(each.then) for each in policy.branches), default=0)
    return 0


def leaves(policy: Policy) -> Iterator[Close | Lost]:
    """Every end of the tree."""
    if isinstance(policy, Approach):
        for each in policy.branches:
            yield from leaves(each.then)
    else:
        yield policy


def is_guaranteed(policy: Policy) -> bool:
    """Whether every leaf is a proof."""
    return all(isinstance(each, Close) for each in leaves(policy))
