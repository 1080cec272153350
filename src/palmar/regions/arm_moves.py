"""The region of a case whose behaviour moves the arm, or with a wall ahead of it (section 3.3.3).

- Move and grab with flat open line fingers before a disk: closed form, the closing region moved and drawn out.
- A disk without friction, and an arm that moves while the fingers close, without a first stretch: certified.
- Everything else: sampled.

The arm goes at its speed, the fingers at their rate; on the table only the ratio counts. An arm that moves while the
fingers close is taken to move until they end, as the source's does (section 7.3.2).
"""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import EMPTY, grown
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.objects import Disk
from palmar.models.support import SupportKind
from palmar.regions.certified import certified_region
from palmar.regions.exact import exact_region
from palmar.regions.moving import ArmMotion, moved_first, moving_sets
from palmar.regions.on_the_wall import resting_spans
from palmar.regions.region import Model, Region
from palmar.regions.simulated import covered_from

SPACING = 1.0 / 64.0
"""Default spacing of simulated starts, in finger lengths."""
AHEAD = 1e-9


def arm_region(case: Case, closure: Closure, tolerance: float | None) -> Region:
    """The region of the case's motion; raises NotCoveredError for other behaviours, ranges and free objects.

    ``tolerance`` (m): how far curves may be flattened, or simulated starts be apart.
    """
    return region_of_motion(case, arm_motion(case), closure, tolerance)


def region_of_motion(case: Case, arm: ArmMotion, closure: Closure, tolerance: float | None) -> Region:
    """The region of ``arm`` whatever the case's behaviour."""
    if closure is Closure.STRUCTURAL:
        case = case.model_copy(update={"contact": case.contact.model_copy(update={"friction": 0.0})})
    if case.support.wall is not None:
        return replace(_sampled(case, closure, arm, tolerance), resting=resting_spans(case, arm))
    if arm.per_radian == 0.0 and _pushes_straight(case):
        return _moved_first(case, closure, arm, tolerance)
    if arm.first == 0.0 and case.contact.friction == 0.0 and _centred_disk(case) is not None:
        return _certified(case, arm, tolerance)
    return _sampled(case, closure, arm, tolerance)


def arm_motion(case: Case) -> ArmMotion:
    """What a case's behaviour does with the arm; raises NotCoveredError where that is not a region's motion."""
    does = case.behaviour
    where = f'behaviour.name = "{does.name.value}"'
    if case.support.kind is not SupportKind.TABLE or case.ranges:
        raise NotCoveredError(f"{where}: regions of arm motions are for objects on a table, and plain numbers")
    if does.name is BehaviourName.CLOSE:
        return ArmMotion()
    if abs(does.direction - 0.5 * pi) > AHEAD:
        raise NotCoveredError(f"{where}: its region is for an arm that goes straight ahead, direction_deg = 90")
    if does.name is BehaviourName.MOVE_AND_GRAB:
        return ArmMotion(first=does.advance)
    if does.name is not BehaviourName.MOVE_WHILE_CLOSING:
        raise NotCoveredError(f"{where}: palmar behaviours region has the regions of behaviours that feel")
    motion = straight_motion(case.hand)
    per_radian = does.speed / case.hand.finger_rate
    needed = does.first + per_radian * (motion.last - motion.first)
    if does.advance < needed * (1.0 - 1e-9):
        raise NotCoveredError(
            f"{where}: its region is for an arm that moves until the fingers end: advance_mm of at least {1e3 * needed:.4g}"
        )
    return ArmMotion(does.first, per_radian)


def _centred_disk(case: Case) -> Disk | None:
    return case.object if isinstance(case.object, Disk) and case.support.pressure_centre == (0.0, 0.0) else None


def _pushes_straight(case: Case) -> bool:
    """Whether the still hand is one flat line before a disk."""
    return case.hand.open == 0.0 and case.hand.finger_thickness == 0.0 and _centred_disk(case) is not None


def _moved_first(case: Case, closure: Closure, arm: ArmMotion, tolerance: float | None) -> Region:
    assert isinstance(case.object, Disk)
    closing, radius = exact_region(case, closure, tolerance), case.object.radius
    centre = moved_first(closing.centre, radius, arm.first)
    outer = None if closing.outer is None else moved_first(closing.outer, radius, arm.first)
    whole, flattening = (EMPTY, 0.0) if centre.is_empty else grown(centre, radius, 1e-3 * radius)
    notes = (*closing.notes, f"the hand goes {1e3 * arm.first:.4g} mm ahead before it closes")
    return replace(
        closing, centre=centre, outer=outer, contact=EMPTY, whole=whole,
        flattening=max(flattening, closing.flattening), notes=notes,
    )  # fmt: skip


def _certified(case: Case, arm: ArmMotion, tolerance: float | None) -> Region:
    assert isinstance(case.object, Disk)
    motion = straight_motion(case.hand)._replace(vy=arm.per_radian)
    found = certified_region(motion, case.object.radius, tolerance)
    return replace(found, notes=(*found.notes, *_on_the_move(arm)))


def _sampled(case: Case, closure: Closure, arm: ArmMotion, tolerance: float | None) -> Region:
    sets = moving_sets(case, arm, tolerance or SPACING * case.hand.finger_length)
    whole, flattening = covered_from(sets.centre, case.object, np.array([case.start.theta]))
    return Region(
        model=Model.EXACT,
        closure=closure,
        guarantee=Guarantee.SAMPLED,
        centre=sets.centre,
        contact=EMPTY,
        whole=whole,
        flattening=flattening,
        reason="no start on the grid is caught" if sets.centre.is_empty else None,
        notes=(
            f"{sets.starts} simulated starts, {1e3 * sets.spacing:.3g} mm apart at the boundary",
            *_before_the_wall(case),
            *_on_the_move(arm),
        ),
        orientations=None if isinstance(case.object, Disk) else (case.start.theta, case.start.theta),
        spacing=sets.spacing,
    )


def _before_the_wall(case: Case) -> tuple[str, ...]:
    if case.support.wall is None:
        return ()
    return (f"a wall {1e3 * case.support.wall:.4g} mm ahead, along which fingers slide while the wrist gives way",)


def _on_the_move(arm: ArmMotion) -> tuple[str, ...]:
    if arm == ArmMotion():
        return ()
    first = f"{1e3 * arm.first:.4g} mm ahead with open fingers, then " if arm.first > 0.0 else ""
    return (f"{first}{1e3 * arm.per_radian:.4g} mm for each radian of the closing fingers",)
