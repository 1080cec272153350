"""A wall across the hand's way: against the slow reference, which knows walls in its own way, and limits known on paper."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from palmar.mechanics.pushing.closing_events import HALTS
from palmar.mechanics.pushing.closing_steps import carry, carry_all, carry_halting
from palmar.mechanics.pushing.hand_pose import MOST_ROWS, MOVING, hand_motion, held_back, place_links
from palmar.mechanics.pushing.polygon_contacts import disk_body
from palmar.models.outcome import Outcome
from reference.closing_cases import Question, apart, before_a_wall, by_reference, by_steps, questions
from reference.slow_closing import COARSE

LENGTH, HALF_PALM, RADIUS = 0.244, 0.06, 0.038
HELD = ("structural", "frictional")
QUICK = replace(COARSE, most_steps=60_000)
CASES = 14
TOO_SLOW = {1, 2, 6, 11}
"""The reference does not come to an end within so many steps."""


def asked(number: int, seed: int) -> list[Question]:
    """Random hands before walls, half of them on the move."""
    rng = np.random.default_rng(seed + 1000)
    walled = [before_a_wall(each, rng) for each in questions(number, seed)]
    return [replace(each, speed=float(rng.choice([0.0, rng.uniform(0.0, 0.5)]))) for each in walled]


@pytest.mark.parametrize(
    ("number", "question"), [each for each in enumerate(asked(CASES, 2)) if each[0] not in TOO_SLOW]
)
def test_the_kernel_ends_as_the_reference_does(number: int, question: Question) -> None:
    reference, kernel = by_reference(question, QUICK), by_steps(question)
    assert kernel.word == reference.word
    if reference.outcome in HELD:
        assert apart(kernel, reference, question.size) < 0.01


def test_a_wall_out_of_reach_changes_nothing() -> None:
    motion, body = hand_motion(HALF_PALM, [LENGTH]), disk_body(RADIUS, 0.4)
    rng = np.random.default_rng(3)
    starts = rng.uniform([-0.25, 0.04], [0.25, 0.25], (300, 2))
    codes, ends, _ = carry_all(motion, body, starts)
    others, poses, _ = carry_all(motion._replace(wall=3.0), body, starts)
    assert (codes == others).all()
    caught = codes <= Outcome.CAGED.code
    assert np.abs(ends - poses)[caught].max() < 1e-6


@pytest.mark.parametrize("wall", [0.05, 0.2, 0.3])
def test_the_hand_gives_way_by_as_much_as_the_fingers_reach_too_far(wall: float) -> None:
    motion, h = hand_motion(HALF_PALM, [0.137, 0.107], 0.0125, ratios=[0.4])._replace(wall=wall), 0.0125
    rows, step = np.zeros((MOST_ROWS, 8)), 1e-6
    for psi in np.linspace(0.05, 2.2, 12):
        place_links(motion, psi, MOVING, MOVING, rows)
        tips = rows[1:5, [1, 3]].max() + h
        assert tips <= wall + 1e-12
        assert rows[0, 1] == 0.0 or tips == pytest.approx(wall, abs=1e-12)
        ahead, rate = held_back(motion, psi, MOVING, MOVING)
        later, _ = held_back(motion, psi + step, MOVING, MOVING)
        assert rate == pytest.approx((later - ahead) / step, abs=1e-5)


def test_a_finger_pushes_a_disk_along_the_wall_as_far_as_it_leans() -> None:
    """Without friction y stays, and the link at psi touches where -(x - D) sin psi + y cos psi = R."""
    wall, stop = 0.7, np.radians(85.0)
    motion = hand_motion(HALF_PALM, [0.69], first=np.radians(60.0))._replace(wall=wall, last=stop)
    _, ends, _ = carry_all(motion, disk_body(RADIUS, 0.0), np.array([[0.2, wall - RADIUS]]), 1e-9)
    assert ends[0, 1] == pytest.approx(wall - RADIUS, abs=1e-7)
    assert ends[0, 0] == pytest.approx(HALF_PALM + (ends[0, 1] * np.cos(stop) - RADIUS) / np.sin(stop), abs=1e-7)


def test_an_arm_that_presses_the_object_on_the_wall_is_halted_and_the_fingers_go_on() -> None:
    wall = 0.3
    motion = hand_motion(HALF_PALM, [LENGTH])._replace(wall=wall, vy=1.0)
    codes, ends, _, halts = carry_halting(motion, disk_body(RADIUS, 0.3), np.array([[0.02, wall - RADIUS]]))
    assert halts[0] == pytest.approx(wall - 2.0 * RADIUS, abs=1e-6)
    assert Outcome.from_code(int(codes[0])).caught
    assert ends[0, 1] <= wall - RADIUS + 1e-6
    _, log = carry(motion, disk_body(RADIUS, 0.3), 0.02, wall - RADIUS, events=50)
    assert HALTS in log[:, 1]


def test_what_the_wall_does_is_no_part_of_a_hold() -> None:
    """A finger that wedges a disk against the wall has not caught it."""
    wall = 0.25
    motion = hand_motion(HALF_PALM, [LENGTH], first=np.radians(30.0))._replace(wall=wall)
    codes, ends, _ = carry_all(motion, disk_body(RADIUS, 0.9), np.array([[0.18, wall - RADIUS]]))
    assert Outcome.from_code(int(codes[0])) is Outcome.JAMMED
    assert ends[0, 3] < np.radians(90.0)
