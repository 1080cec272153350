"""A plan as a tree: approach, look which sensor fired, approach again or close. Every leaf is a proof or a failure.

Places are in the hand frame before the move, after the hand has turned by ``turn`` (rad, counter-clockwise, about the
frame's origin, far enough back to touch nothing). ``Close`` is a proof: its belief, put at its place, lies in the
region of the closing motion, so wherever in it the object is, it is caught.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from shapely import affinity
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.placing import Place


@dataclass(frozen=True)
class Close:
    """Put the hand at ``place``, open to ``opening`` (rad), and close.

    With ``otherwise``, what is done if the fingers close on nothing: the object is then in ``otherwise.belief``, seen from
    ``place``, and has not been touched. ``belief`` is only what this closing catches.
    """

    belief: BaseGeometry
    place: Place
    opening: float
    turn: float = 0.0
    otherwise: Policy | None = None


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
    turn: float = 0.0


@dataclass(frozen=True)
class Lost:
    """No way on within the approaches allowed."""

    belief: BaseGeometry


Policy = Close | Approach | Lost


def approaches(policy: Policy) -> int:
    """Approaches in the worst case."""
    return max((approaches(each) for each in after(policy)), default=0) + isinstance(policy, Approach)


def closings(policy: Policy) -> int:
    """Closing motions in the worst case."""
    return max((closings(each) for each in after(policy)), default=0) + isinstance(policy, Close)


def after(policy: Policy) -> tuple[Policy, ...]:
    """What may come after a move."""
    if isinstance(policy, Approach):
        return tuple(each.then for each in policy.branches)
    return (policy.otherwise,) if isinstance(policy, Close) and policy.otherwise is not None else ()


def leaves(policy: Policy) -> Iterator[Close | Lost]:
    """Every end of the tree, in order; a closing that is followed by another move is one too."""
    if not isinstance(policy, Approach):
        yield policy
    for each in after(policy):
        yield from leaves(each)


def is_guaranteed(policy: Policy) -> bool:
    """Whether every leaf is a proof."""
    return all(isinstance(each, Close) for each in leaves(policy))


def is_straight(policy: Policy) -> bool:
    """Whether the hand never turns."""
    turned = not isinstance(policy, Lost) and policy.turn != 0.0
    return not turned and all(is_straight(each) for each in after(policy))


def seen_turned(belief: BaseGeometry, turn: float) -> BaseGeometry:
    """A set (m) in the hand frame, seen from the hand when it has turned by ``turn`` (rad) about the origin."""
    return belief if turn == 0.0 else affinity.rotate(belief, -turn, origin=(0.0, 0.0), use_radians=True)
