"""Which still preshape turns most of what comes from a known direction to the palm (section 5.3.2), and its cone."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, pi, radians, sin

import numpy as np

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.redirect_5_3_2 import Interval, PreshapedHand, direct_window, redirected_window, width
from palmar.models.case import Case
from palmar.models.jointed_motion import distal_limit
from palmar.models.objects import Disk
from palmar.models.support import SupportKind

STEP, ROUNDS = radians(5.0), 5
"""Of the grid of base and distal angles, and halvings of it about the best."""
DIRECTIONS = tuple(radians(each) for each in range(-180, 1, 3))
HALF, TENTH = 0.5, radians(0.1)


@dataclass(frozen=True)
class Catch:
    """One direction (rad) of flight: windows (m) of paths to the palm, directly, by the right and the left distal link."""

    direction: float
    direct: Interval
    right: Interval
    left: Interval

    @property
    def width(self) -> float:
        """Of all windows together (m)."""
        return sum(width(each) for each in (self.direct, self.right, self.left))


@dataclass(frozen=True)
class Redirection:
    """The preshape of the largest width, what it catches, and the directions (rad) with at least half of that width."""

    hand: PreshapedHand
    catch: Catch
    cone: tuple[float, float]
    by_direction: tuple[Catch, ...]


def redirection(case: Case, direction: float) -> Redirection | None:
    """For disks that fly along ``direction`` (rad, -pi/2 straight at the palm); None if none reaches the palm.

    Raises NotCoveredError for tables, polygons, friction, ranges and hands of other than two links a finger.
    """
    hand = case.hand
    if case.support.kind is not SupportKind.FREE or not isinstance(case.object, Disk) or case.ranges:
        raise NotCoveredError("--from: this is for free disks, and plain numbers")
    if len(hand.finger_links) != 2:
        raise NotCoveredError(f"--from: this is for fingers of two links, not {len(hand.finger_links)}")
    proximal, distal = hand.finger_links
    first = PreshapedHand(hand.half_palm, (proximal, distal), hand.half_thickness, case.object.radius, 0.0, 0.0)
    e = case.contact.restitution
    lows, highs = (hand.base_limits[0], -distal_limit(hand)), (min(hand.base_limits[1], 0.75 * pi), distal_limit(hand))
    if hand.joint_limits is not None:
        lows = lows[0], max(hand.joint_limits[1][0], -distal_limit(hand))
    best, step = max(
        (replace(first, base=base, bend=bend) for base in np.arange(max(lows[0], STEP), highs[0], STEP)
         for bend in np.arange(lows[1], highs[1] + 1e-9, STEP)),
        key=lambda each: catch_of(each, direction, e).width,
    ), STEP  # fmt: skip
    for _ in range(ROUNDS):
        step *= 0.5
        near = [
            replace(first, base=float(np.clip(best.base + i * step, max(lows[0], step), highs[0])),
                    bend=float(np.clip(best.bend + j * step, lows[1], highs[1])))
            for i in (0, -1, 1) for j in (0, -1, 1)
        ]  # fmt: skip
        best = max(near, key=lambda each: catch_of(each, direction, e).width)
    found = catch_of(best, direction, e)
    if found.width == 0.0:
        return None
    around = tuple(catch_of(best, each, e) for each in DIRECTIONS)
    return Redirection(best, found, _cone(best, found, e), around)


def catch_of(hand: PreshapedHand, direction: float, restitution: float) -> Catch:
    """The windows of one direction (rad)."""
    way = np.array([cos(direction), sin(direction)])
    right, left = (redirected_window(hand, way, restitution, side) for side in (1.0, -1.0))
    return Catch(direction, direct_window(hand, way), right, left)


def _cone(hand: PreshapedHand, best: Catch, restitution: float) -> tuple[float, float]:
    """How far the direction may turn to either side with half of the width left, to a tenth of a degree."""
    ends = []
    for way in (-1.0, 1.0):
        turn = 0.0
        while turn < pi:
            farther = catch_of(hand, best.direction + way * (turn + TENTH), restitution)
            if farther.width < HALF * best.width:
                break
            turn += TENTH
        ends.append(best.direction + way * turn)
    return ends[0], ends[1]
