"""The palm as a paddle: it stops the disk dead where the palm reflex loses it, and says what it cannot do."""

from __future__ import annotations

from math import ceil

import pytest

from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.outcome import Outcome
from palmar.studies.run_behaviour import Circumstances, run_behaviour
from palmar.worlds.planar.tracker import Tracker

TEXT = (
    "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nradius_mm = 38\n[contact]\nfriction = 0\n"
    "restitution = {e}\n[support]\nkind = 'free'\n[start]\nvelocity_mm_s = [5, {vy}]\n[sensors]\nlayout = 'palm'\n"
    "[behaviour]\nname = 'matched_return'\nspeed_mm_s = {speed}\nacceleration_mm_s2 = 100000\nreach_mm = {reach}\n"
)
START = (0.01, 0.15, 0.0)


def case_of(e: float = 0.9, vy: float = -120, speed: float = 200, reach: float = 1000) -> Case:
    return parse_case(TEXT.format(e=e, vy=vy, speed=speed, reach=reach), "x")


@pytest.mark.parametrize("e", [1.0, 0.9, 0.5, 0.0])
def test_it_leaves_the_disk_at_rest_and_catches_it(e: float) -> None:
    rows = run_behaviour(case_of(e), START, Circumstances(tick=0.02)).trace
    assert rows.outcome.caught
    struck = next(row for row in rows.rows if row.why.startswith("struck"))
    assert abs(struck.seen.track[3]) < 0.02 * 0.12


def test_the_palm_reflex_loses_that_disk() -> None:
    case = case_of()
    reflex = case.behaviour.model_copy(update={"name": BehaviourName.PALM_REFLEX})
    assert not run_behaviour(case.model_copy(update={"behaviour": reflex}), START).trace.outcome.caught


@pytest.mark.parametrize(
    ("given", "words"),
    [({"vy": 20}, "does not come"), ({"speed": 20}, "more than the arm's"), ({"reach": 50}, "reach of 50 mm")],
)
def test_it_says_what_it_cannot_do(given: dict[str, float], words: str) -> None:
    trace = run_behaviour(case_of(**given), START, Circumstances(tick=0.02)).trace
    assert words in trace.rows[-1].why


def test_a_disk_that_the_open_finger_stops_is_caught_too() -> None:
    """What the fingers do to it afterwards is not followed: it is shut in where a hand at rest would shut it in."""
    run = run_behaviour(case_of(), (0.1, 0.15, 0.0), Circumstances(tick=0.02)).trace
    assert run.outcome.caught
    assert run.rows[-1].seen.arm[0] == pytest.approx(0.005 * run.rows[-1].seen.time, abs=5e-3)


def test_with_errors_of_the_tracker_it_ends_as_the_kernel_from_where_they_leave_the_disk() -> None:
    """Wrong by (p, q) in velocity, the disk is left with (-p, e q), a tick's way off the palm, and drifted by -p t."""
    e, v, tick, agree, caught = 0.9, 0.12, 0.02, 0, 0
    case, share = case_of(e), e / (1.0 + e)
    hand = capture_hand_of(case)
    for seed in range(12):
        tracker = Tracker(0.0, 0.0, 0.02, seed)
        _, _, p, q = tracker.errors()
        back = share * (v - q)
        met = tick + (START[1] - v * tick - hand.radius) / (v - back)
        told = tick * ceil(met / tick)
        left = START[0] - p * (told - tick) + 0.005 * tick, hand.radius + (back + e * q) * (told - met)
        expected = Outcome.from_code(int(capture_all(hand, [left], (-p, e * q), e).codes[0])).caught
        run = run_behaviour(case, START, Circumstances(tick=tick, tracker=tracker)).trace
        agree, caught = agree + (run.outcome.caught is expected), caught + expected
    assert 2 < caught < 11
    assert agree >= 11
