"""Regions before a wall: starts drawn inside, the ends of the row along it, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from shapely import Point

from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import slider_body
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.guarantee import Guarantee
from palmar.models.shipped import open_case
from palmar.regions.arm_moves import arm_motion
from palmar.regions.build import build_region
from palmar.regions.moving import caught
from palmar.regions.on_the_wall import resting_height, resting_spans
from palmar.regions.region import Model
from palmar.studies.plan import plan
from palmar.studies.plan_trial import drawn_starts

CASE = open_case("disk_on_a_wall")[1]
HAND = "[hand]\npalm_width_mm = 120\nopen_deg = 60\nfinger_links_mm = [137, 107]\n"
BOX = HAND + (
    '[object]\nshape = "polygon"\nvertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\n'
    "[contact]\nfriction = 0.3\n[support]\nwall_mm = 260\n"
)


def doing(case: Case, name: BehaviourName, **parameters: float) -> Case:
    behaviour = case.behaviour.model_copy(update={"name": name, **parameters})
    return case.model_copy(update={"behaviour": behaviour})


def is_caught(case: Case, starts: np.ndarray) -> np.ndarray:
    body = slider_body(slider_of(case.object, case.support), case.contact.friction)
    motion = straight_motion(case.hand, case.support.wall)
    return caught(motion, body, np.column_stack([starts, np.zeros(len(starts))]), arm_motion(case))


@pytest.mark.parametrize(
    "case",
    [
        CASE,
        doing(CASE, BehaviourName.CLOSE),
        doing(CASE, BehaviourName.MOVE_AND_GRAB, advance=0.05),
        doing(CASE, BehaviourName.MOVE_AND_GRAB, advance=0.3),
        parse_case(BOX, "box"),
    ],
    ids=["on the move", "standing", "ahead first", "too far ahead", "box"],
)
def test_starts_drawn_in_the_region_are_caught_and_the_row_along_the_wall_ends_where_it_says(case: Case) -> None:
    region = build_region(case)
    assert region.guarantee is Guarantee.SAMPLED
    if not region.centre.is_empty:
        assert is_caught(case, drawn_starts(region.centre, 600, 5)).mean() > 0.998
        assert region.centre.bounds[3] <= resting_height(case) + 1e-12
    assert region.resting == resting_spans(case, arm_motion(case))
    for low, high in region.resting:
        row, height = np.linspace(low, high, 101), resting_height(case)
        assert is_caught(case, np.column_stack([row, np.full(101, height)])).all()
        beyond = np.array([[low - 1e-5, height], [high + 1e-5, height]])
        assert not is_caught(case, beyond).any()


def test_going_too_far_ahead_is_no_different_from_going_far_enough() -> None:
    """The arm is halted where the palm presses the disk on the wall, or where the fingers meet it."""
    spans = [build_region(doing(CASE, BehaviourName.MOVE_AND_GRAB, advance=each)).resting for each in (0.25, 0.3, 0.4)]
    assert spans[0]
    for each in spans[1:]:
        assert np.allclose(each, spans[0], atol=2e-5)


def test_a_box_that_rests_turned_touches_with_a_corner() -> None:
    case = parse_case(BOX + "[start]\ntheta_deg = 30\n", "box")
    corner = 0.03 * np.sin(np.radians(30.0)) + 0.02 * np.cos(np.radians(30.0))
    assert resting_height(case) == pytest.approx(0.26 - corner)


def test_what_knows_no_wall_says_so() -> None:
    standing = doing(CASE, BehaviourName.CLOSE)
    with pytest.raises(NotCoveredError, match="wall_mm: only the exact model"):
        build_region(standing, Model.PUBLISHED)
    with pytest.raises(NotCoveredError, match="wall_mm"):
        plan(standing, Point(0.0, 0.0).buffer(0.01), (0.0, 0.2), 1)
    with pytest.raises(NotCoveredError, match="one orientation"):
        build_region(standing, orientations=(0.0, 1.0))
