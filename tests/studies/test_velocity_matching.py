"""Matching the hand's velocity to a disk: ways and chances by sampling, limits, and moving disks by small steps."""

from math import inf, log, pi, sqrt

import numpy as np
import pytest

from palmar.errors import InputError, NotCoveredError
from palmar.mechanics.impact.capture_case import capture_hand_of
from palmar.models.case_file import parse_case
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.regions.region import Model
from palmar.studies.velocity_matching import Carriage, Tracking, closing_time, fastest, velocity_matching
from reference.slow_free_flight import caught, verdict_angle

CASE = open_case("zero_g_example")[1]
REGION = build_region(CASE, Model.CORRECTED)
CIRCLE = REGION.allowed_error
TIME = closing_time(CASE)
TRACKING, CARRIAGE = Tracking(0.005, 0.002, 0.05), Carriage(reach=0.6, acceleration=2.0, speed=0.3)


def test_the_closing_time_is_that_of_the_verdict():
    assert pytest.approx(verdict_angle(0.06, 0.244, 0.038) / CASE.hand.finger_rate, rel=1e-12) == TIME
    fast = CASE.model_copy(update={"hand": CASE.hand.model_copy(update={"finger_rate": 2.0 * CASE.hand.finger_rate})})
    assert closing_time(fast) == pytest.approx(0.5 * TIME, rel=1e-12)
    thick = CASE.model_copy(update={"hand": CASE.hand.model_copy(update={"finger_thickness": 0.025})})
    assert closing_time(thick) == pytest.approx(capture_hand_of(thick).closures[:, 0].min(), rel=1e-9)
    half = CASE.model_copy(update={"hand": CASE.hand.model_copy(update={"open": 0.3})})
    assert closing_time(half) == pytest.approx(TIME - 0.3 / CASE.hand.finger_rate, rel=1e-12)


def test_a_perfect_tracker_and_an_unlimited_hand_tolerate_the_whole_circle_at_any_speed():
    found = velocity_matching(CASE, REGION, Tracking(0.0, 0.0, 0.1), Carriage(), [0.0, 1.0, 100.0])
    assert found.tolerated == pytest.approx([CIRCLE.radius] * 3, rel=1e-12)
    assert found.chance == pytest.approx([1.0] * 3)
    assert fastest(CASE, REGION, Tracking(0.0, 0.0, 0.1), Carriage()) == inf


def test_the_matched_speed_uses_the_reach_up():
    """Speed up, keep the pace while closing, stop: integrated, that is the whole reach."""
    reach, quick, duration = 0.6, 2.0, 1.3
    pace = Carriage(reach, quick).matched_speed(duration)
    t = np.linspace(0.0, 2.0 * pace / quick + duration, 400001)
    v = np.minimum(np.minimum(quick * t, pace), quick * (t[-1] - t))
    assert np.sum(0.5 * (v[1:] + v[:-1]) * np.diff(t)) == pytest.approx(reach, rel=1e-8)
    assert Carriage(reach).matched_speed(duration) == pytest.approx(reach / duration)
    assert Carriage(reach, quick, 0.1).matched_speed(duration) == 0.1


def test_the_tolerated_error_is_flat_up_to_the_pace_and_falls_by_the_closing_time_beyond():
    pace = CARRIAGE.matched_speed(TIME)
    assert 0.05 < pace < 0.3
    v = np.array([0.0, 0.5 * pace, pace, pace + 0.01, pace + 0.02])
    found = velocity_matching(CASE, REGION, TRACKING, CARRIAGE, v)
    assert found.tolerated[:3] == pytest.approx([float(found.tolerated[0])] * 3)
    assert np.diff(found.tolerated[2:]) == pytest.approx([-0.01 * TIME] * 2, rel=1e-9)
    assert found.tolerated[0] == pytest.approx(CIRCLE.radius - found.spread)
    late = velocity_matching(CASE, REGION, Tracking(0.005, 0.002, 0.05, extrapolates=False), CARRIAGE, v)
    assert late.tolerated - found.tolerated == pytest.approx(-0.05 * v)


@pytest.mark.parametrize("extrapolates", [True, False])
@pytest.mark.parametrize("delay", [0.05, 2.0])
def test_the_fastest_speed_leaves_nothing(extrapolates, delay):
    tracking = Tracking(0.005, 0.002, delay, extrapolates)
    v = fastest(CASE, REGION, tracking, CARRIAGE)
    assert 0.0 < v < 1.0
    assert velocity_matching(CASE, REGION, tracking, CARRIAGE, v).tolerated == pytest.approx(0.0, abs=1e-12)
    assert fastest(CASE, REGION, Tracking(1.0, 0.0, 0.0), CARRIAGE) == 0.0


@pytest.mark.parametrize("speed", [0.05, 0.15])
def test_the_chance_is_that_of_sampled_errors(speed):
    tracking = Tracking(0.02, 0.008, 0.1)
    found = velocity_matching(CASE, REGION, tracking, CARRIAGE, speed, 0.9)
    rng = np.random.default_rng(6)
    count = 200_000
    place = rng.normal(0.0, 0.02, (count, 2)) + rng.normal(0.0, 0.008, (count, 2)) * (0.1 + TIME)
    off = np.hypot(*place.T)
    assert found.chance == pytest.approx(np.mean(off < CIRCLE.radius - found.drift), abs=4e-3)
    assert np.mean(off < found.spread) == pytest.approx(0.9, abs=4e-3)
    assert found.spread == pytest.approx(sqrt(-2.0 * log(0.1)) * sqrt(0.02**2 + (0.008 * (0.1 + TIME)) ** 2))


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_disks_that_drift_within_the_circle_are_caught(share):
    """Start off the middle by all that is tolerated, moving by the rest in any direction: simulated, none is lost."""
    hand = (0.06, 0.244, 0.038)
    rng = np.random.default_rng(8)
    reach, drift = (1.0 - share) * CIRCLE.radius, share * CIRCLE.radius / verdict_angle(*hand)
    at, to = rng.uniform(0.0, 2.0 * pi, (2, 400))
    starts = np.column_stack([CIRCLE.centre[0] + reach * np.cos(at), CIRCLE.centre[1] + reach * np.sin(at)])
    starts = np.column_stack([starts, drift * np.cos(to), drift * np.sin(to)])
    for e in (1.0, 0.5, 0.0):
        assert caught(starts, *hand, e, step=1e-3)[0].all()


def test_misuse_is_refused():
    for wrong in ({"position_sigma": -1.0}, {"delay": inf}):
        with pytest.raises(InputError):
            Tracking(**{"position_sigma": 0.0, "velocity_sigma": 0.0, "delay": 0.0} | wrong)
    with pytest.raises(InputError):
        Carriage(reach=0.0)
    with pytest.raises(InputError):
        velocity_matching(CASE, REGION, TRACKING, CARRIAGE, 0.1, 1.0)
    text = '[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nradius_mm = {}\n[support]\nkind = "free"\n'
    large = parse_case(text.format(70))
    with pytest.raises(NotCoveredError, match="no start is caught"):
        velocity_matching(large, build_region(large, Model.CORRECTED), TRACKING, CARRIAGE, 0.1)
    with pytest.raises(NotCoveredError, match="never close"):
        closing_time(parse_case(text.format(400)))
