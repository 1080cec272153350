"""How far from its nominal place an object may be so that a hand that closes straight still catches it, whatever it is.

Disks on a table: the exact regions at the ends of the range of radii and between, at the least friction, which decides;
the largest circle in what they have in common. Free disks and polygons: places on a grid, each carried by the batch
kernels under every circumstance asked about, the largest circle of caught ones about the best place, its radius then
bisected along rays. With sensors: whether the planner proves a policy for the error asked about.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from palmar.behaviours.policy import is_guaranteed
from palmar.geometry.planar_set import areal, inscribed_circle
from palmar.models.case import Case
from palmar.models.contact import Contact
from palmar.models.design_brief import DesignBrief
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.outcome import Outcome
from palmar.models.sensors import Sensors
from palmar.models.support import Support, SupportKind
from palmar.regions.disk import disk_sides
from palmar.regions.simulated import object_reach
from palmar.studies.plan import Plan, plan
from palmar.studies.simulate import simulate_starts

Floats = NDArray[np.float64]
Place = tuple[float, float]
RADII, RESTITUTIONS, ORIENTATIONS = 3, 3, 24
"""Of a range in the search; polygons are turned evenly about the full turn."""
FLATTENING = 3e-5
"""Of the boundaries of exact regions, in finger lengths."""
CELLS = 9
"""Steps of the grid across the error's radius."""
ROOM = 1.3
"""The grid reaches so many of the error asked about to each side; larger errors are not told apart."""
RAYS, HALVINGS = 48, 7


@dataclass(frozen=True)
class Tolerance:
    """Radius (m) of the circle of starts that are all caught, and its centre (m, hand frame); None where nothing is."""

    radius: float
    place: Place | None


def tolerance(brief: DesignBrief, hand: Hand) -> Tolerance:
    """What the hand tolerates under all circumstances of the brief."""
    if brief.targets.sensors is not None:
        proved = is_guaranteed(plan_for(brief, hand).found.policy)
        return Tolerance(brief.error if proved else 0.0, place_ahead(brief, hand) if proved else None)
    if is_exact(brief):
        return _of_regions(brief, hand)
    return _of_starts(brief, hand)


def is_exact(brief: DesignBrief) -> bool:
    """Whether regions are known in closed form: disks on a table."""
    return brief.targets.radii is not None and brief.targets.support is SupportKind.TABLE


def case_of(
    brief: DesignBrief, hand: Hand, thing: Disk | ConvexPolygon, friction: float, restitution: float = 1.0
) -> Case:
    """One of the circumstances of the brief."""
    return Case(
        hand=hand,
        object=thing,
        contact=Contact(friction=friction, restitution=restitution),
        support=Support(kind=brief.targets.support),
        sensors=brief.targets.sensors or Sensors(),
    )


def place_ahead(brief: DesignBrief, hand: Hand) -> Place:
    """Where an object to be felt for is thought to be: so far ahead that the hand is clear of all that it may be."""
    return 0.0, 2.0 * (hand.finger_length + brief.held[1] + brief.error)


def plan_for(brief: DesignBrief, hand: Hand) -> Plan:
    """The planner's answer for the error asked about, at the least friction."""
    case = case_of(brief, hand, Disk(radius=brief.held[1]), brief.least_friction.friction)
    return plan(
        case, shapely.Point(0.0, 0.0).buffer(brief.error), place_ahead(brief, hand), brief.targets.approaches_max
    )


def _of_regions(brief: DesignBrief, hand: Hand) -> Tolerance:
    low, high = brief.held
    common = None
    for radius in np.linspace(low, high, RADII if low < high else 1):
        case = case_of(brief, hand, Disk(radius=float(radius)), brief.least_friction.friction)
        inner = disk_sides(case, FLATTENING * hand.finger_length)[0]
        common = inner if common is None else areal(common & inner)
        if common.is_empty:
            return Tolerance(0.0, None)
    assert common is not None
    circle = inscribed_circle(common, 1e-4 * hand.finger_length)
    return Tolerance(circle.radius, circle.centre)


def _of_starts(brief: DesignBrief, hand: Hand) -> Tolerance:
    """By simulated starts: right half only for disks, which a symmetric hand catches from mirrored places alike."""
    asked = _Caught(brief, hand)
    step = brief.error / CELLS
    side = ROOM * brief.error
    x = np.arange(-side, side + step, step) if asked.turned else np.arange(0.0, side + step, step)
    y = np.arange(asked.lowest, asked.lowest + 2.0 * side + step, step)
    grid = np.stack(np.meshgrid(x, y), axis=-1)
    caught = asked.caught(grid.reshape(-1, 2)).reshape(grid.shape[:2])
    whole = caught if asked.turned else np.concatenate([caught[:, :0:-1], caught], axis=1)
    far = distance_transform_edt(np.pad(whole, 1))[1:-1, 1:-1]
    axis = far[:, far.shape[1] // 2]
    row = int(axis.argmax())
    if axis[row] == 0.0:
        return Tolerance(0.0, None)
    place = (0.0, float(y[row]))
    return Tolerance(asked.circle(place, float(axis[row]) * step), place)


class _Caught:
    """Asks the batch kernels which places are caught under all circumstances of a brief."""

    def __init__(self, brief: DesignBrief, hand: Hand) -> None:
        targets, friction = brief.targets, brief.least_friction.friction
        self.turned = targets.vertices is not None
        if targets.vertices is not None:
            grown = 1.0 + brief.limits.margin
            corners = tuple((grown * x, grown * y) for x, y in targets.vertices)
            things: list[Disk | ConvexPolygon] = [ConvexPolygon(shape="polygon", vertices=corners)]
        else:
            low, high = brief.held
            things = [Disk(radius=float(each)) for each in np.linspace(low, high, RADII if low < high else 1)]
        low, high = targets.restitution
        es = np.linspace(low, high, RESTITUTIONS if low < high else 1) if targets.support is SupportKind.FREE else [1.0]
        self._cases = [case_of(brief, hand, thing, friction, float(e)) for thing, e in product(things, es)]
        self._turns = np.linspace(0.0, 2.0 * np.pi, ORIENTATIONS, endpoint=False) if self.turned else np.zeros(1)
        self.lowest = max(map(object_reach, things)) + hand.half_thickness + 1e-9

    def caught(self, places: Floats) -> NDArray[np.bool_]:
        """Which of the places (N, 2), m, are caught whatever the circumstances."""
        held = np.ones(len(places), np.bool_)
        for case, turn in product(self._cases, self._turns):
            left = np.flatnonzero(held)
            if len(left) == 0:
                break
            starts = np.column_stack([places[left], np.full(len(left), turn)])
            held[left] = simulate_starts(case, starts).codes <= Outcome.CAGED.code
        return held

    def circle(self, place: Place, known: float) -> float:
        """How far (m) from a place starts are caught in every direction looked in; about ``known`` is."""
        angles = np.linspace(0.0, 2.0 * np.pi, RAYS, endpoint=False)
        along = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        low, high = np.zeros(RAYS), np.full(RAYS, 1.2 * known)
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            held = self.caught(np.array(place) + middle[:, None] * along)
            low, high = np.where(held, middle, low), np.where(held, high, middle)
        return float(low.min())
