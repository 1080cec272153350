"""The true pre-image of a hand that closes on a free disk: every start is carried by the capture kernel.

A start counts as caught if it is at every restitution asked about: the case's, or several of its range, ends included. The
outline is traced on a grid and bisected (``boundary_search``, ``outline``); what happens between neighbouring starts is
not bounded: ``sampled``. A disk that starts with a velocity has a region for that velocity.
"""

from __future__ import annotations

from math import ceil, hypot, log2

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, affinity

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import EMPTY, areal, grown
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of, impact_law_of
from palmar.mechanics.impact.finger_motion import CaptureHand
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.regions.boundary_search import Box, nodes_inside
from palmar.regions.closing_sampled import COARSE
from palmar.regions.outline import outlined
from palmar.regions.region import Model, Region

Floats = NDArray[np.float64]
RESTITUTION = ("contact", "restitution")
SPACING, FINEST = 1.0 / 128.0, 1.0 / 4096.0
"""Default and least spacing of starts at the boundary, in finger lengths."""
RESTITUTIONS = 9
"""Of a range, evenly spaced."""
MARGIN = 1.0 / 16.0
"""What is returned lies inside the outline by this part of the spacing."""


def captured_region(case: Case, closure: Closure, tolerance: float | None) -> Region:
    """The region of a case with a free disk; ``tolerance`` (m): spacing of the starts at its boundary.

    ``closure`` STRUCTURAL takes the contacts as frictionless. Raises NotCoveredError for tables, polygons, and ranges of
    anything but the restitution.
    """
    if closure is Closure.STRUCTURAL:
        case = case.model_copy(update={"contact": case.contact.model_copy(update={"friction": 0.0})})
    asked = Captured(case)
    hand, length = asked.hand, case.hand.finger_length
    box = _box(case, hand)
    wanted = max(tolerance or SPACING * length, FINEST * length)
    nodes = nodes_inside(asked.caught, box, max(0, ceil(log2(box.width / box.cells / wanted))))
    found = outlined(asked.caught, nodes, (-0.5 * box.width, 0.0))
    centre = _inner(found, case, MARGIN * nodes.step)
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
        outer=areal(found.buffer(MARGIN * nodes.step)),
        spacing=nodes.step,
    )


def _inner(found: MultiPolygon, case: Case, margin: float) -> MultiPolygon:
    """The set without a margin (m) along its outline, but for where it ends because a disk lies on the flat open hand."""
    if found.is_empty:
        return EMPTY
    flat = case.hand.open == 0.0 and case.hand.half_thickness == 0.0
    left, low, right, _ = found.bounds
    below = affinity.translate(
        found.intersection(shapely.box(left, low, right, low + 2.0 * margin)), 0.0, -2.0 * margin
    )
    wide = shapely.union(found, below.convex_hull) if flat else found
    return areal(wide.buffer(-margin).intersection(found))


class Captured:
    """Asks whether starts of a case are caught at all its restitutions, and counts them."""

    def __init__(self, case: Case) -> None:
        self.restitutions = restitutions_of(case)
        self.hand, self._law, self._velocity = capture_hand_of(case), impact_law_of(case), case.start.velocity
        self.starts = 0

    def caught(self, x: Floats, y: Floats) -> NDArray[np.bool_]:
        """Which starts (N,), (N,), m, are caught; the largest restitution is asked about first."""
        held = np.ones(len(x), bool)
        for e in self.restitutions[::-1]:
            some = np.flatnonzero(held)
            ends = capture_all(self.hand, np.column_stack([x[some], y[some]]), self._velocity, float(e), law=self._law)
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


def _box(case: Case, hand: CaptureHand) -> Box:
    """All starts that can touch the hand before it is closed."""
    vx, vy = case.start.velocity
    time = float(hand.times[-1])
    width = 2.0 * (hand.reach + abs(vx) * time)
    height = hand.reach - hand.half_palm + max(-vy, 0.0) * time
    return Box(width, height, COARSE, vx == 0.0)


def _contact(centre: MultiPolygon, case: Case, hand: CaptureHand) -> MultiPolygon:
    """Where the right finger, and its image, first touch a disk at rest: r^2 = |c - base|^2 - (R + h)^2, in their frame."""
    if centre.is_empty or case.start.velocity != (0.0, 0.0):
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
    if len(case.hand.finger_links) > 1:
        notes.append(f"the {len(case.hand.finger_links)} links of a finger are kept straight")
    if case.start.velocity != (0.0, 0.0):
        vx, vy = (1e3 * each for each in case.start.velocity)
        notes.append(f"the disk starts with ({vx:.4g}, {vy:.4g}) mm/s")
    if case.hand.finger_mass is not None:
        notes.append("fingers of that mass give way in an impact, and their motors restore their rate at once")
    if isinstance(case.object, Disk) and case.contact.friction > 0.0:
        notes.append("contacts with friction spin the disk")
    return tuple(notes)
