"""Both closing kernels against the slow reference, which knows no closed form: outcomes and end poses of random cases."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from palmar.mechanics.pushing.closing_steps import carry
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.pressure_cells import leaned
from palmar.mechanics.pushing.slider import disk_slider, slider_body
from palmar.models.outcome import Outcome
from reference.closing_cases import Question, apart, by_events, by_reference, by_steps, questions
from reference.slow_closing import COARSE, close_hand
from reference.slow_model import Hand, Object, disk_support

SEED, CASES = 7, 36
AT_THE_EDGE = {14}
"""Fingers reach 90 degrees plus the friction angle just as an edge comes to lie flush: one holds, the other lets slip."""
HELD = ("structural", "frictional")
QUICK = replace(COARSE, most_steps=120_000)
"""More steps than a case that can be compared needs."""


@pytest.mark.parametrize(("number", "question"), [*enumerate(questions(CASES, SEED))])
def test_kernels_end_as_the_reference_does(number: int, question: Question) -> None:
    reference = by_reference(question, QUICK)
    for kernel in [by_steps(question), *([by_events(question)] if question.by_events else [])]:
        assert kernel.word == reference.word
        if reference.outcome in HELD and number not in AT_THE_EDGE:
            assert kernel.outcome == reference.outcome
            assert apart(kernel, reference, question.size) < 0.01


def test_a_hold_that_is_reached_in_a_rapid_turn_is_seen() -> None:
    """The way to the jam along the last twist is so short that its contacts still touch."""
    asked = questions(274, 99)
    assert [by_steps(asked[k]).outcome for k in (170, 273)] == ["frictional", "frictional"]


@pytest.mark.parametrize(
    ("offset", "friction", "start"),
    [
        ((0.2, 0.0), 0.0, (1.6, 0.9, 0.4)),
        ((0.2, 0.0), 0.5, (1.6, 0.9, 0.4)),
        ((0.1, -0.25), 0.5, (-0.4, 0.8, 2.0)),
        ((-0.3, 0.2), 0.3, (0.6, 0.7, -1.2)),
        ((0.0, 0.3), 0.7, (-1.9, 0.9, 0.9)),
        ((0.3, 0.0), 0.4, (2.2, 1.2, 3.0)),
    ],
)
@pytest.mark.parametrize("half_thickness", [0.0, 0.1])
def test_a_disk_pressed_off_its_centre_goes_as_the_reference_says(offset, friction, start, half_thickness) -> None:
    radius, (x, y, theta) = 0.5, start
    points, weights = disk_support(radius, 12)
    _, pressed, _ = leaned((points, weights, np.zeros(len(weights))), offset)
    hand = Hand(1.0, (2.0,), half_thickness)
    slow = close_hand(hand, Object(radius, points=points, weights=pressed), friction, start)
    slider = disk_slider(radius, 0.0, offset)
    assert slider.centre == pytest.approx(offset, abs=1e-12)
    body = slider_body(slider, friction)
    c, s = math.cos(theta), math.sin(theta)
    end, _ = carry(
        hand_motion(1.0, [2.0], half_thickness), body,
        x + c * offset[0] - s * offset[1], y + s * offset[0] + c * offset[1], theta,
    )  # fmt: skip
    c, s = math.cos(end.theta), math.sin(end.theta)
    centre = end.x - c * offset[0] + s * offset[1], end.y - s * offset[0] - c * offset[1]
    assert Outcome.from_code(end.code).value == slow.outcome
    assert np.abs(np.subtract((*centre, end.theta), slow.pose)).max() < 7e-3  # the kernel has 256 cells, 1e-3 with 2304
