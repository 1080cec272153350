"""All the circumstances of a brief at once: from where an object is caught whatever its radius, friction and restitution.

A range stands for its ends and, of radii and restitutions, for values between; polygons for orientations all around, those
that are alike to the hand once. The worlds are built once and asked for many places.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import slider_body
from palmar.models.behaviour import Behaviour
from palmar.models.case import Case
from palmar.models.contact import Contact
from palmar.models.design_brief import DesignBrief
from palmar.models.hand import Hand
from palmar.models.jointed_motion import JOINTED_CLOSING
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.outcome import Outcome
from palmar.models.sensors import Sensors
from palmar.models.support import Support, SupportKind
from palmar.regions.alike import different_orientations
from palmar.regions.simulated import object_reach
from palmar.worlds.planar.free import free_world
from palmar.worlds.planar.jointed import jointed_world
from palmar.worlds.planar.stepping import stepping_world

Floats = NDArray[np.float64]
STRAIGHT = Behaviour()
"""Fingers kept straight close from fully open."""
RADII, RESTITUTIONS, ORIENTATIONS = 3, 3, 24
"""Of a range; polygons are turned evenly about the full turn."""
RAYS, HALVINGS, FINE_HALVINGS = 48, 7, 10
"""Of a circle, a half of which has half of the rays; of the way along a ray, the latter for the circle's radius."""


def case_of(
    brief: DesignBrief, hand: Hand, thing: Disk | ConvexPolygon, friction: float, restitution: float = 1.0,
    does: Behaviour = STRAIGHT,
) -> Case:  # fmt: skip
    """One of the circumstances of the brief."""
    return Case(
        hand=hand,
        object=thing,
        contact=Contact(friction=friction, restitution=restitution),
        support=Support(kind=brief.targets.support),
        sensors=brief.targets.sensors or Sensors(),
        behaviour=does,
    )


class Circumstances:
    """Asks the batch kernels which places are caught under all circumstances of a brief, its margin included.

    ``mirrored``: places left of the axis are caught as their mirror images are. ``lowest`` (m): centres that all may have.
    """

    def __init__(self, brief: DesignBrief, hand: Hand, does: Behaviour = STRAIGHT) -> None:
        things = _things(brief)
        self.lowest = max(map(object_reach, things)) + hand.half_thickness + 1e-9
        turns, self.mirrored = _turns(brief, hand, things[0])
        every = product(things, _frictions(brief), _restitutions(brief))
        cases = [case_of(brief, hand, thing, friction, e, does) for thing, friction, e in every]
        self._directions = RAYS * brief.fineness
        self._ways = [(_outcomes(case), float(turn)) for case in cases for turn in turns]

    def one_by_one(self, places: Floats) -> Iterator[NDArray[np.bool_]]:
        """Which of the places (N, 2), m, are caught under the circumstances so far, after each further one."""
        held = np.ones(len(places), np.bool_)
        for outcomes, turn in self._ways:
            left = np.flatnonzero(held)
            starts = np.column_stack([places[left], np.full(len(left), turn)])
            held[left] = outcomes(starts) <= Outcome.CAGED.code if len(left) else False
            yield held

    def caught(self, places: Floats) -> NDArray[np.bool_]:
        """Which of the places (N, 2), m, are caught whatever the circumstances."""
        held = np.ones(len(places), np.bool_)
        for so_far in self.one_by_one(places):
            held = so_far
            if not held.any():
                break
        return held

    def boundary(self, place: tuple[float, float], most: float) -> Floats:
        """Places (K, 2), m, around a place up to which starts are caught, at most ``most`` (m) away from it."""
        along = self._rays(place)
        low, high = np.zeros(len(along)), np.full(len(along), most)
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            held = self.caught(np.array(place) + middle[:, None] * along)
            low, high = np.where(held, middle, low), np.where(held, high, middle)
        found: Floats = np.array(place) + low[:, None] * along
        return found

    def circle(self, place: tuple[float, float], most: float) -> float:
        """How far (m), at most ``most``, from a place starts are caught in every direction looked in.

        A direction in which they are caught farther than in another is not followed any more.
        """
        along = self._rays(place)
        low, high = np.zeros(len(along)), np.full(len(along), most)
        for _ in range(FINE_HALVINGS):
            some = np.flatnonzero(low < high.min())
            middle = 0.5 * (low[some] + high[some])
            held = self.caught(np.array(place) + middle[:, None] * along[some])
            low[some], high[some] = np.where(held, middle, low[some]), np.where(held, high[some], middle)
        return float(low.min())

    def _rays(self, place: tuple[float, float]) -> Floats:
        """Directions (K, 2), to the right only where what is caught is symmetric about the place."""
        half = self.mirrored and place[0] == 0.0
        angles = np.linspace(-0.5 * np.pi, (0.5 if half else 1.5) * np.pi, self._directions // (2 if half else 1) + 1)
        return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def _things(brief: DesignBrief) -> list[Disk | ConvexPolygon]:
    """The objects, the ends of the range of radii first: they decide, and what is lost is asked about no more."""
    if brief.targets.vertices is None:
        return [Disk(radius=each) for each in _ends_first(brief.held, (RADII - 1) * brief.fineness + 1)]
    grown = 1.0 + brief.limits.margin
    return [ConvexPolygon(shape="polygon", vertices=tuple((grown * x, grown * y) for x, y in brief.targets.vertices))]


def _frictions(brief: DesignBrief) -> list[float]:
    """Disks are lost first with the least friction; polygons also by more of it, which wedges them."""
    if brief.targets.vertices is None:
        return [brief.least_friction.friction]
    return list(dict.fromkeys((brief.least_friction.friction, brief.targets.friction[1])))


def _restitutions(brief: DesignBrief) -> list[float]:
    free = brief.targets.support is SupportKind.FREE
    return _ends_first(brief.targets.restitution, (RESTITUTIONS - 1) * brief.fineness + 1) if free else [1.0]


def _ends_first(span: tuple[float, float], count: int) -> list[float]:
    low, high = span
    return [high, low, *np.linspace(low, high, count)[1:-1].tolist()] if low < high else [high]


def _turns(brief: DesignBrief, hand: Hand, thing: Disk | ConvexPolygon) -> tuple[Floats, bool]:
    """Orientations (rad) that stand for all, and whether these are their own mirror images before the hand."""
    if isinstance(thing, Disk):
        return np.zeros(1), True
    slider = slider_of(thing, case_of(brief, hand, thing, 0.0).support)
    turns = np.linspace(0.0, 2.0 * np.pi, ORIENTATIONS * brief.fineness, endpoint=False)
    found = different_orientations(slider_body(slider, 0.0), slider.centre, turns, symmetric_hand=True)
    return found.thetas, found.mirrored


def _outcomes(case: Case) -> Callable[[Floats], NDArray[np.int8]]:
    """From starts (N, 3) to outcome codes; a finger that is held up before it closes has caught nothing."""
    if case.support.kind is SupportKind.FREE:
        free = free_world(case)
        return lambda starts: free.ends(np.column_stack([starts, np.zeros((len(starts), 2))])).codes
    if case.behaviour.name in JOINTED_CLOSING:
        jointed = jointed_world(case)
        return lambda starts: jointed.ends(starts)[0].codes
    stepping = stepping_world(case)
    return lambda starts: stepping.ends(starts).codes
