"""Behaviours run in the planar world: plans keep their promise under feedback, reflexes grasp."""

from __future__ import annotations

from functools import cache
from math import pi
from typing import Any

import numpy as np
import pytest

from palmar.behaviours.policy import approaches, is_guaranteed
from palmar.behaviours.verdict import Verdict
from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import slider_body
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case, Start
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.outcome import Outcome
from palmar.models.sensors import SensorLayout, Sensors
from palmar.models.support import Support, SupportKind
from palmar.regions.moving import ArmMotion, caught
from palmar.studies.run_behaviour import Circumstances, behaviour_of, run_behaviour
from palmar.worlds.planar.bits import Sensing
from palmar.worlds.run import Ended

BED = Hand(palm_width=0.12, finger_links=(0.137, 0.107))
COARSE = Circumstances(tick=0.02)


def case_of(name: BehaviourName, hand: Hand = BED, layout: str = "distributed", **given: Any) -> Case:
    return Case(
        hand=hand, object=Disk(radius=0.038), sensors=Sensors(layout=SensorLayout(layout)),
        start=Start(at=(0.0, 0.5)), behaviour=Behaviour(name=name, **given),
    )  # fmt: skip


@cache
def planned(uncertainty: float) -> tuple[Case, Any]:
    case = case_of(BehaviourName.FOLLOW_POLICY, uncertainty=uncertainty, speed=0.5)
    reflex = behaviour_of(case)
    assert is_guaranteed(reflex.policy)
    return case, reflex


def drawn(uncertainty: float, number: int) -> np.ndarray:
    """Places about the case's start, half of them on the rim."""
    rng = np.random.default_rng(2)
    angle = rng.uniform(0.0, 2.0 * np.pi, number)
    distance = uncertainty * np.where(np.arange(number) % 2 == 0, 1.0, np.sqrt(rng.uniform(size=number)))
    return np.stack([distance * np.cos(angle), 0.5 + distance * np.sin(angle)], axis=1)


@pytest.mark.parametrize(("uncertainty", "most", "number"), [(0.15, 1, 10), (0.4, 2, 10)])
def test_a_plan_followed_catches_every_object_drawn(uncertainty: float, most: int, number: int) -> None:
    case, reflex = planned(uncertainty)
    assert approaches(reflex.policy) == most
    for x, y in drawn(uncertainty, number):
        done = run_behaviour(case, (float(x), float(y), 0.0), COARSE, reflex)
        assert done.massive
        assert (done.trace.ended, done.trace.outcome.caught) == (Ended.STOPPED, True)
        while_feeling = [row for row in done.trace.rows if "close: certain" not in row.why]
        assert np.allclose([row.pose for row in while_feeling[:-1]], done.start, rtol=0.0, atol=1e-12)


def test_a_plan_that_misses_its_bits_does_not_grasp_blindly() -> None:
    case, reflex = planned(0.15)
    done = run_behaviour(case, (0.0, 0.5, 0.0), Circumstances(0.02, Sensing(missed=1.0)), reflex)
    assert done.trace.ended is Ended.STOPPED
    assert "held up" in done.trace.rows[-1].why
    assert not done.trace.outcome.caught


@pytest.mark.parametrize("thickness", [0.0, 0.025])
def test_the_jointed_reflex_grasps_and_never_cuts_into_the_object(thickness: float) -> None:
    hand = BED.model_copy(update={"finger_thickness": thickness})
    case, rng = case_of(BehaviourName.JOINTED, hand), np.random.default_rng(5)
    for _ in range(10):
        start = float(rng.uniform(-0.12, 0.12)), float(rng.uniform(0.07, 0.2)), 0.0
        done = run_behaviour(case, start, COARSE)
        assert done.trace.ended is Ended.STOPPED
        assert done.trace.outcome.caught
        assert done.verdict is not Verdict.MISSED
        for row in done.trace.rows:
            gaps = [
                gap(hand, joints, row.pose, side) for joints, side in ((row.seen.right, 1.0), (row.seen.left, -1.0))
            ]
            assert min(gaps) >= 0.038 + hand.half_thickness - 1e-7
    joints = np.array([[row.seen.right[1], row.seen.left[1]] for row in done.trace.rows])
    assert joints.max() > 0.1


def gap(hand: Hand, joints: tuple[float, ...], pose: tuple[float, float, float], side: float) -> float:
    """Distance of the object's centre from a finger's joint line."""
    x, y, direction, least = hand.half_palm, 0.0, 0.0, np.inf
    for length, joint in zip(hand.finger_links, joints, strict=True):
        direction += joint
        dx, dy = np.cos(direction), np.sin(direction)
        px, py = side * pose[0] - x, pose[1] - y
        along = np.clip(px * dx + py * dy, 0.0, length)
        least = min(least, np.hypot(px - along * dx, py - along * dy))
        x, y = x + length * dx, y + length * dy
    return float(least)


def test_moving_while_closing_keeps_what_closing_alone_loses() -> None:
    """A disk far out: the standing hand's tips miss it, the advancing hand scoops it in."""
    start = (0.0, 0.33, 0.0)
    alone = run_behaviour(case_of(BehaviourName.CLOSE), start, COARSE)
    moving = run_behaviour(case_of(BehaviourName.MOVE_WHILE_CLOSING, advance=0.2, speed=0.05), start, COARSE)
    assert not alone.trace.outcome.caught
    assert moving.trace.outcome.caught
    assert moving.trace.rows[-1].seen.arm[1] == pytest.approx(0.2, abs=1e-9)


def test_the_palm_reflex_closes_at_the_bit_and_only_then() -> None:
    case = case_of(BehaviourName.PALM_REFLEX, layout="palm", advance=0.2, delay=0.1)
    done = run_behaviour(case, (0.02, 0.1, 0.0), Circumstances(tick=0.01))
    felt = next(each.time for each in done.trace.happenings if each.kind == "fires")
    closes = next(each.time for each in done.trace.happenings if each.what.endswith(": close"))
    assert felt == pytest.approx(0.62, abs=0.011)
    assert closes - felt == pytest.approx(0.1, abs=1e-9)
    assert done.trace.outcome.caught
    missed = run_behaviour(case, (0.0, 0.4, 0.0), COARSE)
    assert (missed.trace.outcome, missed.trace.ended) == (Outcome.MISSED, Ended.STOPPED)
    assert missed.trace.joints == ((0.0, 0.0), (0.0, 0.0))


def test_a_gripped_object_is_felt_though_it_no_longer_moves() -> None:
    case = case_of(BehaviourName.CLOSE)
    pressed = Circumstances(0.02, Sensing(displacement=0.2))
    done = run_behaviour(case, (0.03, 0.12, 0.0), pressed)
    assert done.trace.outcome.caught and done.verdict is Verdict.CAUGHT
    assert not any(any(row.seen.bits) for row in done.trace.rows[:-2])


def test_a_run_is_cut_off_and_says_so() -> None:
    done = run_behaviour(case_of(BehaviourName.CLOSE), (0.0, 0.1, 0.0), Circumstances(tick=0.1, longest=0.5))
    assert done.trace.ended is Ended.CUT_OFF
    assert done.trace.rows[-1].seen.time == pytest.approx(0.5)


def test_plans_for_polygons_are_refused() -> None:
    square = ConvexPolygon(shape="polygon", vertices=((0.0, 0.0), (0.1, 0.0), (0.0, 0.1)))
    case = case_of(BehaviourName.FOLLOW_POLICY).model_copy(update={"object": square})
    with pytest.raises(NotCoveredError, match="disks"):
        run_behaviour(case, (0.0, 0.5, 0.0))


def test_plans_in_free_space_are_refused() -> None:
    case = case_of(BehaviourName.FOLLOW_POLICY).model_copy(update={"support": Support(kind=SupportKind.FREE)})
    with pytest.raises(NotCoveredError, match="on a table"):
        run_behaviour(case, (0.0, 0.5, 0.0))


def test_moving_while_closing_ends_as_the_batch_with_a_sliding_hand() -> None:
    """The batch carries the same motion with time as the closing angle; its arm stops with the fingers."""
    rng, speed = np.random.default_rng(7), 0.06
    case = case_of(
        BehaviourName.MOVE_WHILE_CLOSING, first=0.03, speed=speed, advance=0.03 + speed * pi / BED.finger_rate
    )
    starts = np.column_stack([rng.uniform(-0.35, 0.35, 20), rng.uniform(0.08, 0.6, 20), np.zeros(20)])
    body = slider_body(slider_of(case.object, case.support), case.contact.friction)
    held = caught(straight_motion(BED), body, starts, ArmMotion(0.03, speed / BED.finger_rate))
    assert 5 < held.sum() < 20
    for start, expected in zip(starts, held, strict=True):
        done = run_behaviour(case, tuple(start), COARSE)
        assert done.trace.outcome.caught == expected
