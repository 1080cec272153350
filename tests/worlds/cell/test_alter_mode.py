"""The arm's link: set-points are interpolated, a late reply stops the arm for good."""

import numpy as np
import pytest

from palmar.worlds.cell.alter_mode import DEADLINE, PERIOD, AlterMode

TICK = 1e-3
GOAL = np.arange(6.0)


def go(link: AlterMode, ticks: range) -> list[np.ndarray]:
    return [link.advance(k * TICK, TICK)[0].copy() for k in ticks]


def test_a_set_point_is_reached_one_period_after_its_reply():
    link = AlterMode(np.zeros(6))
    link.reply(0.0, 0.003, GOAL)
    points = go(link, range(40))
    assert points[2] == pytest.approx(np.zeros(6))
    assert points[3 + 13] == pytest.approx(GOAL / 2.0)
    assert points[3 + 28] == pytest.approx(GOAL)
    assert np.abs(np.diff(points, axis=0)).max() == pytest.approx(5.0 * TICK / PERIOD)


@pytest.mark.parametrize(("delay", "missed"), [(DEADLINE, 0), (DEADLINE + 1e-6, 1)])
def test_the_deadline_is_fifteen_milliseconds(delay, missed):
    link = AlterMode(np.zeros(6))
    link.reply(0.0, delay, GOAL)
    assert link.missed == missed
    assert link.interrupted == bool(missed)


def test_after_a_miss_the_arm_holds_whatever_comes_later():
    link = AlterMode(np.zeros(6))
    link.reply(0.0, 0.003, GOAL)
    go(link, range(20))
    link.reply(0.028, np.inf, None)
    assert go(link, range(20, 50))[-1] == pytest.approx(GOAL)
    link.reply(0.056, 0.003, 2.0 * GOAL)
    assert go(link, range(56, 120))[-1] == pytest.approx(GOAL)
    assert (link.asked, link.missed) == (3, 1)
