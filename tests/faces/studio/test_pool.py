"""Workers in turn: the newest question, no step for nobody, a limit on each."""

import asyncio
import sys

from palmar.faces.studio import kinds, pool, seat
from palmar.faces.studio.job import Job
from palmar.faces.studio.kinds import Kind, Lane, Step
from palmar.faces.studio.pool import Pool

STUB = """
import json, struct, sys, time
read, write = sys.stdin.buffer.read, sys.stdout.buffer.write
def say(data):
    write(struct.pack(">I", len(data)) + data); sys.stdout.buffer.flush()
say(b"r")
while head := read(4):
    job = json.loads(read(struct.unpack(">I", head)[0]))
    if "stop" in job:
        continue
    time.sleep(job["parameters"].get("sleep", 0.0))
    if job["parameters"].get("die"):
        sys.exit()
    if job["parameters"].get("leave"):
        say(b"l"); say(b"d"); time.sleep(0.1); sys.exit()
    say(b"pslot\\n" + json.dumps([job["head"]["seq"], job["step"]]).encode())
    say(b"d")
"""


class Asker:
    """A client that notes what it is told."""

    def __init__(self):
        self.parts, self.ends, self.reads, self.more = [], [], True, asyncio.Event()

    def part(self, job, slot, frame):
        if slot != "wait":
            self.parts.append(frame)
        self.more.set()

    def ended(self, job, error):
        self.ends.append((job.head["seq"], error))
        self.more.set()

    async def until(self, count):
        while len(self.ends) < count:
            self.more.clear()
            await asyncio.wait_for(self.more.wait(), 20.0)


def question(client, seq, kind=Kind.LOOK, **parameters):
    return Job(client, kind, {"seq": seq}, None, parameters, number=seq)


def with_pool(monkeypatch, scenario, workers=2, rest=0.05):
    """Run a scenario with workers that sleep instead of computing."""
    monkeypatch.setattr(seat, "COMMAND", (sys.executable, "-c", STUB))
    monkeypatch.setattr(seat, "PAUSE", 0.0)
    monkeypatch.setattr(pool, "CHECKED_EVERY", 0.02)
    short = (Step(Lane.QUICK, 5.0), Step(Lane.LONG, 5.0), Step(Lane.LONG, 5.0, rest))
    monkeypatch.setitem(kinds.STEPS, Kind.LOOK, short)
    monkeypatch.setitem(kinds.STEPS, Kind.PLAN, (Step(Lane.LONG, 0.5),))
    monkeypatch.setitem(kinds.STEPS, Kind.CASES, (Step(Lane.QUICK, 0.5),))

    async def run():
        running = Pool(workers)
        await running.start()
        try:
            return await scenario(running)
        finally:
            await running.stop()

    return asyncio.run(run())


def test_steps_follow_each_other_and_then_the_end(monkeypatch):
    async def scenario(pool):
        anna = Asker()
        pool.submit(question(anna, 1))
        await anna.until(1)
        return anna

    anna = with_pool(monkeypatch, scenario)
    assert anna.parts == ["[1, 0]", "[1, 1]", "[1, 2]"]
    assert anna.ends == [(1, None)]


def test_the_newest_question_wins_and_what_waits_is_dropped(monkeypatch):
    async def scenario(pool):
        anna = Asker()
        for seq in range(1, 21):
            pool.submit(question(anna, seq, sleep=0.02))
            await asyncio.sleep(0.005)
        await anna.until(1)
        return anna

    anna = with_pool(monkeypatch, scenario)
    assert anna.ends == [(20, None)]
    assert anna.parts[-1] == "[20, 2]"
    assert len(anna.parts) < 15


def test_of_a_question_that_something_newer_replaces_the_step_that_runs_is_the_last(monkeypatch):
    async def scenario(pool):
        anna = Asker()
        first, second = question(anna, 1, sleep=0.1), question(anna, 2)
        pool.submit(first)
        while not any(seat.job is first for seat in pool.seats):
            await asyncio.sleep(0.01)
        pool.submit(second)
        await anna.until(1)
        return anna

    anna = with_pool(monkeypatch, scenario)
    assert anna.parts == ["[1, 0]", "[2, 0]", "[2, 1]", "[2, 2]"]
    assert anna.ends == [(2, None)]


def test_a_slow_step_that_waits_for_rest_is_not_for_a_question_that_was_replaced(monkeypatch):
    async def scenario(pool):
        anna = Asker()
        pool.submit(question(anna, 1))
        while len(anna.parts) < 2 or not len(pool.turns[Lane.LONG]):
            await asyncio.sleep(0.005)
        pool.submit(question(anna, 2, sleep=0.2))
        return [job.head["seq"] for turns in pool.turns.values() for job in turns]

    assert 1 not in with_pool(monkeypatch, scenario, rest=60.0)


def test_a_step_over_its_limit_is_stopped_and_the_next_question_answered(monkeypatch):
    async def scenario(pool):
        anna = Asker()
        pool.submit(question(anna, 1, Kind.PLAN, sleep=60.0))
        await anna.until(1)
        pool.submit(question(anna, 2, Kind.PLAN))
        await anna.until(2)
        return anna.ends

    (_, error), good = with_pool(monkeypatch, scenario)
    assert "took longer than 0.5 s" in error
    assert good == (2, None)


def test_a_worker_that_dies_costs_one_answer(monkeypatch):
    async def scenario(pool):
        anna = Asker()
        pool.submit(question(anna, 1, Kind.PLAN, die=True))
        await anna.until(1)
        pool.submit(question(anna, 2, Kind.PLAN))
        await anna.until(2)
        return anna.ends

    assert with_pool(monkeypatch, scenario) == [(1, "the computation came to an unexpected end"), (2, None)]


def test_a_worker_that_ends_after_its_job_costs_nothing(monkeypatch):
    async def scenario(pool):
        anna = Asker()
        for seq in (1, 2, 3):
            pool.submit(question(anna, seq, Kind.PLAN, leave=True))
            await anna.until(seq)
        return anna.ends

    assert with_pool(monkeypatch, scenario) == [(1, None), (2, None), (3, None)]


def test_long_steps_leave_a_worker_to_quick_ones(monkeypatch):
    async def scenario(pool):
        slow, other = [Asker() for _ in range(4)], Asker()
        for each in slow:
            pool.submit(question(each, 1, Kind.PLAN, sleep=0.4))
        while not all(seat.ready for seat in pool.seats):
            await asyncio.sleep(0.01)
        at_work = sum(seat.job is not None for seat in pool.seats)
        pool.submit(question(other, 9, Kind.CASES))
        await other.until(1)
        return at_work, sum(len(each.ends) for each in slow)

    assert with_pool(monkeypatch, scenario, workers=3) == (2, 0)


def test_of_one_client_one_long_step_runs_at_a_time(monkeypatch):
    async def scenario(pool):
        greedy = Asker()
        for seq, channel in enumerate("abc"):
            pool.submit(Job(greedy, Kind.PLAN, {"seq": seq}, None, {"sleep": 0.05}, channel))
        most = 0
        while len(greedy.ends) < 3:
            most = max(most, sum(seat.job is not None for seat in pool.seats))
            await asyncio.sleep(0.01)
        return most

    assert with_pool(monkeypatch, scenario, workers=4) == 1


def test_nothing_is_computed_for_one_who_has_left_or_does_not_read(monkeypatch):
    async def scenario(pool):
        deaf, gone, anna = Asker(), Asker(), Asker()
        deaf.reads = False
        pool.submit(question(deaf, 1, Kind.CASES))
        pool.submit(question(gone, 2, Kind.CASES))
        pool.leave(gone)
        pool.submit(question(anna, 3, Kind.CASES))
        await anna.until(1)
        waiting = len(pool.turns[Lane.QUICK])
        deaf.reads = True
        await deaf.until(1)
        return waiting, gone.ends, deaf.ends

    assert with_pool(monkeypatch, scenario) == (1, [], [(1, None)])
