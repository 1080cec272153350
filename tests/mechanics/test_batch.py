"""Batches in parts."""

import threading
from contextlib import suppress

import pytest

from palmar.mechanics import batch
from palmar.mechanics.batch import allot, allotted, in_parts


def threads_of(rows, size, threads=None):
    """(slices in order, names of the threads that worked); two threads wait for each other."""
    seen, names, both = [], set(), threading.Barrier(2, timeout=0.2)

    def part(some):
        seen.append(some)
        names.add(threading.current_thread().name)
        with suppress(threading.BrokenBarrierError):
            both.wait()

    in_parts(part, rows, size, threads)
    return sorted(seen, key=lambda each: each.start), names


def test_every_row_is_in_one_part():
    slices, _ = threads_of(10, 4)
    assert slices == [slice(0, 4), slice(4, 8), slice(8, 10)]
    assert threads_of(0, 4)[0] == []


@pytest.mark.parametrize(("told", "allowed", "count"), [(None, None, 2), (None, 1, 1), (1, 2, 1), (2, 1, 2)])
def test_threads_are_those_asked_for_or_allotted_or_one_a_processor(monkeypatch, told, allowed, count):
    monkeypatch.setattr(batch, "cpu_count", lambda: 2)
    if allowed is None:
        assert len(threads_of(8, 4, told)[1]) == count
    else:
        with allotted(allowed):
            assert len(threads_of(8, 4, told)[1]) == count
        assert len(threads_of(8, 4)[1]) == 2


def test_what_is_allotted_stays_in_its_thread(monkeypatch):
    monkeypatch.setattr(batch, "cpu_count", lambda: 2)

    def alone():
        allot(1)
        found.append(len(threads_of(8, 4)[1]))

    found = []
    worker = threading.Thread(target=alone)
    worker.start()
    worker.join()
    assert found == [1]
    assert len(threads_of(8, 4)[1]) == 2
