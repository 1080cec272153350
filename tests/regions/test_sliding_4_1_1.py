"""Capture by sliding: every start that it promises is caught by the kernel at e = 0, and little more is; how it compares."""

from __future__ import annotations

import numpy as np
import pytest

from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_hand import closing_hand
from palmar.mechanics.impact.contact_4_1_1 import frictionless
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.regions.sliding_4_1_1 import shut_angle, sliding_centre, sliding_reach
from palmar.studies.plan_trial import drawn_starts

EXAMPLE = (0.06, 0.244, 0.038)
HANDS = [EXAMPLE, (0.3, 1.0, 0.2), (0.05, 1.0, 0.04), (1.0, 1.0, 0.4)]


@pytest.mark.parametrize("hand", HANDS)
def test_what_it_promises_is_caught_without_bounce(hand: tuple[float, float, float]) -> None:
    half_palm, length, radius = hand
    starts = drawn_starts(sliding_centre(*hand), 8000, 4)
    codes = capture_all(closing_hand(half_palm, [length], radius), starts, restitution=0.0).codes
    assert (codes <= Outcome.CAGED.code).mean() > 0.9995


def test_the_disk_is_at_the_tip_when_the_hand_shuts() -> None:
    half_palm, length, radius = EXAMPLE
    angles = np.radians([0.0, 40.0, 80.0])
    turns = shut_angle(*EXAMPLE) - angles
    at = frictionless(turns, 1.0, sliding_reach(*EXAMPLE, angles), radius)
    assert at.distance == pytest.approx(length)
    assert half_palm + length * np.cos(shut_angle(*EXAMPLE)) == pytest.approx(radius)


def test_it_falls_short_of_what_does_not_bounce_by_little_and_exceeds_what_does() -> None:
    case = open_case("zero_g_example")[1]
    still = case.model_copy(update={"contact": case.contact.model_copy(update={"restitution": 0.0})})
    mine, inelastic, elastic = sliding_centre(*EXAMPLE).area, build_region(still).area, build_region(case).area
    assert 1e4 * mine == pytest.approx(476.8, abs=0.2)
    assert 0.95 < mine / inelastic < 1.0
    assert mine > 1.15 * elastic


def test_a_hand_that_never_shuts_about_the_disk_promises_nothing() -> None:
    assert sliding_centre(2.0, 1.0, 0.5).is_empty
