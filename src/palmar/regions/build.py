"""From a case to its region by a given model, and the published model with what it leaves out."""

from __future__ import annotations

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import EMPTY
from palmar.mechanics.closure.disk_2_2 import frictional_radii, structural_radii
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Fingers, Hand
from palmar.models.jointed_motion import JOINTED_CLOSING
from palmar.models.objects import Disk
from palmar.models.support import SupportKind
from palmar.regions.published_3_3_1 import PublishedSets, published_sets
from palmar.regions.region import Model, Region

FLATTENING = 1e-5
"""Default flattening error of curves, as a share of the finger's length."""


def build_region(
    case: Case,
    model: Model = Model.EXACT,
    closure: Closure = Closure.FRICTIONAL,
    orientations: tuple[float, float] | None = None,
    tolerance: float | None = None,
) -> Region:
    """The region of the case's motion; raises NotCoveredError where the model does not cover the case.

    ``orientations``: first and last (rad) at which a polygon is to be caught, else that of the case's start.
    ``tolerance`` (m): how far curves of the exact region may be flattened, or simulated starts be apart.
    """
    walled = case.support.wall is not None
    touches_down = case.behaviour.name is BehaviourName.TOUCH_DOWN and case.support.kind is SupportKind.FREE
    if (case.behaviour.name in JOINTED_CLOSING or touches_down) and model is Model.EXACT:
        return _jointed_region(_turned(case, orientations), closure, tolerance)
    if case.behaviour.name is not BehaviourName.CLOSE or walled:
        if model is not Model.EXACT:
            what = "support.wall_mm" if walled else f'behaviour.name = "{case.behaviour.name.value}"'
            raise NotCoveredError(f"{what}: only the exact model has its region")
        from palmar.regions.arm_moves import arm_region

        return arm_region(_turned(case, orientations), closure, tolerance)
    if model is Model.PUBLISHED and case.support.kind is SupportKind.TABLE:
        return published_region(case, closure)
    if model is not Model.EXACT:
        from palmar.regions.free import free_region

        return free_region(case, model)
    if case.support.kind is SupportKind.FREE:
        from palmar.regions.captured import captured_region

        return captured_region(case, closure, tolerance)
    from palmar.regions.exact import exact_region

    return exact_region(case, closure, tolerance, orientations, tolerance)


def takes_milliseconds(case: Case, model: Model, closure: Closure) -> bool:
    """Whether ``build_region`` evaluates closed forms, a construction on a table, or nothing as it covers nothing."""
    if case.support.kind is SupportKind.FREE:
        return False
    if model is not Model.EXACT:
        return True
    if case.behaviour.name is not BehaviourName.CLOSE or case.support.wall is not None:
        return False
    from palmar.regions.exact import in_closed_form

    return in_closed_form(case, closure)


def _jointed_region(case: Case, closure: Closure, tolerance: float | None) -> Region:
    if case.support.kind is SupportKind.FREE:
        from palmar.regions.captured import captured_region

        return captured_region(case, closure, tolerance)
    from palmar.regions.jointed_closing import jointed_region

    return jointed_region(case, closure, tolerance)


def _turned(case: Case, orientations: tuple[float, float] | None) -> Case:
    """The case with the one orientation asked about."""
    if orientations is None:
        return case
    if orientations[0] != orientations[1]:
        raise NotCoveredError(
            "--theta: regions of moving arms, of jointed fingers and before a wall are for one orientation"
        )
    return case.model_copy(update={"start": case.start.model_copy(update={"theta": orientations[0]})})


def published_region(case: Case, closure: Closure = Closure.FRICTIONAL) -> Region:
    """The source's region for the closing motion on a table (section 3.3.1).

    Raises NotCoveredError for objects other than disks, for free objects, and for numbers given as ranges.
    """
    radius = _covered_radius(case)
    hand = case.hand
    alpha = case.contact.friction_angle if closure is Closure.FRICTIONAL else 0.0
    held = _held(case, radius, alpha)
    tolerance = FLATTENING * hand.finger_length
    sets = PublishedSets(EMPTY, EMPTY, EMPTY, 0.0)
    if held:
        sets = published_sets(hand.half_palm, hand.finger_length, radius, alpha, hand.open, tolerance)
    reason = None if held else f"no {closure.value} hold of this disk, so no start is caught"
    if held and sets.centre.is_empty:
        reason = "the construction leaves no start in front of this hand's open fingers"
    return Region(
        model=Model.PUBLISHED,
        closure=closure,
        guarantee=Guarantee.CONSTRUCTION,
        centre=sets.centre,
        contact=sets.contact,
        whole=sets.whole,
        flattening=sets.flattening,
        reason=reason,
        notes=_left_out(case, alpha),
    )


def _covered_radius(case: Case) -> float:
    if not isinstance(case.object, Disk):
        raise NotCoveredError('object.shape = "polygon": the published region is for disks')
    if case.support.kind is not SupportKind.TABLE:
        raise NotCoveredError('support.kind = "free": the published region is for objects on a table')
    if case.ranges:
        places = ", ".join(".".join(map(str, each.place)) for each in case.ranges)
        raise NotCoveredError(f"{places}: the published region takes plain numbers, not ranges")
    return case.object.radius


def _held(case: Case, radius: float, alpha: float) -> bool:
    """Whether line fingers, kept straight, hold the disk: what the construction presumes."""
    hand = case.hand
    if alpha > 0.0:
        return bool(frictional_radii(hand.half_palm, hand.finger_length, alpha).holds(radius))
    return bool(structural_radii(hand.half_palm, hand.finger_length).holds(radius))


def _left_out(case: Case, alpha: float) -> tuple[str, ...]:
    """What the construction does not take into account, for this case."""
    notes = ["with friction some promised starts are lost; the structural region is sound"] if alpha > 0.0 else []
    notes += hand_left_out(case.hand)
    if case.support.pressure_centre != (0.0, 0.0):
        notes.append("the offset of the centre of pressure is ignored")
    return tuple(notes)


def hand_left_out(hand: Hand) -> list[str]:
    """What both of the source's constructions ignore of this hand."""
    notes = []
    if len(hand.finger_links) > 1:
        notes.append(f"the {len(hand.finger_links)} links of a finger are kept straight")
    if hand.finger_thickness > 0.0:
        notes.append(f"finger thickness {1e3 * hand.finger_thickness:g} mm is ignored, fingers are lines")
    if hand.fingers is Fingers.COLLIDING:
        notes.append("fingers are taken to pass each other")
    if hand.joint_limits is not None:
        notes.append("joint limits are ignored")
    return notes
