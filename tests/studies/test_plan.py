"""Plans: what they say is certain is, by a trial that knows nothing of their sets."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest
import shapely
from shapely import Point, affinity, box

from palmar.behaviours.fewest import Fewest
from palmar.behaviours.placing import Place
from palmar.behaviours.policy import Approach, Close, approaches, is_guaranteed, leaves
from palmar.behaviours.search import Search, moves, width
from palmar.errors import NotCoveredError
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.sensors import SensorLayout, Sensors, Stretch
from palmar.models.support import Support, SupportKind
from palmar.regions.profile import above
from palmar.studies.leaf_trial import try_leaves
from palmar.studies.plan import Plan, Rule, plan, planner_of
from palmar.studies.plan_trial import Errors, Trial, drawn_starts, try_plan

BED = Hand(palm_width=0.12, finger_links=(0.137, 0.107))
DOUBT = {"displacement": 0.002, "pose_error": 0.001}
LAYOUTS = {
    "distributed": SensorLayout.DISTRIBUTED,
    "full": SensorLayout.FULL,
    "halves": tuple(Stretch(body=each) for each in ("palm", "right_1", "right_2", "left_1", "left_2")),
}


def case_of(layout: object, hand: Hand = BED, radius: float = 0.038, **doubt: float) -> Case:
    return Case(hand=hand, object=Disk(radius=radius), sensors=Sensors(layout=layout, **(doubt or DOUBT)))


def tried(
    case: Case, found: Plan, uncertainty: object, at: tuple[float, float], errors: Errors, number: int = 4000
) -> Trial:
    starts = drawn_starts(uncertainty, number, 4) + np.array(at)
    return try_plan(case, found.found.policy, found.stretches, starts, errors, 1)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_object_drawn_is_caught_within_the_approaches_promised(layout: str) -> None:
    """An uncertainty of three times the closing region's area."""
    case = case_of(LAYOUTS[layout])
    planner, _ = planner_of(case)
    radius = sqrt(3.0 * max(each.target.region.area for each in planner.openings) / pi)
    uncertainty, at = Point(0.0, 0.0).buffer(radius), (0.0, 2.0 * radius)
    found = plan(case, uncertainty, at, 3)
    assert is_guaranteed(found.found.policy) and found.found.minimal
    trial = tried(case, found, uncertainty, at, Errors(**DOUBT))
    assert (trial.lost, trial.surprised, trial.given_up) == (0, 0, 0)
    assert trial.most_approaches <= approaches(found.found.policy) == 1


def test_a_plan_for_a_range_of_radii_catches_them_all() -> None:
    """By one policy; a plan for the smallest radius only does not."""
    case, uncertainty, at = case_of(SensorLayout.DISTRIBUTED), Point(0.0, 0.0).buffer(0.28), (0.0, 0.6)
    found = plan(case, uncertainty, at, 3, largest=0.042)
    assert is_guaranteed(found.found.policy)
    assert found.guarantee is Guarantee.SAMPLED
    for radius in (0.038, 0.0393, 0.042):
        trial = tried(case_of(SensorLayout.DISTRIBUTED, radius=radius), found, uncertainty, at, Errors(**DOUBT), 1500)
        assert trial.caught == 1500
    with pytest.raises(NotCoveredError, match="one radius"):
        plan(case.model_copy(update={"support": Support(kind=SupportKind.FREE)}), uncertainty, at, 3, largest=0.042)


def test_the_source_s_rule_needs_no_fewer_approaches() -> None:
    """Where re-centring does as well, and where it comes to no end: parts on both sides of the hand, dead parts."""
    for layout, uncertainty, needed in (
        (SensorLayout.DISTRIBUTED, Point(0.0, 0.0).buffer(0.28), 1),
        (SensorLayout.FULL, box(-0.3, -0.1, 0.3, 0.1), 1),
        (SensorLayout.FULL, box(-0.4, -0.1, 0.4, 0.1), None),
        (SensorLayout.TIPS, box(-0.25, -0.05, 0.25, 0.05), None),
    ):
        case = case_of(layout)
        searched = plan(case, uncertainty, (0.0, 0.5), 3).found.policy
        ruled = plan(case, uncertainty, (0.0, 0.5), 3, rule=Rule.RECENTRE)
        assert is_guaranteed(searched)
        assert (approaches(ruled.found.policy) if is_guaranteed(ruled.found.policy) else None) == needed
        if needed is not None:
            assert approaches(searched) <= needed
            assert tried(case, ruled, uncertainty, (0.0, 0.5), Errors(**DOUBT)).caught == 4000


def test_a_wide_uncertainty_takes_more_approaches() -> None:
    """Wider than the open hand: what the first approach does not touch is looked for by the next."""
    case, uncertainty, at = case_of(SensorLayout.DISTRIBUTED), box(-0.6, -0.1, 0.6, 0.1), (0.0, 0.5)
    found = plan(case, uncertainty, at, 3)
    assert is_guaranteed(found.found.policy)
    assert approaches(found.found.policy) == 2
    trial = tried(case, found, uncertainty, at, Errors(**DOUBT))
    assert trial.caught == trial.starts


def test_an_object_known_well_needs_no_approach() -> None:
    case, uncertainty, at = case_of(SensorLayout.NONE), Point(0.0, 0.0).buffer(0.06), (0.2, 0.9)
    found = plan(case, uncertainty, at, 3)
    assert isinstance(found.found.policy, Close)
    assert tried(case, found, uncertainty, at, Errors(**DOUBT)).lost == 0


def test_without_sensors_a_wide_uncertainty_has_no_plan() -> None:
    found = plan(case_of(SensorLayout.NONE), Point(0.0, 0.0).buffer(0.4), (0.0, 0.9), 3)
    assert not is_guaranteed(found.found.policy)
    assert [type(each).__name__ for each in leaves(found.found.policy)] == ["Lost"]


def test_what_a_plan_cannot_do_is_what_the_trial_gives_up() -> None:
    """Tips only: the plan leaves some, and only from what it leaves are objects not caught."""
    case, uncertainty, at = case_of(SensorLayout.TIPS), box(-0.5, -0.05, 0.5, 0.05), (0.0, 0.5)
    found = plan(case, uncertainty, at, 1)
    assert not is_guaranteed(found.found.policy)
    trial = tried(case, found, uncertainty, at, Errors(**DOUBT))
    assert trial.given_up > 0
    assert (trial.lost, trial.surprised) == (0, 0)


def test_a_trial_notices_a_region_that_is_too_large() -> None:
    """The plan of a hand whose fingers are half as long again, followed by the real one."""
    longer = BED.model_copy(update={"finger_links": (0.2, 0.166)})
    wrong = case_of(SensorLayout.FULL, longer, 0.06)
    uncertainty, at = Point(0.0, 0.0).buffer(0.14), (0.0, 0.5)
    found = plan(wrong, uncertainty, at, 2)
    trial = tried(case_of(SensorLayout.FULL), found, uncertainty, at, Errors(**DOUBT))
    assert trial.caught < trial.starts


def test_missed_bits_and_large_errors_cost_what_the_plan_did_not_assume() -> None:
    case, uncertainty, at = case_of(SensorLayout.DISTRIBUTED), Point(0.0, 0.0).buffer(0.28), (0.0, 0.6)
    found = plan(case, uncertainty, at, 2)
    missed = tried(case, found, uncertainty, at, Errors(**DOUBT, missed=0.1))
    assert 0.07 < 1.0 - missed.caught / missed.starts < 0.13
    thrown = tried(case, found, uncertainty, at, Errors(displacement=0.2, pose_error=0.001))
    assert thrown.lost > 0


def test_what_no_plan_covers_is_refused() -> None:
    square = ConvexPolygon(shape="polygon", vertices=((0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)))
    case = case_of(SensorLayout.FULL).model_copy(update={"object": square})
    with pytest.raises(NotCoveredError, match="disks"):
        plan(case, Point(0.0, 0.0).buffer(0.1), (0.0, 0.4), 1)


def test_an_approach_stops_before_a_part_without_a_sensor_would_touch() -> None:
    """Two islands: what the palm feels, and what lies where the finger would touch if it went on."""
    case, at = case_of(SensorLayout.PALM), (0.0, 0.0)
    islands = shapely.union_all([box(-0.045, 0.4, 0.045, 0.5), box(0.15, 1.0, 0.25, 1.1)])
    found = plan(case, islands, at, 2)
    assert is_guaranteed(found.found.policy) and found.found.minimal
    assert isinstance(found.found.policy, Approach)
    assert {each.sensor for each in found.found.policy.branches} == {0, None}
    trial = tried(case, found, islands, at, Errors(**DOUBT))
    assert trial.caught == trial.starts
    whole = replace(found.found.policy, distance=2.0)
    starts = drawn_starts(islands, 2000, 4)
    assert try_plan(case, whole, found.stretches, starts, Errors(**DOUBT), 1).surprised > 0


def test_an_approach_stops_before_a_sensor_has_felt_too_much(monkeypatch: pytest.MonkeyPatch) -> None:
    """Were all beliefs up to 0.2 m of width certain, a slanted one of 0.29 m would be cut by the distance alone."""
    case = case_of((Stretch(body="palm"),), BED.model_copy(update={"palm_width": 1.2}))
    planner, _ = planner_of(case)
    belief = affinity.translate(affinity.rotate(box(-0.26, -0.02, 0.26, 0.02), 60.0), 0.0, 1.0)
    search = Search(planner, Fewest(planner))
    fits = Close(belief, Place(0.0, 0.0, 0.0), 0.0)
    monkeypatch.setattr(Search, "closing", lambda self, part, facing: fits if width(part) < 0.2 else None)
    move = next(each for each in moves(planner, belief, 0.0) if not each.dead)
    swept = search.swept(move)
    assert swept is not None and max(width(each.belief) for each in swept.felt) > 0.2
    policy = search._stopped(belief, move, swept, 1)
    assert isinstance(policy, Approach) and policy.distance < swept.distance - 0.05
    assert sorted(each.sensor is None for each in policy.branches) == [False, True]
    assert max(width(each.belief) for each in policy.branches) < 0.2


def test_a_hand_that_may_turn_needs_fewer_approaches() -> None:
    """A box too wide to be felt in one approach from before it, not from its side; turned both ways alike."""
    case, uncertainty, at = case_of(SensorLayout.DISTRIBUTED), box(-0.6, -0.1, 0.6, 0.1), (0.0, 1.0)
    assert approaches(plan(case, uncertainty, at, 3).found.policy) == 2
    for turn in (0.5 * pi, -0.5 * pi):
        found = plan(case, uncertainty, at, 3, directions=(0.0, turn))
        assert is_guaranteed(found.found.policy) and approaches(found.found.policy) == 1
        assert isinstance(found.found.policy, Approach) and found.found.policy.turn == pytest.approx(turn)
        trial = tried(case, found, uncertainty, at, Errors(**DOUBT))
        assert trial.caught == trial.starts


def test_turns_of_the_belief_and_of_the_hand_are_the_same() -> None:
    case, turn = case_of(SensorLayout.TIPS), 0.4
    belief = box(-0.05, 0.4, 0.05, 1.2)
    straight = plan(case, belief, (0.0, 0.0), 3)
    turned = plan(case, affinity.rotate(belief, turn, origin=(0.0, 0.0), use_radians=True), (0.0, 0.0), 3,
                  directions=(turn,))  # fmt: skip
    assert approaches(turned.found.policy) == approaches(straight.found.policy) == 2
    assert turned.found.least == straight.found.least
    trial = tried(
        case, turned, affinity.rotate(belief, turn, origin=(0.0, 0.0), use_radians=True), (0.0, 0.0), Errors(**DOUBT)
    )
    assert trial.caught == trial.starts


def test_every_leaf_is_tried_as_often() -> None:
    case = case_of(SensorLayout.FULL)
    uncertainty = Point(0.0, 0.6).buffer(0.28)
    found = plan(case, uncertainty, (0.0, 0.0), 2)
    trial = try_leaves(case, found.found.policy, found.stretches, uncertainty, Errors(**DOUBT), 500, 1)
    assert min(trial.of_leaves) >= 500
    assert trial.caught == trial.starts >= 500 * len(trial.of_leaves)


def test_a_false_bit_costs_the_object_where_the_belief_is_wrong() -> None:
    case, uncertainty, at = case_of(SensorLayout.DISTRIBUTED), Point(0.0, 0.0).buffer(0.28), (0.0, 0.6)
    found = plan(case, uncertainty, at, 2)
    trial = tried(case, found, uncertainty, at, Errors(**DOUBT, false=0.1))
    assert 0.04 < 1.0 - trial.caught / trial.starts <= 0.12
    assert tried(case, found, uncertainty, at, Errors(**DOUBT, false=1.0)).lost > 2000


def test_a_plan_is_a_tree_of_places_that_can_be_gone_to() -> None:
    found = plan(case_of(SensorLayout.DISTRIBUTED), Point(0.0, 0.0).buffer(0.28), (0.0, 0.6), 2)
    policy = found.found.policy
    assert isinstance(policy, Approach)
    assert policy.distance > 0.0
    assert {each.sensor for each in policy.branches} <= {None, *range(len(found.stretches))}
    assert all(isinstance(each, Close) and each.place.margin > 0.0 for each in leaves(policy))


@pytest.mark.parametrize("number", range(4))
def test_a_leaf_is_come_to_without_touching(number: int) -> None:
    """Every place of a closing region that plans use lies above the hand as it comes up, or beside it."""
    planner, _ = planner_of(case_of(SensorLayout.NONE, BED.model_copy(update={"finger_thickness": 0.025})))
    opening = planner.openings[number]
    places = drawn_starts(opening.target.region, 4000, number)
    assert (places[:, 1] >= opening.profile.heights(places[:, 0]) - 1e-9).all()


def test_places_under_an_open_finger_are_left_out_of_plans() -> None:
    """A disk outside a finger that is open by 75 degrees, caught though it is by the closing motion, cannot be come to."""
    case = case_of(SensorLayout.NONE, Hand(palm_width=0.12, finger_links=(0.244,), open=1.3), 0.02)
    planner, _ = planner_of(case)
    seen = planner.openings[0].profile
    beyond = shapely.difference(shapely.box(seen.left, 0.0, seen.right, 0.5), above(seen, 1.0))
    assert shapely.intersection(planner.openings[0].target.region, beyond).area < 1e-9
    assert beyond.area > 0.01


def test_a_heavy_free_disk_is_planned_for_and_tried_in_free_space() -> None:
    """Section 3.4.3: the same plans where touch does not move the object."""
    text = (
        "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\n[object]\nradius_mm = 38\nmass_kg = 50\n"
        "[contact]\nfriction = 0\nrestitution = 0.5\n[support]\nkind = 'free'\n[sensors]\nlayout = 'distributed'\n"
    )
    case = parse_case(text, "heavy")
    found = plan(case, Point(0.0, 0.0).buffer(0.2), (0.0, 0.6), 2)
    assert is_guaranteed(found.found.policy)
    assert found.guarantee is Guarantee.SAMPLED
    starts = drawn_starts(Point(0.0, 0.6).buffer(0.2), 4000, 1)
    done = try_plan(case, found.found.policy, found.stretches, starts, Errors())
    assert (done.caught, done.lost, done.surprised) == (done.starts, 0, 0)
    moving = case.model_copy(update={"start": case.start.model_copy(update={"velocity": (0.0, 0.1)})})
    with pytest.raises(NotCoveredError, match="heavy objects at rest"):
        plan(moving, Point(0.0, 0.0).buffer(0.2), (0.0, 0.6), 2)
