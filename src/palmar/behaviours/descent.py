"""Coming down on a cylinder with three fingertips: what each touch tells, and the moves that surely end in a grasp.

The hand comes down along the cylinder's axis. A tip lands on the top if it stands less than rho = R + r_t from the axis:
then the axis is in the disk of radius rho about that tip. Tips come first; only if none has touched can the palm, a disk of
radius r_p, touch: then the axis is within R + r_p of the hand's middle. Which tips touch tells which of those disks the axis
is in and which it is not in; the belief becomes that set, and the hand lifts, moves and comes down again, or closes.

One frame serves a whole plan: that of the table, its origin where the object is thought to be. ``Closing`` is a proof: the
belief it has lies in the region of the closing tips there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from math import cos, pi, sin

import shapely
from shapely import MultiPolygon, Point, affinity
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.placing import Target, place
from palmar.geometry.planar_set import areal
from palmar.mechanics.pushing.three_tips import AXES
from palmar.models.three_tips import ThreeTips

ARC = 24
"""Corners of a quarter circle."""
PALM, NOTHING = ("palm",), ("nothing",)
Felt = tuple[str, ...]
"""What fires: the tips that touch, in order, or the palm, or nothing."""
TURNS = 12
"""Ways tried for the hand to stand when it closes, within 120 degrees."""
LEAST = 1e-9
"""Share of the region's area below which a belief is taken for empty, and grown by nothing: rounding of the polygons."""


@dataclass(frozen=True)
class Stand:
    """Where the hand is: its middle (m), its turn (rad) and the radius (m) of the circle of tips."""

    x: float
    y: float
    turn: float
    opening: float

    @property
    def tips(self) -> list[tuple[float, float]]:
        """Centres (m) of the three tips."""
        c, s = cos(self.turn), sin(self.turn)
        return [
            (self.x + self.opening * (c * u - s * v), self.y + self.opening * (s * u + c * v))
            for u, v in ((float(each[0]), float(each[1])) for each in AXES)
        ]


@dataclass(frozen=True)
class Closing:
    """Come down at ``stand`` and close; ``margin`` (m): how far the belief may be shifted. ``there``: stay, no margin."""

    belief: BaseGeometry
    stand: Stand
    margin: float
    there: bool = False


@dataclass(frozen=True)
class Branch:
    """What to do if exactly this is felt."""

    felt: Felt
    belief: BaseGeometry
    then: Descending


@dataclass(frozen=True)
class Descent:
    """Come down at ``stand`` until something touches, or to the table."""

    belief: BaseGeometry
    stand: Stand
    branches: tuple[Branch, ...]


@dataclass(frozen=True)
class Stuck:
    """No way on within the approaches allowed, among the moves tried."""

    belief: BaseGeometry


Descending = Closing | Descent | Stuck


def descents(plan: Descending) -> int:
    """Approaches in the worst case: times that the hand comes down, the last time included."""
    if isinstance(plan, Closing):
        return 0 if plan.there else 1
    return 1 + max(descents(each.then) for each in plan.branches) if isinstance(plan, Descent) else 0


def ends_of(plan: Descending) -> Iterator[Closing | Stuck]:
    """Every end of the tree, in order."""
    if isinstance(plan, Descent):
        for each in plan.branches:
            yield from ends_of(each.then)
    else:
        yield plan


def is_certain(plan: Descending) -> bool:
    """Whether every end is a proof."""
    return all(isinstance(each, Closing) for each in ends_of(plan))


@dataclass(frozen=True)
class Reach:
    """A hand of three tips over a cylinder of ``radius`` (m), with the regions of closing, and what is assumed of touches.

    ``displacement`` (m): how far a touch may shift the cylinder; ``pose_error`` (m): how far the hand may be from where it
    should be; ``unfelt`` (m): by how much less than rho a tip may be from the axis and not be felt, for it hangs beside the
    rim or slides off it. ``target``: the region of closing from the open circle; ``standing``: with what borders it at the
    tips (``regions.three_tips.beside_tips``), for a hand that already stands there. ``turns``: ways tried for the hand to
    stand, within 120 degrees.
    """

    tips: ThreeTips
    radius: float
    target: Target
    standing: MultiPolygon
    displacement: float = 0.0
    pose_error: float = 0.0
    unfelt: float = 0.0
    turns: int = TURNS

    @property
    def rho(self) -> float:
        """R + r_t (m)."""
        return self.radius + self.tips.tip_radius

    def outcomes(self, belief: BaseGeometry, stand: Stand) -> Iterator[tuple[Felt, BaseGeometry]]:
        """What may be felt there, and the belief after it: an outer set, touches' polygons being drawn on the safe side."""
        sure = [_disk(at, self.rho - self.pose_error - self.unfelt, inside=True) for at in stand.tips]
        may = [_disk(at, self.rho + self.pose_error, inside=False) for at in stand.tips]
        for number in (1, 2, 3):
            for touched in combinations(range(3), number):
                left = belief
                for k in range(3):
                    left = left.intersection(may[k]) if k in touched else left.difference(sure[k])
                yield from self._felt(tuple(f"tip {k + 1}" for k in touched), left, self.displacement)
        clear = self._passed(belief.difference(shapely.union_all(sure)), stand)
        if self.tips.palm_radius is None:
            yield from self._felt(NOTHING, clear, 0.0)
            return
        palm, middle = self.radius + self.tips.palm_radius, (stand.x, stand.y)
        yield from self._felt(PALM, clear & _disk(middle, palm + self.pose_error, inside=False), self.displacement)
        yield from self._felt(NOTHING, clear - _disk(middle, palm - self.pose_error, inside=True), 0.0)

    def _passed(self, clear: BaseGeometry, stand: Stand) -> BaseGeometry:
        """After tips that felt nothing have passed the top: those that slid off the rim have pushed the cylinder aside."""
        if self.unfelt == 0.0:
            return clear
        beside = [_disk(at, self.rho - self.pose_error, inside=True) for at in stand.tips]
        return grown_by(clear, self.unfelt).difference(shapely.union_all(beside))

    def _felt(self, felt: Felt, left: BaseGeometry, moved: float) -> Iterator[tuple[Felt, BaseGeometry]]:
        belief = areal(left)
        if belief.area > LEAST * self.rho**2:
            yield felt, grown_by(belief, moved)

    def closing(self, belief: BaseGeometry, stand: Stand | None = None) -> Closing | None:
        """A place for the wide open hand from where closing catches all of the belief; None where none was found.

        With ``stand``, first where the hand already is, if its tips are open to their circle.
        """
        seen = grown_by(belief, self.pose_error)
        stays = stand is not None and stand.opening == self.tips.open_radius
        if stand is not None and stays and self.standing.covers(self._from_hand(stand, seen)):
            return Closing(belief, stand, 0.0, there=True)
        if seen.area > self.target.region.area:
            return None
        best: Closing | None = None
        for k in range(self.turns):
            turn = 2.0 * pi / 3.0 * k / self.turns
            for each in self._places(seen, turn):
                margin = self._at(each, seen)
                if margin is not None and (best is None or margin > best.margin):
                    best = Closing(belief, each, margin)
        return best

    def _places(self, seen: BaseGeometry, turn: float) -> Iterator[Stand]:
        """Where to try to close: about the middle of the belief, and where its convex hull has the most room."""
        c, s = cos(turn), sin(turn)
        yield Stand(seen.centroid.x, seen.centroid.y, turn, self.tips.open_radius)
        found = place(self.target, affinity.rotate(seen, -turn, origin=(0.0, 0.0), use_radians=True))
        if found is not None:
            yield Stand(c * found.x - s * found.y, s * found.x + c * found.y, turn, self.tips.open_radius)

    def _at(self, stand: Stand, seen: BaseGeometry) -> float | None:
        """How far (m) the belief may be shifted with the hand there; None if it does not lie in the region."""
        from_hand = self._from_hand(stand, seen)
        if not self.target.region.covers(from_hand):
            return None
        return float(self.target.region.boundary.distance(from_hand))

    def _from_hand(self, stand: Stand, seen: BaseGeometry) -> BaseGeometry:
        moved = affinity.translate(seen, -stand.x, -stand.y)
        return affinity.rotate(moved, -stand.turn, origin=(0.0, 0.0), use_radians=True)


def grown_by(belief: BaseGeometry, distance: float) -> BaseGeometry:
    """The belief with all around it up to ``distance`` (m), an outer set."""
    return belief.buffer(distance / cos(pi / (4.0 * ARC)), quad_segs=ARC) if distance > 0.0 else belief


def _disk(at: tuple[float, float], radius: float, *, inside: bool) -> BaseGeometry:
    """A polygon within a disk (m), or one around it."""
    return Point(at).buffer(max(radius, 0.0) / (1.0 if inside else cos(pi / (4.0 * ARC))), quad_segs=ARC)
