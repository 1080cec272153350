"""A reply counts for its own request and within 15 ms; what is late or never comes is missed, once."""

from math import inf

import numpy as np
import pytest

from palmar.models.cell_messages import CellOrder, HandMode, HandOrder
from palmar.worlds.cell.exchange import Answer, Exchange
from palmar.worlds.cell.pace import SLIP, Pace
from palmar.worlds.cell.wire import Reply, Sightings


def reply(number: int) -> Reply:
    order = CellOrder(np.eye(4), HandOrder(HandMode.SHAPE, (0.0,) * 3), "look")
    return Reply(number=number, order=order, approaches=0, sightings=Sightings())


def test_a_reply_in_time_is_taken_with_its_delay():
    exchange = Exchange()
    assert exchange.ask(1.0) == 1
    assert exchange.settle([], 1.004) is None
    found = reply(1)
    answer = exchange.settle([(1.005, found)], 1.006)
    assert answer == Answer(pytest.approx(0.005), found)
    assert exchange.settle([], 9.0) is None


@pytest.mark.parametrize(("delay", "taken"), [(0.0149, True), (0.0151, False)])
def test_what_counts_is_when_it_arrived_and_not_when_it_is_read(delay, taken):
    exchange = Exchange()
    exchange.ask(0.0)
    answer = exchange.settle([(delay, reply(1))], 0.5)
    assert (answer.reply is not None) == taken
    assert answer.delay == delay


def test_silence_is_missed_once():
    exchange = Exchange()
    exchange.ask(0.0)
    assert exchange.settle([], 0.015) is None
    assert exchange.settle([], 0.0151) == Answer(inf, None)
    assert exchange.settle([], 0.0161) is None


def test_a_reply_to_an_earlier_request_or_to_none_is_not_taken():
    exchange = Exchange()
    exchange.ask(0.0)
    exchange.ask(0.028)
    assert exchange.settle([(0.029, reply(1))], 0.030) is None
    assert exchange.settle([(0.031, reply(2))], 0.032).reply is not None
    assert exchange.settle([(0.033, reply(2))], 0.034) is None
    assert exchange.outdated == 2


def test_ticks_keep_their_plan_and_only_long_delays_put_it_off():
    now, pauses = [0.0], []

    def pause(seconds: float) -> None:
        pauses.append(seconds)
        now[0] += seconds + 1e-4

    pace = Pace(1e-3, 0.0, clock=lambda: now[0], pause=pause)
    begun = []
    for k in range(40):
        begun.append(pace.wait())
        now[0] += {10: 0.003, 20: 0.030}.get(k, 2e-4)
    assert begun[9] == pytest.approx(9.1e-3)
    assert begun[15] == pytest.approx(15.1e-3), "3 ms are made good"
    assert begun[21] == pytest.approx(20.1e-3 + 0.030)
    assert begun[39] - begun[21] == pytest.approx(18.1e-3, abs=1e-6), "30 ms are not"
    assert pace.slipped == pytest.approx(0.030 - 0.9e-3)
    assert max(pace.late) > SLIP
    assert len(pace.late) == 40
