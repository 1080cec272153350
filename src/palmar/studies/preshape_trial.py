"""Which curl of the distal joint keeps a disk on a circle about the base joint: found by turning the finger (section 6.3).

The right finger's distal joint is curled, the disk lies against the middle of its distal link, and the base joint turns.
With the right curl the disk goes with the finger; with less it rolls outward along the link, with more inward.
"""

from __future__ import annotations

from math import cos, radians, sin

from palmar.errors import NotCoveredError
from palmar.models.case import Case
from palmar.models.motion import Command
from palmar.models.objects import Disk
from palmar.worlds.world import WorldMaker

OPEN, TURN, RATE = radians(20.0), radians(20.0), radians(5.0)
"""Base angle at which the disk is picked up, and how far and how fast that turns then."""
GAP = 1e-4
"""Between link and disk before the base turns (m)."""
LOW, HIGH, FINE = radians(2.0), radians(60.0), radians(0.05)
TICK = 0.02


def drift(case: Case, curl: float, make: WorldMaker) -> float:
    """How far (m) the disk moves outward along the distal link curled by ``curl`` (rad) while the base turns by TURN.

    Raises NotCoveredError for anything but a disk and fingers of two links.
    """
    hand, thing = case.hand, case.object
    if len(hand.finger_links) != 2 or not isinstance(thing, Disk):
        raise NotCoveredError("a preshape is tried with a disk and fingers of two links")
    away, along = thing.radius + hand.half_thickness + GAP, 0.5 * hand.finger_links[1]
    start = _beside(case, OPEN, curl, along, away)
    opened = case.model_copy(update={"hand": hand.model_copy(update={"open": OPEN})})
    world = make(opened, (*start, 0.0), tick=TICK, sensing=None, massive=False)
    rest = (0.0, 0.0)
    world.act(Command((0.0, curl), rest), 1.0)
    for _ in range(round(TURN / RATE / TICK)):
        world.act(Command((RATE, 0.0), rest), TICK)
    base, distal = world.observe().right
    elbow = _beside(case, base, distal, 0.0, 0.0)
    x, y, _ = world.pose
    return (x - elbow[0]) * cos(base + distal) + (y - elbow[1]) * sin(base + distal) - along


def circling_curl(case: Case, make: WorldMaker) -> float:
    """The curl (rad) without a drift, by bisection to FINE; raises NotCoveredError where none lies between LOW and HIGH."""
    low, high = LOW, HIGH
    if not drift(case, low, make) > 0.0 > drift(case, high, make):
        raise NotCoveredError("no curl of the distal joint keeps this disk on a circle")
    while high - low > FINE:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if drift(case, middle, make) > 0.0 else (low, middle)
    return 0.5 * (low + high)


def _beside(case: Case, base: float, distal: float, along: float, away: float) -> tuple[float, float]:
    """The point ``along`` the right distal link and ``away`` from it on its inner side (m)."""
    hand, lean = case.hand, base + distal
    x = hand.half_palm + hand.finger_links[0] * cos(base) + along * cos(lean) - away * sin(lean)
    return x, hand.finger_links[0] * sin(base) + along * sin(lean) + away * cos(lean)
