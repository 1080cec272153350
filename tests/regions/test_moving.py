"""Regions of closing while the arm moves: limits known in closed form, and starts drawn inside."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import slider_body
from palmar.models.case import Case
from palmar.models.contact import Contact
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.regions.exact import exact_region
from palmar.regions.moving import ArmMotion, caught, moved_first, moving_sets
from palmar.studies.plan_trial import drawn_starts

HAND = Hand(palm_width=0.12, finger_links=(0.244,))
CASE = Case(hand=HAND, object=Disk(radius=0.038))
SPACING = HAND.finger_length / 64.0


def is_caught(case: Case, starts: np.ndarray, arm: ArmMotion) -> np.ndarray:
    body = slider_body(slider_of(case.object, case.support), case.contact.friction)
    return caught(straight_motion(case.hand), body, np.column_stack([starts, np.zeros(len(starts))]), arm)


@pytest.mark.parametrize("friction", [0.0, 0.7])
@pytest.mark.parametrize("distance", [0.03, 0.15])
def test_moving_first_shifts_the_closing_region_and_fills_it_below(friction: float, distance: float) -> None:
    """A flat open hand pushes straight: starts a little inside the closed form are caught, a little outside not."""
    case = CASE.model_copy(update={"contact": Contact(friction=friction)})
    region = moved_first(exact_region(case).centre, 0.038, distance)
    outside = shapely.difference(shapely.box(-0.35, 0.0381, 0.35, 0.6), region.buffer(1e-4))
    assert is_caught(case, drawn_starts(region.buffer(-1e-4), 1500, 1), ArmMotion(first=distance)).all()
    assert not is_caught(case, drawn_starts(outside, 1500, 2), ArmMotion(first=distance)).any()


def test_without_a_motion_it_is_the_closing_region() -> None:
    exact = exact_region(CASE).centre
    sampled = moving_sets(CASE, ArmMotion(), SPACING).centre
    assert exact.buffer(1e-6).covers(sampled)
    assert sampled.buffer(2.0 * SPACING).covers(exact)


@pytest.mark.parametrize("arm", [ArmMotion(per_radian=0.05), ArmMotion(0.05, 0.1), ArmMotion(0.02, 0.3)])
def test_starts_drawn_in_the_region_are_caught(arm: ArmMotion) -> None:
    region = moving_sets(CASE, arm, SPACING)
    assert is_caught(CASE, drawn_starts(region.centre, 4000, 3), arm).all()
    assert region.centre.area > exact_region(CASE).area
