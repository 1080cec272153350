"""The three fingertips of the Salisbury hand as tips on a circle, at one height over the palm; circles through tips."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.arm.salisbury_finger import tip_in_hand
from palmar.models.salisbury_hand import TIP_PREHENSION, SalisburyHand

Floats = NDArray[np.float64]
CURLS = 400
"""At which circles are tabulated."""


def tips_at(hand: SalisburyHand, curls: Floats) -> Floats:
    """Centres (…, 3, 3) in m of the tips in the hand frame, each finger at its own of the curls (…, 3) in rad."""
    joints = TIP_PREHENSION.joints(np.asarray(curls, float))
    return np.stack([tip_in_hand(hand, k, joints[..., k, :]) for k in range(3)], axis=-2)


def alike(curl: float) -> tuple[float, float, float]:
    """The curls (rad) of three fingers that move as one."""
    return curl, curl, curl


@lru_cache
def _circles(hand: SalisburyHand) -> tuple[Floats, Floats]:
    """Curls from open inward, and the circles (m) on which the tips then are, down to the middle."""
    curls = np.linspace(TIP_PREHENSION.opened, hand.joint_limits[1][1], CURLS)
    radial = np.hypot(*tips_at(hand, np.stack([curls] * 3, axis=-1))[:, 0, :2].T)
    inward = int(np.argmax(np.diff(radial, append=np.inf) > 0.0))
    return curls[: inward + 1], radial[: inward + 1]


def open_circle(hand: SalisburyHand) -> float:
    """Radius (m) of the circle of the open hand's tips."""
    return float(_circles(hand)[1][0])


def curl_for(hand: SalisburyHand, circle: float) -> float:
    """The curl (rad) at which the tips are on a circle (m) of at most the open one."""
    curls, circles = _circles(hand)
    return float(np.interp(circle, circles[::-1], curls[::-1]))


def closing_curls(hand: SalisburyHand, circle: float) -> Floats:
    """Curls (…, 3) in rad that the fingers pass as they close from open to a circle (m)."""
    return np.stack([np.linspace(TIP_PREHENSION.opened, curl_for(hand, circle), CURLS // 4)] * 3, axis=-1)


def through(one: Floats, two: Floats, radius: float, near: Floats) -> Floats:
    """Centre (2,) of the circle of a radius (m) through two points (2,), of both the one nearer to a third point."""
    half = 0.5 * (two - one)
    length = float(np.linalg.norm(half))
    side = np.array([-half[1], half[0]]) / length * max(radius**2 - length**2, 0.0) ** 0.5
    centres = np.stack([one + half + side, one + half - side])
    nearest: Floats = centres[np.linalg.norm(centres - near, axis=1).argmin()]
    return nearest


def circumcentre(tips: Floats) -> Floats:
    """Centre (2,) of the circle through three points (3, 2)."""
    sides = 2.0 * (tips[1:] - tips[0])
    squares = (tips**2).sum(axis=1)
    centre: Floats = np.linalg.solve(sides, squares[1:] - squares[0])
    return centre
