"""Which reflex owns the hand, and what it does with it."""

from dataclasses import replace

import pytest

from palmar.behaviours.cell.reflexes import DWELL, FULL, ReflexState, reflex_step
from palmar.models.cell_messages import HandFelt, HandMode, HandOrder, Owner

TICK = 1e-3
OPEN = ReflexState((-0.4, -0.4, -0.4))
FREE = HandFelt(0.0, (False,) * 3, (0.0,) * 3, (False, False))
SHAPE = HandOrder(HandMode.SHAPE, (-0.4, -0.4, -0.4), rate=1.0, close_on_palm=True)
CLOSE = replace(SHAPE, mode=HandMode.CLOSE, close_on_palm=False)
HARD = replace(FREE, press=(0.7, 0.7, 0.7), touched=(True,) * 3)


def after(state: ReflexState, felt: HandFelt, order: HandOrder, ticks: int, stopped: bool = False) -> ReflexState:
    for _ in range(ticks):
        state = reflex_step(state, felt, order, stopped, TICK)
    return state


def test_a_higher_reflex_takes_the_hand_from_a_lower_one():
    palm = replace(FREE, palm=(True, False))
    assert reflex_step(OPEN, FREE, SHAPE, False, TICK).owner is Owner.BEHAVIOUR
    assert reflex_step(OPEN, palm, SHAPE, False, TICK).owner is Owner.PALM
    assert after(OPEN, HARD, CLOSE, 40).owner is Owner.GRIP
    gripped = after(OPEN, HARD, CLOSE, 40)
    assert reflex_step(gripped, replace(palm, overload=True), SHAPE, False, TICK).owner is Owner.OVERLOAD
    assert reflex_step(gripped, replace(palm, overload=True, dead=True), CLOSE, False, TICK).owner is Owner.SENSOR_FAULT
    assert reflex_step(gripped, replace(palm, overload=True, dead=True), CLOSE, True, TICK).owner is Owner.SAFE_STOP


def test_the_palm_closes_the_hand_for_good_although_the_bit_goes_again():
    closing = after(OPEN, replace(FREE, palm=(False, True)), SHAPE, 1)
    later = after(closing, FREE, SHAPE, 100)
    assert later.set_points == pytest.approx((-0.299,) * 3)
    assert (
        after(OPEN, replace(FREE, palm=(False, True)), replace(SHAPE, close_on_palm=False), 9).set_points == (-0.4,) * 3
    )


def test_a_grip_outlasts_an_impact_and_then_stays():
    short = after(OPEN, HARD, CLOSE, int(DWELL / TICK) - 1)
    assert not short.gripped
    assert not after(short, FREE, CLOSE, 1).gripped
    held = after(short, HARD, CLOSE, 2)
    assert held.gripped
    assert after(held, FREE, CLOSE, 500).set_points == held.set_points


def test_a_pressing_finger_waits_and_a_touching_one_goes_gently():
    felt = replace(FREE, press=(0.7, 0.3, 0.0))
    assert after(OPEN, felt, CLOSE, 100).set_points == pytest.approx((-0.4, -0.375, -0.3))


def test_nothing_moves_once_stopped():
    assert after(OPEN, FREE, CLOSE, 50, stopped=True).set_points == OPEN.set_points


def test_an_empty_hand_ends_closed():
    ended = after(OPEN, FREE, CLOSE, 2000)
    assert ended.at_end
    assert not ended.gripped
    assert ended.set_points == (FULL,) * 3
