"""Fingers with mass and a motor of limited torque: the motion that events, film and final angles tell of."""

from __future__ import annotations

import numpy as np
import pytest

from palmar.errors import InputError, NotCoveredError
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.studies.run_behaviour import run_behaviour
from palmar.studies.simulate import film, simulate_start, simulate_starts

TEXT = (
    "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n{hand}\n[object]\nradius_mm = 38\nmass_kg = 1\n"
    "[contact]\nfriction = 0\nrestitution = 0.8\n[support]\nkind = '{support}'\n"
)
RATE = np.radians(30.0)
INERTIA = 0.5 * 0.244**2 / 3.0
START = (0.2, 0.1)


def case_of(torque: float | None = None, mass: float = 0.5, more: str = "", support: str = "free") -> Case:
    hand = f"finger_mass_kg = {mass}\n{more}"
    hand += "" if torque is None else f"\nfinger_torque_N_m = {torque}"
    return parse_case(TEXT.format(hand=hand, support=support), "x")


def test_the_film_shows_the_finger_that_an_impact_slows() -> None:
    """Beside the finger in small steps: its rate falls by J X / I at the first impact, then the motor brings it back."""
    torque, start = 0.002, START
    case = case_of(torque)
    done, shown = simulate_start(case, start), film(case, (*start, 0.0), 4001)
    first, second = (time for time, each in done.events if each.kind == "impact")
    times = (shown.psi - case.hand.open) / case.hand.finger_rate
    foot = np.sqrt((start[0] - 0.06) ** 2 + start[1] ** 2 - 0.038**2)
    approach = RATE * foot
    impulse = 1.8 * approach * INERTIA / (INERTIA + foot**2)
    angle, rate, step, expected = RATE * first, RATE - impulse * foot / INERTIA, 1e-5, []
    some = (times > first) & (times < second)
    assert some.sum() > 100
    now = first
    for time in times[some]:
        while now < time:
            rate = min(rate + step * torque / INERTIA, RATE)
            angle, now = angle + step * rate, now + step
        expected.append(angle)
    assert shown.fingers[some, 0] == pytest.approx(np.array(expected), abs=2e-5)
    assert shown.fingers[times <= first] == pytest.approx(np.outer(RATE * times[times <= first], [1, 1]), abs=1e-12)


def test_film_batch_and_single_start_end_with_the_same_fingers() -> None:
    case, starts = case_of(0.02), np.array([[0.13, 0.06], [0.2, 0.1], [0.05, 0.15]])
    ends = simulate_starts(case, starts)
    for start, right, left in zip(starts, *ends.fingers.T, strict=True):
        done, shown = simulate_start(case, start), film(case, (*start, 0.0), 50)
        assert (done.right[0], done.left[0]) == pytest.approx((right, left), abs=1e-12)
        assert shown.fingers[-1] == pytest.approx([right, left], abs=1e-9)
        assert shown.poses[-1, :2] == pytest.approx(done.pose[:2], abs=1e-9)
    caught = ends.codes <= 2
    assert caught.any()
    assert (np.abs(ends.fingers[caught, 0] - ends.fingers[caught, 1]) > 0.01).any()  # the struck one is behind


def test_slowed_fingers_end_late_and_strong_or_heavy_ones_as_prescribed() -> None:
    slow, heavy = simulate_start(case_of(0.002), START), simulate_start(case_of(0.002, mass=1e6), START)
    plain = parse_case(TEXT.format(hand="", support="free"), "x")
    prescribed = simulate_start(plain, START)
    assert slow.events[-1][0] > np.pi / RATE + 1.0
    assert slow.right == pytest.approx((np.pi,), abs=1e-9)
    assert heavy.pose[:2] == pytest.approx(prescribed.pose[:2], abs=1e-5)
    strong = simulate_start(case_of(1e6), START)
    assert strong.pose[:2] == pytest.approx(simulate_start(case_of(), START).pose[:2], abs=1e-4)


def test_the_region_knows_of_the_torque() -> None:
    region = build_region(case_of(0.02), tolerance=0.03)
    assert any("bring them back to their rate with 0.02 N m" in each for each in region.notes)
    assert region.area != pytest.approx(build_region(case_of(), tolerance=0.03).area, rel=1e-3)


@pytest.mark.parametrize(
    ("hand", "support", "words"),
    [
        ("finger_torque_N_m = 1", "free", "needs finger_mass_kg"),
        ("finger_mass_kg = 1\nfinger_torque_N_m = 1", "table", "is for support.kind"),
        ("finger_mass_kg = 1\nfinger_torque_N_m = 0", "free", "finger_torque_N_m"),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_line(hand: str, support: str, words: str) -> None:
    with pytest.raises(InputError, match=words) as found:
        parse_case(TEXT.format(hand=hand, support=support), "x")
    assert "\n" not in str(found.value)


def test_what_is_not_simulated_says_so() -> None:
    with pytest.raises(NotCoveredError, match="crossing"):
        simulate_start(case_of(0.02, more="fingers = 'colliding'"), START)
    with pytest.raises(NotCoveredError, match="under feedback"):
        run_behaviour(case_of(0.02), (0.0, 0.15, 0.0))
    assert open_case("zero_g_example")[1].hand.finger_torque is None
