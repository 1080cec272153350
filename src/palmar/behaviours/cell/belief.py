"""Where the axis of a standing cylinder may be, as a polygon, and the next move that this set allows.

The same reasoning as in ``behaviours.descent``: which tips touch tells in which disks about them the axis is and in which it
is not, and the hand closes only from where the region of three closing tips holds the whole set. Frame of all of it: the
x and y of the hand as it started, the origin where the axis was first seen.

The tips close without friction here: their region is then the smallest, whatever the friction.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, pi

import shapely
from shapely import Point
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.cell.tip_circle import open_circle
from palmar.behaviours.descending import fewest_descents
from palmar.behaviours.descent import ARC, NOTHING, Branch, Closing, Descent, Reach, Stand, Stuck, grown_by
from palmar.behaviours.placing import target
from palmar.geometry.planar_set import areal
from palmar.models.cell_task import Cylinder
from palmar.models.salisbury_hand import SalisburyHand
from palmar.models.three_tips import ThreeTips
from palmar.regions.three_tips import beside_tips, tips_region

DISPLACED, ARM_OFF = 0.002, 0.0005
"""How far (m) a touch may shift the cylinder; how far the hand may be from where it should be."""
FEELING = (0.6, 0.8)
"""Circles of the tips as they come down to feel, over R + r_t."""
TURNS = 12
"""Ways tried for the hand to stand, within 120 degrees."""
GRAIN = 5e-4
"""Radii (m) of first sets are rounded up to multiples of this, so that plans are found once."""
MOST = 3
"""Approaches up to which a certain plan is looked for."""
Move = Closing | Descent


@lru_cache
def reach_of(hand: SalisburyHand, cylinder: Cylinder) -> Reach:
    """The hand's tips over a cylinder; a tip beside the rim, by up to its radius, is not felt."""
    opened, tip = open_circle(hand), hand.tip_radius
    tips = ThreeTips(tip_radius=tip, open_radius=opened, closed_radius=2.0 * tip / 3.0**0.5 * (1.0 + 1e-9))
    region = tips_region(tips, cylinder.radius, 0.0).centre
    standing = areal(region | beside_tips(tips, cylinder.radius, 0.0))
    return Reach(tips, cylinder.radius, target(region), standing, DISPLACED, ARM_OFF, tip, TURNS)


def around(place: tuple[float, float], error: float) -> BaseGeometry:
    """A polygon around all places within ``error`` (m) of one."""
    return grown_by(Point(place), error)


@dataclass(frozen=True)
class Reasoning:
    """What one hand's touches tell of where one cylinder stands, and which move then surely ends in a grasp.

    ``feel``: whether its tips may come down on the cylinder's top; if not, only closing is left, and there is no move (None)
    where that is not certain.
    """

    hand: SalisburyHand
    cylinder: Cylinder
    feel: bool

    @property
    def reach(self) -> Reach:
        """The hand over the cylinder."""
        return reach_of(self.hand, self.cylinder)

    def first(self, error: float, most: int) -> Move | None:
        """For an axis within ``error`` (m) of the origin: of the plan that is certain with up to so many approaches."""
        return _first(self, GRAIN * ceil(error / GRAIN - 1e-9), min(most, MOST))

    def next(self, belief: BaseGeometry) -> Move | None:
        """Close where that is certain; else come down over the middle to learn more. Found within a step's time."""
        closing = self.reach.closing(belief)
        return closing if closing is not None or not self.feel else _look_closer(self.reach, belief)

    def after_touch(self, move: Move, fingers: tuple[bool, ...], error: float) -> Move | None:
        """The hand has come down as ``move`` says, and these fingers have touched, or none has.

        What contradicts the belief counts alone: the axis is then near the fingers that touched, or, without any, within
        ``error`` (m) of the origin.
        """
        number = standing_turn(move.stand.turn)[1]
        touched = tuple(fingers[(j + number) % 3] for j in range(3))
        felt = tuple(f"tip {j + 1}" for j, each in enumerate(touched) if each) or NOTHING
        for branch in move.branches if isinstance(move, Descent) else ():
            if branch.felt == felt:
                then = branch.then
                return self.next(then.belief) if isinstance(then, Stuck) else then
        return self.next(only_felt(self.reach, move.stand, touched) if any(touched) else around((0.0, 0.0), error))

    def after_nothing(self, move: Move, belief: BaseGeometry) -> Move | None:
        """The hand has closed on nothing where ``move`` says, the axis being anywhere in ``belief``."""
        return self.next(not_caught(self.reach, belief, move.stand))


@lru_cache
def _first(reasoning: Reasoning, error: float, most: int) -> Move | None:
    reach, belief = reasoning.reach, around((0.0, 0.0), error)
    if not reasoning.feel:
        return reasoning.next(belief)
    openings = (*(each * reach.rho for each in FEELING), reach.tips.open_radius)
    found = fewest_descents(reach, belief, most, openings)
    return reasoning.next(belief) if isinstance(found, Stuck) else found


def _look_closer(reach: Reach, belief: BaseGeometry) -> Descent:
    middle = shapely.minimum_bounding_circle(belief).centroid
    stand = Stand(middle.x, middle.y, 0.0, FEELING[0] * reach.rho)
    branches = [Branch(felt, left, Stuck(left)) for felt, left in reach.outcomes(belief, stand)]
    return Descent(belief, stand, tuple(branches))


def only_felt(reach: Reach, stand: Stand, touched: tuple[bool, ...]) -> BaseGeometry:
    """What touches say by themselves, where they contradict all that was believed: the axis is near one of these tips."""
    near = reach.rho + reach.pose_error + reach.displacement
    disks = [around(at, near) for at, each in zip(stand.tips, touched, strict=True) if each]
    common = shapely.intersection_all(disks)
    return common if not areal(common).is_empty else shapely.union_all(disks)


def not_caught(reach: Reach, belief: BaseGeometry, stand: Stand) -> BaseGeometry:
    """What is left of a belief after a hand has closed on nothing: the region there is free."""
    inner = reach.target.region.buffer(-reach.pose_error, quad_segs=ARC)
    turned = shapely.affinity.rotate(inner, stand.turn, origin=(0.0, 0.0), use_radians=True)
    left = areal(belief.difference(shapely.affinity.translate(turned, stand.x, stand.y)))
    return belief if left.is_empty else left


def standing_turn(turn: float) -> tuple[float, int]:
    """A turn (rad) of the tips -> the smallest turn of the hand that puts tips there, and by how many fingers it is off.

    The plan's tip j is then finger (j + number) mod 3.
    """
    third = 2.0 * pi / 3.0
    number = round(turn / third)
    return turn - number * third, number % 3
