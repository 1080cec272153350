"""How much of the allowed error is lost when the object presses on the table off its centre.

The offset is fixed in the object, whose turn at the start is unknown: it may point any way, and the worst counts. The
circle of allowed error is probed from its middle along rays, which are bisected for the first lost start; nothing
is proven about starts between them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from palmar.geometry.planar_set import Circle
from palmar.models.case import Case
from palmar.models.outcome import Outcome
from palmar.studies.simulate import simulate_starts

Floats = NDArray[np.float64]
WAYS, RAYS, STOPS, HALVINGS = 8, 36, 12, 9
INNERMOST = 0.25
"""Rays are followed from this share of the allowed error outwards."""


@dataclass(frozen=True)
class OffsetEffect:
    """Allowed error (m) with the pressure's centre off by ``offset`` (m), the worst way, and without; ``sampled``."""

    offset: float
    allowed: float
    without: float

    @property
    def lost_per_offset(self) -> float:
        """Allowed error lost per offset, m per m."""
        return max(self.without - self.allowed, 0.0) / self.offset


def offset_effect(case: Case, circle: Circle, offset: float) -> OffsetEffect:
    """Simulate the case with the pressure's centre off by ``offset`` (m) in several ways.

    Raises NotCoveredError where no kernel carries the case.
    """
    turns = 2.0 * np.pi * np.arange(WAYS) / WAYS
    ways = [(offset * float(np.cos(turn)), offset * float(np.sin(turn))) for turn in turns]
    return OffsetEffect(offset, min(allowed_along_rays(_off_centre(case, way), circle) for way in ways), circle.radius)


def _off_centre(case: Case, way: tuple[float, float]) -> Case:
    x, y = case.support.pressure_centre
    support = case.support.model_copy(update={"pressure_centre": (x + way[0], y + way[1])})
    return case.model_copy(update={"support": support})


def allowed_along_rays(case: Case, circle: Circle) -> float:
    """The least distance (m) from the circle's centre, along any ray, of a start that is lost; at most its radius."""
    turns = 2.0 * np.pi * np.arange(RAYS) / RAYS
    rays = np.column_stack([np.cos(turns), np.sin(turns)])
    stops = circle.radius * np.linspace(INNERMOST, 1.0 - 1e-6, STOPS)
    caught = _caught(case, circle, np.repeat(rays, STOPS, axis=0), np.tile(stops, RAYS)).reshape(RAYS, STOPS)
    if not caught[:, 0].all():
        return 0.0
    bad = ~caught.all(axis=1)
    first = np.argmin(caught[bad], axis=1)
    low, high = stops[first - 1], stops[first]
    for _ in range(HALVINGS if bad.any() else 0):
        middle = 0.5 * (low + high)
        good = _caught(case, circle, rays[bad], middle)
        low, high = np.where(good, middle, low), np.where(good, high, middle)
    return float(low.min()) if bad.any() else circle.radius


def _caught(case: Case, circle: Circle, rays: Floats, distances: Floats) -> NDArray[np.bool_]:
    places = np.array(circle.centre) + rays * distances[:, None]
    poses = np.column_stack([places, np.full(len(places), case.start.theta)])
    caught: NDArray[np.bool_] = simulate_starts(case, poses).codes <= Outcome.CAGED.code
    return caught
