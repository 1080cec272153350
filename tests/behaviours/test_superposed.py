"""Strips and closings: what is certain is caught, by a trial that knows nothing of sets; and what is refused."""

from __future__ import annotations

from dataclasses import replace

import pytest
import shapely
from shapely import Point, affinity, box

from palmar.behaviours.build import drive_of
from palmar.behaviours.follow_policy import FollowPolicy
from palmar.behaviours.policy import Approach, Close, Policy, approaches, closings, is_guaranteed, leaves
from palmar.behaviours.superposed import closings_only, strips
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.models.sensors import SensorLayout, Sensors
from palmar.studies.plan import planner_of
from palmar.studies.plan_trial import Errors, Trial, drawn_starts, try_plan
from palmar.studies.run_behaviour import run_behaviour
from palmar.worlds.run import Ended

HAND = Hand(palm_width=0.12, finger_links=(0.137, 0.107))
DOUBT = {"displacement": 0.002, "pose_error": 0.001}
ISLANDS = shapely.union_all([Point(x, y).buffer(0.05) for x, y in ((0.0, 0.7), (0.9, 0.7), (-1.3, 1.7), (0.0, 1.7))])


def case_of(layout: SensorLayout, **given: object) -> Case:
    return Case(hand=HAND, object=Disk(radius=0.038), sensors=Sensors(layout=layout, **DOUBT), **given)


def tried(case: Case, policy: Policy, belief: shapely.Geometry, number: int = 6000) -> Trial:
    stretches = case.sensors.stretches(case.hand)
    return try_plan(case, policy, stretches, drawn_starts(belief, number, 3), Errors(**DOUBT), 3)


@pytest.mark.parametrize("layout", [SensorLayout.DISTRIBUTED, SensorLayout.TIPS])
@pytest.mark.parametrize("belief", [box(-1.0, 0.5, 0.8, 1.5), Point(0.1, 1.0).buffer(0.6)], ids=["box", "disk"])
def test_strips_cover_all_of_a_wide_uncertainty(layout: SensorLayout, belief: shapely.Geometry) -> None:
    case = case_of(layout)
    found = strips(planner_of(case)[0], belief, 2)
    assert is_guaranteed(found.policy)
    trial = tried(case, found.policy, belief)
    assert trial.caught == trial.starts
    assert trial.most_approaches <= approaches(found.policy)
    assert 2 <= found.least <= approaches(found.policy)


def test_strips_of_a_hand_that_feels_all_over_are_as_few_as_there_can_be() -> None:
    """Each as wide as the hand; the last, narrower than the region, needs none."""
    found = strips(planner_of(case_of(SensorLayout.FULL))[0], box(-1.0, 0.5, 1.0, 0.9), 1)
    assert found.minimal and approaches(found.policy) == 3


def test_a_palm_between_fingers_that_feel_nothing_sweeps_no_strip() -> None:
    found = strips(planner_of(case_of(SensorLayout.PALM))[0], box(-1.0, 0.5, 1.0, 0.9), 2)
    assert not is_guaranteed(found.policy)


def test_islands_are_closed_on_one_after_the_other() -> None:
    case = case_of(SensorLayout.NONE)
    found = closings_only(planner_of(case)[0], ISLANDS)
    assert is_guaranteed(found.policy)
    assert (approaches(found.policy), closings(found.policy)) == (0, 4)
    trial = tried(case, found.policy, ISLANDS)
    assert trial.caught == trial.starts
    assert all(each > 500 for each in trial.of_leaves)


def test_islands_that_fit_together_take_one_closing() -> None:
    pair = shapely.union_all([Point(x, 0.7).buffer(0.04) for x in (0.0, 0.15)])
    found = closings_only(planner_of(case_of(SensorLayout.NONE))[0], pair)
    assert isinstance(found.policy, Close) and found.policy.otherwise is None


@pytest.mark.parametrize(
    "belief",
    [
        Point(0.0, 0.9).buffer(0.3),
        shapely.union_all([Point(x, 0.7).buffer(0.06) for x in (-0.23, 0.0, 0.23)]),
    ],
    ids=["one piece", "too near"],
)
def test_where_closing_would_push_what_it_does_not_catch_no_closings_are_certain(belief: shapely.Geometry) -> None:
    found = closings_only(planner_of(case_of(SensorLayout.NONE))[0], belief)
    assert not is_guaranteed(found.policy)


def test_closings_too_near_to_each_other_lose_objects() -> None:
    """What the refusal is for: the same closings, carried out all the same."""
    case = case_of(SensorLayout.NONE)
    planner, _ = planner_of(case)
    near = [Point(x, 0.7).buffer(0.06) for x in (0.0, 0.26)]
    first = planner.closing(near[0])
    assert first is not None
    rest = affinity.translate(near[1], -first.place.x, -first.place.y)
    policy = replace(first, otherwise=planner.closing(rest))
    assert not affinity.translate(planner.openings[0].swept, first.place.x, first.place.y).disjoint(near[1])
    assert tried(case, policy, shapely.union_all(near)).lost > 0


def test_closings_are_carried_out_in_the_planar_world() -> None:
    """From each island; the third time the fingers have closed on nothing twice before, whichever is first."""
    case = case_of(SensorLayout.NONE, behaviour=Behaviour(name=BehaviourName.FOLLOW_POLICY))
    policy = closings_only(planner_of(case)[0], ISLANDS).policy
    clearance = HAND.finger_length + 0.038
    last = straight_motion(HAND).last
    closed = []
    for x, y in ((0.0, 0.7), (0.9, 0.7), (-1.3, 1.7), (0.0, 1.7)):
        reflex = FollowPolicy(drive_of(case), policy, 0.5, clearance, last)
        done = run_behaviour(case, (x, y, 0.0), reflex=reflex)
        assert done.trace.ended is Ended.STOPPED and done.trace.outcome.caught
        closed.append(sum(each.what.startswith("close:") for each in done.trace.happenings))
    assert sorted(closed) == [1, 2, 3, 4]


def test_strips_are_a_tree_of_approaches_to_the_end() -> None:
    policy = strips(planner_of(case_of(SensorLayout.DISTRIBUTED))[0], box(-1.0, 0.5, 1.0, 1.0), 1).policy
    assert isinstance(policy, Approach)
    assert all(isinstance(each, Close) for each in leaves(policy))
    assert sum(each.sensor is None for each in policy.branches) == 1
