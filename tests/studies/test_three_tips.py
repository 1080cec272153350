import pytest

from palmar.behaviours.descent import PALM, Closing, Descent, Stand, descents, ends_of, is_certain
from palmar.models.three_tips import ThreeTips
from palmar.studies.plan_trial import drawn_starts
from palmar.studies.three_tips import Task, largest_uncertainty, plan_descents, try_descents, uncertain_disk

RHO = 0.04


def task(opened=2.0, palm=None, **doubt):
    tips = ThreeTips(tip_radius=0.01, open_radius=opened * RHO, closed_radius=0.02, palm_radius=palm)
    return Task(tips, 0.03, 0.5, **doubt)


def test_one_approach_serves_an_uncertainty_of_rho_over_root_3():
    assert largest_uncertainty(task(), 1) == pytest.approx(RHO / 3.0**0.5, rel=0.02)


@pytest.mark.parametrize(("doubt", "circle"), [({}, 0.6 * RHO), ({"displacement": 0.004, "pose_error": 0.002}, None)])
def test_two_approaches_lose_none_of_those_drawn(doubt, circle):
    given, errors = task(**doubt), uncertain_disk(0.8 * RHO)
    plan = plan_descents(given, errors, 2, circle)
    assert is_certain(plan) and descents(plan) == 2
    tried = try_descents(given, plan, drawn_starts(errors, 20_000, 2), 2)
    assert (tried.caught, tried.lost, tried.given_up, tried.most) == (20_000, 0, 0, 2)


def test_a_plan_for_too_little_loses_some_of_those_drawn():
    plan = plan_descents(task(), uncertain_disk(0.8 * RHO), 2, 0.6 * RHO)
    tried = try_descents(task(), plan, drawn_starts(uncertain_disk(1.6 * RHO), 2_000, 2))
    assert tried.lost + tried.given_up > 100


def test_two_tips_are_never_felt_at_once_beyond_the_caging_circle():
    reach = task().reach
    narrow, wide = (
        {felt for felt, _ in reach.outcomes(uncertain_disk(1.2 * RHO), Stand(0.0, 0.0, 0.0, each * RHO))}
        for each in (1.15, 1.16)
    )
    assert ("tip 1", "tip 2") in narrow and all(len(each) == 1 for each in wide)


def test_every_belief_after_a_touch_is_part_of_the_one_before():
    errors = uncertain_disk(1.0 * RHO)
    plan = plan_descents(task(), errors, 2, 0.6 * RHO)
    assert isinstance(plan, Descent)
    assert sum(each.belief.area for each in plan.branches) >= errors.area * (1.0 - 1e-9)
    assert all(isinstance(each, Closing) and errors.buffer(1e-9).covers(each.belief) for each in ends_of(plan))


@pytest.mark.parametrize(("opened", "certain"), [(1.1, True), (1.6, False)])
def test_a_touched_palm_means_caught_only_within_the_caging_circle(opened, certain):
    reach, stand = task(opened, 0.01).reach, Stand(0.0, 0.0, 0.0, opened * RHO)
    palm = dict(reach.outcomes(uncertain_disk(0.8 * RHO), stand))[PALM]
    closing = reach.closing(palm, stand)
    assert (closing is not None and closing.there) == certain
