"""What counts against a worker's limit."""

import numba

from palmar.faces.studio.compiling import on_compiling
from palmar.faces.studio.framing import Tag
from palmar.faces.studio.job import Job
from palmar.faces.studio.kinds import STEPS, Kind
from palmar.faces.studio.seat import COMPILING_SECONDS, PATIENCE, Seat

LIMIT = STEPS[Kind.CASES][0].seconds


class Stub:
    """A process and its input, a watcher, a client, and a clock."""

    def __init__(self):
        self.now, self.killed, self.ends, self.parts = 0.0, 0, [], []
        self.stdin = self
        self.seat = Seat(self, lambda: self.now)
        self.seat.process, self.seat.ready = self, True
        self.job = Job(self, Kind.CASES, {"seq": 1}, None, {})
        self.seat.give(self.job)

    def write(self, data): ...

    def free(self): ...

    def kill(self):
        self.killed += 1

    def part(self, job, slot, frame):
        self.parts.append(slot)

    def step_ended(self, job, error):
        self.ends.append(error)

    def at(self, now, *, others_wait=False):
        self.now = now
        self.seat.check(others_wait)
        return self.killed > 0


def test_a_worker_over_its_limit_is_killed():
    stub = Stub()
    assert not stub.at(LIMIT - 0.1)
    assert stub.at(LIMIT + 0.1)


def test_time_in_which_kernels_are_compiled_does_not_count_but_has_a_limit_too():
    stub = Stub()
    stub.seat._heard(Tag.COMPILING, b"")
    assert stub.parts == ["wait"]
    assert not stub.at(COMPILING_SECONDS - 1.0)
    stub.seat._heard(Tag.COMPILED, b"")
    assert not stub.at(COMPILING_SECONDS - 1.0 + LIMIT - 0.1)
    stub.seat._heard(Tag.COMPILING, b"")
    assert stub.at(2.0 * COMPILING_SECONDS + LIMIT)


def test_work_that_nobody_wants_goes_on_until_others_wait():
    stub = Stub()
    stub.job.superseded = True
    assert not stub.at(PATIENCE + 0.1)
    assert stub.at(PATIENCE + 0.1, others_wait=True)


def test_compilation_is_noticed():
    told = []
    on_compiling(told.append)
    assert numba.njit(lambda x: x + 1)(1) == 2
    assert told == [True, False]
