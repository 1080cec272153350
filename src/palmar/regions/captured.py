"""The true pre-image of a hand that closes on a free disk: every start is carried by the capture kernel.

A start counts as caught if it is at every restitution asked about: the case's, or several of its range, ends included. The
outline is traced on a grid and bisected (``boundary_search``, ``outline``); what happens between neighbouring starts is
not bounded: ``sampled``. A disk that starts with a velocity has a region for that velocity.
"""

from __future__ import annotations

from math import ceil, hypot, inf, log2

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, affinity

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import EMPTY, areal, grown, outline, with_mirror_image
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of, impact_law_of
from palmar.mechanics.impact.finger_motion import CaptureHand
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.jointed_motion import JOINTED_CLOSING
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.regions.boundary_search import Box, Nodes, nodes_inside
from palmar.regions.inset import bulged, refined
from palmar.regions.outline import outlined
from palmar.regions.region import Model, Region

Floats = NDArray[np.float64]
RESTITUTION = ("contact", "restitution")
SPACING, FINEST = 1.0 / 128.0, 1.0 / 4096.0
"""Default and least spacing of starts at the boundary, in finger lengths."""
RESTITUTIONS = 9
"""Of a range, evenly spaced."""
BETWEEN = 21
"""Values, besides the ends of a range, at which each place of the returned boundary is asked about."""
MARGIN = 1.0 / 32.0
"""What is returned lies inside the outline by this part of the spacing; a curve half-way is asked about."""
DEEPEST = 2.0
"""How far inwards, in spacings, one goes at once from a place of that boundary that is lost."""
BULGES, BULGE = 4, 1.0 / 8.0
"""How often corners that chords cut off are put back, and by which part of the margin they stick out at least."""
CELLS, FEWEST_CELLS = 96, 32
"""Of the coarse grid, all of whose nodes are asked about, across."""
MOST_EVENTS = 2_000
"""Of one start, after which it counts as lost: what rattles so long in the throat is next to the outline."""
MOST_SLOWED = 20_000
"""The same before fingers whose motors have a limit: there hops stand for sustained contact."""
TURN = 0.5 * (5.0**0.5 - 1.0)
"""The golden section: its multiples, without whole numbers, fill the unit interval evenly."""


def captured_region(case: Case, closure: Closure, tolerance: float | None) -> Region:
    """The region of a case with a free disk; ``tolerance`` (m): spacing of the starts at its boundary.

    ``closure`` STRUCTURAL takes the contacts as frictionless. Raises NotCoveredError for tables, polygons, and ranges of
    anything but the restitution.
    """
    if closure is Closure.STRUCTURAL:
        case = case.model_copy(update={"contact": case.contact.model_copy(update={"friction": 0.0})})
    asked = Captured(case)
    hand, length = asked.hand, case.hand.finger_length
    wanted = max(tolerance or SPACING * length, FINEST * length)
    box = _box(case, hand, wanted)
    nodes = nodes_inside(asked.caught, box, max(0, ceil(log2(box.width / box.cells / wanted))))
    margin = MARGIN * nodes.step
    found, lost = _looked_at(_traced(asked, nodes, box), asked, margin, DEEPEST * nodes.step)
    if box.mirrored:
        found, lost = with_mirror_image(found), np.concatenate([lost, lost * [-1.0, 1.0]])
    centre = areal(_inner(found, case, margin).difference(shapely.MultiPoint(lost).buffer(2.0 * margin)))
    whole, flattening = (EMPTY, 0.0) if centre.is_empty else grown(centre, hand.radius, 1e-3 * hand.radius)
    es = asked.restitutions
    between = f"{len(es)} values from {es[0]:g} to {es[-1]:g}" if len(es) > 1 else f"{es[0]:g}"
    return Region(
        model=Model.EXACT,
        closure=closure,
        guarantee=Guarantee.SAMPLED,
        centre=centre,
        contact=_contact(centre, case, hand),
        whole=whole,
        flattening=flattening,
        reason="no start on the grid is caught" if centre.is_empty else None,
        notes=(
            f"{asked.starts} simulated starts, {1e3 * nodes.step:.3g} mm apart, restitution {between}",
            *_notes(case),
        ),
        outer=areal(found.buffer(margin)),
        spacing=nodes.step,
    )


def captured_count(case: Case, spacing: float) -> float:
    """About the area (m2) of the region, by the number of starts on a grid of that ``spacing`` (m) that are caught."""
    asked = Captured(case)
    nodes = nodes_inside(asked.caught, _box(case, asked.hand, spacing), 0)
    return float(nodes.held.sum()) * nodes.step**2


def _traced(asked: Captured, nodes: Nodes, box: Box) -> MultiPolygon:
    """The outline of the nodes; of a set that is its own mirror image the half right of the axis."""
    if not box.mirrored:
        return outlined(asked.caught, nodes, (-0.5 * box.width, 0.0))
    right = Nodes(nodes.held[:, nodes.held.shape[1] // 2 :], nodes.step)
    return outlined(asked.caught, right, (0.0, 0.0))


def _looked_at(found: MultiPolygon, asked: Captured, margin: float, deepest: float) -> tuple[MultiPolygon, Floats]:
    """The set with the corners that its inset needs; places (M, 2) of the inset that are lost nevertheless."""
    whole, lost = EMPTY, [np.empty((0, 2))]
    for polygon in found.geoms:
        right = shapely.geometry.polygon.orient(polygon)
        for each in (right.exterior, *right.interiors):
            ring = shapely.get_coordinates(each)[:-1]
            on_axis = (ring[:, 0] == 0.0) & (np.roll(ring[:, 0], -1) == 0.0)
            for _ in range(BULGES):
                ring, on_axis = bulged(ring, on_axis, asked.caught_between, BULGE * margin)
            line, left = refined(ring, on_axis, asked.caught_between, margin, deepest)
            whole = areal(whole ^ outline(line))
            lost.append(left)
    return whole, np.concatenate(lost)


def _inner(found: MultiPolygon, case: Case, margin: float) -> MultiPolygon:
    """The set without a margin (m) along its outline, but for where it ends because a disk lies on the flat open hand."""
    if found.is_empty:
        return EMPTY
    flat = case.hand.open == 0.0 and case.hand.half_thickness == 0.0
    left, low, right, _ = found.bounds
    strip = found.intersection(shapely.box(left, low, right, low + 0.25 * margin))
    below = shapely.union(strip, affinity.translate(strip, 0.0, -2.0 * margin))
    wide = shapely.union(found, below.convex_hull) if flat else found
    return areal(wide.buffer(-margin).intersection(found))


class Captured:
    """Asks whether starts of a case are caught at all its restitutions, and counts them."""

    def __init__(self, case: Case) -> None:
        self.restitutions = restitutions_of(case)
        self.hand, self._law, self._velocity = capture_hand_of(case), impact_law_of(case), case.start.velocity
        self._events = MOST_EVENTS if self._law.torque == inf else MOST_SLOWED
        self.starts = 0

    def caught(self, x: Floats, y: Floats) -> NDArray[np.bool_]:
        """Which starts (N,), (N,), m, are caught; the largest restitution is asked about first."""
        held = np.ones(len(x), bool)
        for e in self.restitutions[::-1]:
            held = self._held(x, y, np.full(len(x), e), held)
        return held

    def caught_between(self, x: Floats, y: Floats, numbers: NDArray[np.int64]) -> NDArray[np.bool_]:
        """``caught``, of a range at its ends and, for each place by its number, at other values in between."""
        low, high = self.restitutions[0], self.restitutions[-1]
        held = self._held(x, y, np.full(len(x), high))
        if low < high:
            shift = numbers * TURN % 1.0
            for k in range(BETWEEN):
                held &= self._held(x, y, high - (high - low) * (k + shift) / BETWEEN, held)
            held &= self._held(x, y, np.full(len(x), low), held)
        return held

    def _held(self, x: Floats, y: Floats, es: Floats, those: NDArray[np.bool_] | None = None) -> NDArray[np.bool_]:
        """Which of ``those`` starts, else of all, are caught at restitutions ``es`` (N,)."""
        held = np.ones(len(x), bool) if those is None else those.copy()
        some = np.flatnonzero(held)
        places = np.column_stack([x[some], y[some]])
        ends = capture_all(self.hand, places, self._velocity, es[some], law=self._law, most_events=self._events)
        held[some] = ends.codes <= Outcome.CAGED.code
        self.starts += len(some)
        return held


def restitutions_of(case: Case) -> Floats:
    """The restitutions (K,) that stand for a case's, rising; raises NotCoveredError for ranges of anything else."""
    others = [".".join(map(str, each.place)) for each in case.ranges if each.place != RESTITUTION]
    if others:
        raise NotCoveredError(f"{', '.join(others)}: for a free disk only the restitution may have a range")
    ends = [(each.low, each.high) for each in case.ranges]
    return np.linspace(*ends[0], RESTITUTIONS) if ends else np.array([case.contact.restitution])


def _box(case: Case, hand: CaptureHand, spacing: float) -> Box:
    """All starts that can touch the hand before it is closed; fewer cells only where a coarser spacing is asked for."""
    vx, vy = case.start.velocity
    time = float(hand.times[-1])
    width = 2.0 * (hand.reach + abs(vx) * time)
    height = hand.reach - hand.half_palm + max(-vy, 0.0) * time
    cells = min(CELLS, max(FEWEST_CELLS, 2 * ceil(0.5 * width / spacing)))
    alike = bool((hand.angles[:, 0] == hand.angles[:, 1]).all())
    return Box(width, height, cells, vx == 0.0 and alike)


def _contact(centre: MultiPolygon, case: Case, hand: CaptureHand) -> MultiPolygon:
    """Where the right finger, and its image, first touch a disk at rest: r^2 = |c - base|^2 - (R + h)^2, in their frame.

    For straight fingers that turn alike; empty else.
    """
    if centre.is_empty or case.start.velocity != (0.0, 0.0) or case.behaviour.name is not BehaviourName.CLOSE:
        return EMPTY
    apart = hand.radius + hand.half_thickness
    left, low, right, high = centre.bounds
    half = areal(centre.intersection(shapely.box(0.0, low, right, high)))

    def touched(points: Floats) -> Floats:
        away = points - [hand.half_palm, 0.0]
        square = np.maximum((away**2).sum(axis=1) - apart**2, 0.0)
        r = np.minimum(np.sqrt(square), hand.lengths.sum())
        angle = np.arctan2(away[:, 1], away[:, 0]) - np.arctan2(apart, np.sqrt(square))
        return np.column_stack([hand.half_palm + r * np.cos(angle), r * np.sin(angle)])

    seen = areal(
        shapely.transform(shapely.segmentize(half, 0.02 * hypot(right - left, high - low)), touched).buffer(0.0)
    )
    return areal(seen | affinity.scale(seen, xfact=-1.0, origin=(0.0, 0.0)))


def _notes(case: Case) -> tuple[str, ...]:
    notes = []
    if len(case.hand.finger_links) > 1 and case.behaviour.name not in JOINTED_CLOSING:
        notes.append(f"the {len(case.hand.finger_links)} links of a finger are kept straight")
    if case.start.velocity != (0.0, 0.0):
        vx, vy = (1e3 * each for each in case.start.velocity)
        notes.append(f"the disk starts with ({vx:.4g}, {vy:.4g}) mm/s")
    if case.hand.finger_mass is not None:
        torque = case.hand.finger_torque
        back = "restore their rate at once" if torque is None else f"bring them back to their rate with {torque:g} N m"
        notes.append(f"fingers of that mass give way in an impact, and their motors {back}")
    if isinstance(case.object, Disk) and case.contact.friction > 0.0:
        notes.append("contacts with friction spin the disk")
    return tuple(notes)
