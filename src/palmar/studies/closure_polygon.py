"""Can this hand hold a convex polygon: the source's any-orientation test, and the orientations that really work."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, inf, isnan, tau
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.closure.disk_2_2 import Radii
from palmar.mechanics.closure.orientation_set import IntervalArray, contains, total_measure
from palmar.mechanics.closure.polygon_2_3 import CircleTest, any_orientation
from palmar.mechanics.closure.polygon_orientations import frictional_orientations, structural_orientations
from palmar.models.case import Case
from palmar.models.objects import ConvexPolygon

_ALL_ROUND = tau - 1e-6


@dataclass(frozen=True)
class Orientations:
    """The source's circle test for one closure, and the orientations (rad) at which the hand really holds the polygon."""

    circles: CircleTest
    held: IntervalArray

    @property
    def every(self) -> bool:
        """Whether it is held however it is turned."""
        return total_measure(self.held) >= _ALL_ROUND

    @property
    def intervals(self) -> list[tuple[float, float]]:
        """The orientations (rad) as (start, end), an end above 2 pi wraps around."""
        return [(float(start), float(end)) for start, end in self.held]

    def record(self) -> dict[str, Any]:
        """As in the JSON record of `palmar closure`."""
        return {
            "circle_test": self.circles.passed,
            "circle_test_sound": self.circles.sound,
            "orientations_rad": [list(each) for each in self.intervals],
            "share": total_measure(self.held) / tau,
        }


@dataclass(frozen=True)
class PolygonClosure:
    """Both closures of one polygon; force balances at a fixed orientation, whether it could turn is another question."""

    structural: Orientations
    frictional: Orientations
    at_start: tuple[bool, bool]
    reason: str

    def record(self) -> dict[str, Any]:
        """As in the JSON record of `palmar closure`."""
        return {
            "structural": self.structural.record(),
            "frictional": self.frictional.record(),
            "held_at_start": {"structural": self.at_start[0], "frictional": self.at_start[1]},
        }


def polygon_closure(case: Case, plain: Radii, rough: Radii) -> PolygonClosure:
    """``plain`` and ``rough`` are the radii held without and with friction, which the circle test takes."""
    assert isinstance(case.object, ConvexPolygon)
    hand, vertices = case.hand, np.array(case.object.vertices)
    d, length, h, alpha = hand.half_palm, hand.finger_length, hand.half_thickness, case.contact.friction_angle
    circles = [_circles(vertices, radii, d / length, radii is plain) for radii in (plain, rough)]
    structural = Orientations(circles[0], structural_orientations(vertices, d, length, h))
    held = frictional_orientations(vertices, d, length, alpha, h) if alpha > 0.0 else structural.held
    frictional = Orientations(circles[1], held)
    theta = np.array([case.start.theta])
    at_start = (bool(contains(structural.held, theta)[0]), bool(contains(frictional.held, theta)[0]))
    return PolygonClosure(structural, frictional, at_start, _reason(structural, frictional, alpha > 0.0))


def _circles(vertices: NDArray[np.float64], radii: Radii, beta: float, structural: bool) -> CircleTest:
    low, high = float(radii.min), float(radii.max)
    none = isnan(high)
    return any_orientation(vertices, inf if none else low, 0.0 if none else high, beta, structural=structural)


def _reason(structural: Orientations, frictional: Orientations, rough: bool) -> str:
    if structural.every:
        return "held without friction at every orientation"
    without = f"without friction {_where(structural)}"
    return f"with friction held {_where(frictional)}; {without}" if rough else f"held {without}"


def _where(found: Orientations) -> str:
    if found.every:
        return "at every orientation"
    share = total_measure(found.held)
    if share == 0.0:
        return "at no orientation"
    return f"at {degrees(share):.0f} of 360 deg of orientations"
