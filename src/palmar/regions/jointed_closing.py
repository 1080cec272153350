"""Pre-images on the table of closing with both joints of each finger: curl and close, or both at a ratio of rates.

The motion is a row of stretches, each carried by the stepping kernel from where the last one left the object. A start at
which a finger is held up before the last stretch is not followed any further and does not count as caught; how many there
were is told. Guarantee: ``sampled``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil, log2

import numpy as np
from numpy.typing import NDArray

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import EMPTY, areal, grown
from palmar.mechanics.pushing.closing_steps import BATCH_TOLERANCE, carry_all
from palmar.mechanics.pushing.hand_pose import HandMotion, free_motion, hand_motion
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import moved_poses, slider_body
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Fingers, Hand
from palmar.models.jointed_motion import coupled_limit, curl_of
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.regions.boundary_search import Box, nodes_inside
from palmar.regions.closing_sampled import COARSE
from palmar.regions.outline import outlined
from palmar.regions.region import Model, Region
from palmar.regions.simulated import covered_from

Floats = NDArray[np.float64]
SPACING, FINEST = 1.0 / 64.0, 1.0 / 4096.0
"""Default and least spacing of starts, in finger lengths."""
MARGIN = 1.0 / 8.0
"""What is returned lies inside the outline by this part of the spacing."""
ENDED = 1e-9


def jointed_region(case: Case, closure: Closure, tolerance: float | None) -> Region:
    """The region of CURL_AND_CLOSE or CLOSE_COUPLED on a table; ``tolerance`` (m): spacing of the starts at its boundary.

    Raises NotCoveredError for hands without two links a finger, ranges, and a curl beyond the distal joint's limit.
    """
    if closure is Closure.STRUCTURAL:
        case = case.model_copy(update={"contact": case.contact.model_copy(update={"friction": 0.0})})
    asked = Carried(case)
    length, size = case.hand.finger_length, asked.size
    wanted = max(tolerance or SPACING * length, FINEST * length)
    box = _box(case, size, COARSE)
    nodes = nodes_inside(asked.caught, box, max(0, ceil(log2(box.width / COARSE / wanted))))
    found = outlined(asked.caught, nodes, (-0.5 * box.width, 0.0))
    centre = areal(found.buffer(-MARGIN * nodes.step))
    if isinstance(case.object, Disk):
        whole, flattening = (EMPTY, 0.0) if centre.is_empty else grown(centre, size, 1e-3 * size)
    else:
        whole, flattening = covered_from(centre, case.object, np.array([case.start.theta]))
    return Region(
        model=Model.EXACT,
        closure=closure,
        guarantee=Guarantee.SAMPLED,
        centre=centre,
        contact=EMPTY,
        whole=whole,
        flattening=flattening,
        reason="no start on the grid is caught" if centre.is_empty else None,
        notes=(
            f"{asked.starts} simulated starts, {1e3 * nodes.step:.3g} mm apart at the boundary",
            f"{asked.held_up} of them held a finger up before the last stretch and are not counted as caught",
        ),
        orientations=None if isinstance(case.object, Disk) else (case.start.theta, case.start.theta),
        outer=areal(found.buffer(MARGIN * nodes.step)),
        spacing=nodes.step,
    )


def jointed_count(case: Case, spacing: float) -> float:
    """About the area (m2) of the region, by the number of starts on a grid of that ``spacing`` (m) that are caught."""
    asked = Carried(case)
    box = _box(case, asked.size, COARSE)
    nodes = nodes_inside(asked.caught, replace(box, cells=2 * ceil(0.5 * box.width / spacing)), 0)
    return float(nodes.held.sum()) * nodes.step**2


def _box(case: Case, size: float, cells: int) -> Box:
    """All starts that can touch the hand."""
    hand = case.hand
    width, height = 2.0 * (hand.half_palm + hand.finger_length + size), hand.finger_length + 2.0 * size
    return Box(width, height, cells, isinstance(case.object, Disk) and case.support.pressure_centre == (0.0, 0.0))


@dataclass
class Carried:
    """Carries starts of a case through its stretches, and counts them, and those that held a finger up too soon."""

    case: Case
    starts: int = 0
    held_up: int = 0

    def __post_init__(self) -> None:
        self._stretches = stretches_of(self.case)
        self._slider = slider_of(self.case.object, self.case.support)
        self._body = slider_body(self._slider, self.case.contact.friction)

    @property
    def size(self) -> float:
        """Distance (m) of the object's farthest point from its frame's origin."""
        return float(self._body.reach + np.hypot(*self._slider.centre))

    def caught(self, x: Floats, y: Floats) -> NDArray[np.bool_]:
        """Which positions (N,), (N,), m, of the object's frame are caught, at the orientation of the case's start."""
        return self.outcomes(np.column_stack([x, y, np.full(len(x), self.case.start.theta)])) <= Outcome.CAGED.code

    def outcomes(self, poses: Floats) -> NDArray[np.int8]:
        """Outcome codes of poses (N, 3) of the object's frame; UNDECIDED where a finger was held up too soon."""
        places = moved_poses(self._slider.centre, poses, 1.0)
        found = np.full(len(places), Outcome.UNDECIDED.code, np.int8)
        going = np.arange(len(places))
        self.starts += len(places)
        for k, stretch in enumerate(self._stretches):
            codes, ends, _ = carry_all(stretch, self._body, places[going], tolerance=BATCH_TOLERANCE)
            if k == len(self._stretches) - 1:
                found[going] = codes
                return found
            invalid = codes == Outcome.INVALID.code
            free = (ends[:, 3:5] >= stretch.last - ENDED).all(axis=1) & ~invalid & (codes != Outcome.UNDECIDED.code)
            found[going[invalid]] = Outcome.INVALID.code
            self.held_up += int((~free & ~invalid).sum())
            places[going] = ends[:, :3]
            going = going[free]
        return found


def stretches_of(case: Case) -> list[HandMotion]:
    """The motions, one after the other, that a case's behaviour makes."""
    hand, does = case.hand, case.behaviour
    if case.ranges or case.support.wall is not None:
        where = f'behaviour.name = "{does.name.value}"'
        raise NotCoveredError(f"{where}: its region is for plain numbers, not ranges, and for a table without a wall")
    if does.name is BehaviourName.CURL_AND_CLOSE:
        bend = curl_of(case)
        closing = _closing(hand, hand.open, bend, 0.0, hand.base_limits[1])
        return [_curl(hand, bend), closing] if bend > 0.0 else [closing]
    return [_closing(hand, hand.open, does.bend, does.ratio, coupled_limit(case))]


def _curl(hand: Hand, angle: float) -> HandMotion:
    angles, rates = np.array([[hand.open, 0.0]] * 2), np.array([[0.0, angle]] * 2)
    links = np.array(hand.finger_links)
    return free_motion(
        hand.half_palm, links, hand.half_thickness, angles, rates, (0.0, 0.0), 1.0, hand.fingers is Fingers.COLLIDING
    )


def _closing(hand: Hand, first: float, bend: float, ratio: float, limit: float) -> HandMotion:
    return hand_motion(
        hand.half_palm, hand.finger_links, hand.half_thickness, first=first, limit=limit,
        offsets=[bend], ratios=[ratio], colliding=hand.fingers is Fingers.COLLIDING,
    )  # fmt: skip
