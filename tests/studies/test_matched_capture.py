"""The chance of a catch by matching velocities: run by run that of the kernel with the same errors, and its interval."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from palmar.behaviours.build import reflex_of
from palmar.errors import InputError
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case, Start
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.studies.matched_capture import drawn_capture, matched_capture
from palmar.studies.run_behaviour import Circumstances, run_behaviour
from palmar.worlds.planar.tracker import Tracker

PLACE = (0.0, 0.135)
ROUGH = Tracker(0.2, 0.05, 0.015, seed=1000)


def case_of(velocity: tuple[float, float], **given: object) -> Case:
    does = {"speed": 0.4, "acceleration": 3.0, "reach": 2.0, "place": PLACE, "delay": 0.2} | given
    behaviour = Behaviour(name=BehaviourName.MATCH_VELOCITY, **does)
    change = {"start": Start(at=(0.02, 0.15), velocity=velocity), "behaviour": behaviour}
    return open_case("zero_g_example")[1].model_copy(update=change)


def test_each_run_ends_as_the_kernel_does_with_the_same_errors() -> None:
    """From where the errors put the disk in the hand, at the error of the velocity; up to the distance that is at it."""
    case, agree, caught = case_of((0.05, 0.01)), 0, 0
    reflex, hand = reflex_of(case), capture_hand_of(case)
    for k in range(20):
        tracker = replace(ROUGH, seed=k)
        dx, dy, dvx, dvy = tracker.errors()
        start = PLACE[0] - dx - 0.2 * dvx, PLACE[1] - dy - 0.2 * dvy
        expected = Outcome.from_code(int(capture_all(hand, [start], (-dvx, -dvy)).codes[0])).caught
        done = run_behaviour(case, (0.02, 0.15, 0.0), Circumstances(0.02, tracker=tracker), reflex)
        agree, caught = agree + (done.trace.outcome.caught is expected), caught + expected
    assert 6 < caught < 20
    # A disk that is touched before it is at its place is not where the errors put it.
    assert agree >= 19


def test_the_interval_holds_the_drawn_chance_and_shrinks() -> None:
    case = case_of((0.05, 0.01))
    chance = drawn_capture(case, reflex_of(case), ROUGH, 40_000)
    with ThreadPoolExecutor(1) as executor:
        found = matched_capture(case, ROUGH, 30, executor)
    assert 0.3 < chance < 0.97
    assert found.runs == 30 and sum(count for _, count in found.ends) == 30
    assert found.low < found.caught / 30 < found.high
    assert found.low - 0.03 < chance < found.high + 0.03


def test_a_wrong_velocity_shifts_the_disk_the_way_it_then_drifts() -> None:
    """Over an age of 2 s: place and drift err to the same side, which costs more than if they made up for one another."""
    case, wrong = case_of((0.0, 0.0), delay=2.0), Tracker(2.0, 0.0, 0.025, seed=5)
    chance = drawn_capture(case, reflex_of(case), wrong, 20_000)
    with ThreadPoolExecutor(1) as executor:
        found = matched_capture(case, wrong, 30, executor)
    assert found.low < chance < found.high


def test_a_disk_too_fast_for_the_arm_is_never_caught_and_the_reason_is_told() -> None:
    with ThreadPoolExecutor(1) as executor:
        found = matched_capture(case_of((0.5, 0.0)), Tracker(0.2, 0.001, 0.001), 8, executor)
    assert (found.caught, found.low) == (0, 0.0)
    assert all("more than the arm's 400 mm/s" in why for why, _ in found.ends)


def test_lag_that_is_not_made_up_for_costs_its_way() -> None:
    """The disk is ahead by v l, so the chance is that of a place shifted by as much."""
    case = case_of((0.1, 0.0), delay=0.0)
    late, shifted = Tracker(0.5, 0.03, 0.0), reflex_of(case_of((0.1, 0.0), delay=0.0, place=(0.05, 0.135)))
    one, other = (
        drawn_capture(case, reflex_of(case), late, 20_000),
        drawn_capture(case, shifted, replace(late, delay=0.0), 20_000),
    )
    assert one == pytest.approx(other, abs=1e-12)
    assert one < drawn_capture(case, reflex_of(case), replace(late, delay=0.0), 20_000)
    with ThreadPoolExecutor(1) as executor:
        found = matched_capture(case, late, 20, executor)
    assert found.low < one < found.high


def test_misuse_is_refused() -> None:
    case = case_of((0.0, 0.0))
    with ThreadPoolExecutor(1) as executor:
        with pytest.raises(InputError, match="match_velocity"):
            matched_capture(case.model_copy(update={"behaviour": Behaviour()}), ROUGH, 4, executor)
        with pytest.raises(InputError, match="at least 1"):
            matched_capture(case, ROUGH, 0, executor)
    assert np.isfinite(drawn_capture(case, reflex_of(case), ROUGH, 10))
