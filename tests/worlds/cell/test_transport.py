"""Two peers on the loopback, without scouting: what one sends the other gets, checked and stamped."""

import time

import pytest

pytest.importorskip("zenoh", reason="needs the extra palmar[realtime]")

from palmar.models.cell_messages import Sighting
from palmar.worlds.cell.sighting_box import SightingBox
from palmar.worlds.cell.transport import Key, Mailbox, Sender, free_ports, open_session
from palmar.worlds.cell.wire import LARGEST, Frame, Ready


def frame(number: int, stamp: float) -> bytes:
    return Frame(number=number, sighting=Sighting(stamp, 0.5, 0.0, 0.03, 1e-3)).model_dump_json().encode()


def test_a_message_arrives_in_a_millisecond_and_rubbish_is_counted_and_dropped():
    ports = free_ports()
    with open_session(ports.plant) as one, open_session(None, [ports.plant]) as other:
        box = Mailbox(Ready).listen(one, Key.READY)
        sender, rubbish = Sender[Ready](other, Key.READY), other.declare_publisher(Key.READY.value)
        found = None
        for _ in range(100):
            sent = time.monotonic()
            sender.send(Ready(who="vision"))
            found = box.wait(0.05)
            if found is not None:
                break
        assert found == Ready(who="vision")
        box.take()
        for payload in (
            b"",
            b"{",
            b'{"who":"me"}',
            b'{"who":"vision","also":1}',
            b"\xff\xfe",
            b'{"who":"vision"}' + b" " * LARGEST,
        ):
            rubbish.put(payload)
        sent = time.monotonic()
        sender.send(Ready(who="controller"))
        until = sent + 5.0
        arrived: list[tuple[float, Ready]] = []
        while (not arrived or box.malformed < 6) and time.monotonic() < until:
            arrived += box.take()
            time.sleep(0.01)
        assert box.malformed == 6
        assert [each for _, each in arrived] == [Ready(who="controller")]
        assert sent < arrived[0][0] < until


def test_a_process_that_is_called_before_it_listens_is_reached_later():
    ports = free_ports()
    with open_session(None, [ports.plant]) as caller:
        sender = Sender[Ready](caller, Key.READY)
        with open_session(ports.plant) as late:
            box = Mailbox(Ready).listen(late, Key.READY)
            for _ in range(100):
                sender.send(Ready(who="vision"))
                if box.wait(0.05) is not None:
                    return
    raise AssertionError("never reached")


def test_waiting_gives_the_newest_and_nothing_after_its_time():
    box = Mailbox(Ready)
    assert box.wait(0.0) is None
    box.put(b'{"who":"vision"}')
    box.put(b'{"who":"controller"}')
    assert box.wait(0.0) == Ready(who="controller")
    assert box.take() == []


def test_lost_late_and_malformed_frames_are_counted():
    eye = SightingBox()
    for number, stamp in ((4, 1.00), (5, 1.03), (8, 1.10), (7, 1.07)):
        eye.box.put(frame(number, stamp))
    eye.box.put(b"{}")
    seen = eye.look(1.22)
    assert seen is not None
    assert seen.stamp_s == 1.10
    counts = eye.counts
    assert (counts.received, counts.stale, counts.dropped, counts.malformed) == (4, 1, 1, 1)
    assert eye.look(5.0) == seen
