"""Regions of cases whose behaviour moves the arm: which method covers what, and what is caught."""

from __future__ import annotations

import numpy as np
import pytest

from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import slider_body
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.contact import Contact
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.regions.arm_moves import arm_motion
from palmar.regions.build import build_region
from palmar.regions.moving import caught
from palmar.regions.region import Model
from palmar.studies.plan_trial import drawn_starts

GRAB = Behaviour(name=BehaviourName.MOVE_AND_GRAB, advance=0.1)
SCOOPING = Behaviour(name=BehaviourName.MOVE_WHILE_CLOSING, advance=0.4, speed=0.05)


def case_of(behaviour: Behaviour, friction: float = 0.7, thickness: float = 0.0) -> Case:
    hand = Hand(palm_width=0.12, finger_links=(0.244,), finger_thickness=thickness)
    return Case(hand=hand, object=Disk(radius=0.038), contact=Contact(friction=friction), behaviour=behaviour)


@pytest.mark.parametrize(
    ("case", "guarantee"),
    [
        (case_of(GRAB), Guarantee.CLOSED_FORM),
        (case_of(GRAB, thickness=0.02), Guarantee.SAMPLED),
        (case_of(SCOOPING), Guarantee.SAMPLED),
        (case_of(SCOOPING, friction=0.0), Guarantee.CERTIFIED),
        (case_of(SCOOPING.model_copy(update={"first": 0.05}), friction=0.0), Guarantee.SAMPLED),
    ],
)
def test_each_motion_has_the_best_region_there_is(case: Case, guarantee: Guarantee) -> None:
    region = build_region(case)
    assert region.guarantee is guarantee
    inside = drawn_starts(region.centre.buffer(-1e-6), 1500, 1)
    body = slider_body(slider_of(case.object, case.support), case.contact.friction)
    poses = np.column_stack([inside, np.zeros(len(inside))])
    assert caught(straight_motion(case.hand), body, poses, arm_motion(case)).all()
    still = build_region(case.model_copy(update={"behaviour": Behaviour()}))
    assert region.area > 1.2 * still.area


def test_structural_closure_is_friction_none() -> None:
    one = build_region(case_of(SCOOPING), closure=Closure.STRUCTURAL)
    assert one.guarantee is Guarantee.CERTIFIED
    assert one.band < 0.011 * one.area


@pytest.mark.parametrize(
    ("behaviour", "said"),
    [
        (Behaviour(name=BehaviourName.SCOOP), "palmar behaviours region has"),
        (
            Behaviour(name=BehaviourName.MOVE_WHILE_CLOSING, advance=0.01),
            "until the fingers end: advance_mm of at least",
        ),
        (Behaviour(name=BehaviourName.MOVE_AND_GRAB, direction=0.3), "straight ahead"),
    ],
)
def test_other_motions_are_refused(behaviour: Behaviour, said: str) -> None:
    with pytest.raises(NotCoveredError, match=said):
        build_region(case_of(behaviour))


def test_the_published_construction_knows_no_arm() -> None:
    with pytest.raises(NotCoveredError, match="only the exact model"):
        build_region(case_of(GRAB), Model.PUBLISHED)
