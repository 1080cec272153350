"""From a case with a free disk to the source's capture region by three impacts, with what it leaves out."""

from __future__ import annotations

from palmar.errors import NotCoveredError
from palmar.geometry.planar_set import EMPTY
from palmar.mechanics.closure.disk_2_2 import structural_radii
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.objects import Disk
from palmar.models.support import SupportKind
from palmar.regions.build import FLATTENING, hand_left_out
from palmar.regions.published_3_3_1 import PublishedSets
from palmar.regions.region import Model, Region
from palmar.regions.three_impacts_4_2_1 import SOUND, three_impact_sets

WITHOUT_EFFECT = (("contact", "friction"), ("contact", "restitution"), ("object", "mass"), ("support", "friction"))
"""Ranges that leave the constructions alone: they take frictionless, elastic contacts and fingers that nothing slows."""


def free_region(case: Case, model: Model) -> Region:
    """The region of a disk at rest in free space (section 4.2.1), by the model ``published`` or ``corrected``.

    Raises NotCoveredError for objects on a table or other than disks, and for numbers given as ranges.
    """
    radius = _covered_radius(case, model)
    hand = case.hand
    held = bool(structural_radii(hand.half_palm, hand.finger_length).holds(radius))
    sets = PublishedSets(EMPTY, EMPTY, EMPTY, 0.0)
    if held:
        tolerance, published = FLATTENING * hand.finger_length, model is Model.PUBLISHED
        sets = three_impact_sets(hand.half_palm, hand.finger_length, radius, hand.open, tolerance, published=published)
    reason = None if held else "no structural hold of this disk, so no start is caught"
    if held and sets.centre.is_empty:
        reason = "the construction leaves no start in front of this hand's open fingers"
    return Region(
        model=model,
        closure=Closure.STRUCTURAL,
        guarantee=Guarantee.CONSTRUCTION,
        centre=sets.centre,
        contact=sets.contact,
        whole=sets.whole,
        flattening=sets.flattening,
        reason=reason,
        notes=_notes(case, radius, model),
    )


def _covered_radius(case: Case, model: Model) -> float:
    name = model.value
    if case.support.kind is not SupportKind.FREE:
        raise NotCoveredError(
            f'support.kind = "table": the {name} region is for free objects, the exact one for tables'
        )
    if not isinstance(case.object, Disk):
        raise NotCoveredError(f'object.shape = "polygon": the {name} region is for disks')
    places = [".".join(map(str, each.place)) for each in case.ranges if each.place not in WITHOUT_EFFECT]
    if places:
        raise NotCoveredError(f"{', '.join(places)}: the {name} region takes plain numbers, not ranges")
    return case.object.radius


def _notes(case: Case, radius: float, model: Model) -> tuple[str, ...]:
    """The erratum, the reach of the soundness found, and what the construction does not take into account."""
    notes = []
    if model is Model.PUBLISHED:
        notes.append(
            "equation 4.9 is used as printed, with the wrong sign at the second impact; corrected has the right one"
        )
    elif radius > SOUND * case.hand.half_palm:
        notes.append(
            "this disk nearly fills the hand: of promised starts some are lost where impacts are nearly elastic"
        )
    if case.contact.restitution < 1.0 or any(each.place == ("contact", "restitution") for each in case.ranges):
        notes.append("restitution is taken as 1, by area the worst")
    if case.contact.friction > 0.0:
        notes.append("contacts are taken as frictionless")
    if case.hand.finger_mass is not None:
        notes.append("the fingers' mass is ignored, nothing slows them")
    if case.start.velocity != (0.0, 0.0):
        notes.append("the disk is taken to be at rest")
    return (*notes, *hand_left_out(case.hand))
