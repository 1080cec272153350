"""One socket: what waits for a client is bounded, and never older than what it has been sent."""

import asyncio
import json

from palmar.faces.studio.job import Job
from palmar.faces.studio.kinds import Kind
from palmar.faces.studio.pool import Pool
from palmar.faces.studio.session import MOST_CHANNELS, MOST_UNSENT, Pace, Session


def question(session, number, kind=Kind.LOOK):
    return Job(session, kind, {"seq": number}, None, {}, number=number)


def test_parts_that_wait_are_replaced_by_newer_ones_and_older_ones_are_dropped():
    session = Session(None, Pool(2))
    for number, frame in ((1, "one"), (3, "three"), (2, "two")):
        session.part(question(session, number), "region exact", frame)
    session.part(question(session, 2), "drawing ", "drawing of two")
    assert list(session.unsent.values()) == ["three", "drawing of two"]
    assert session.size == len("three" + "drawing of two")


def test_nothing_is_computed_for_one_who_does_not_read():
    session = Session(None, Pool(2))
    session.part(question(session, 1), "region exact", "x" * MOST_UNSENT)
    assert not session.reads


def test_complaints_do_not_pile_up_nor_channels():
    session = Session(None, Pool(2))
    for _ in range(1000):
        session._complain("message: is not JSON")
    assert len(session.unsent) == 1
    told = []

    async def ask():
        for number in range(MOST_CHANNELS + 1):
            frame = {"id": "a", "seq": number, "kind": "look", "channel": str(number)}
            session._read(json.dumps(frame))
            told.append(None in session.unsent and "at most 4 channels" in session.unsent[None])

    asyncio.run(ask())
    assert told == [False] * MOST_CHANNELS + [True]


def test_a_flood_is_read_slowly():
    async def flood():
        pace, loop = Pace(100.0, 10.0), asyncio.get_running_loop()
        began = loop.time()
        for _ in range(30):
            await pace.turn()
        return loop.time() - began

    assert 0.15 < asyncio.run(flood()) < 1.0
