"""A sweep on this machine: one process for each processor, which end with the one that started them."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from itertools import islice
from multiprocessing import connection, get_context, parent_process
from threading import Thread

from palmar.models.sweep import Sweep
from palmar.studies.sweep.shards import rate, run_shard

RATE_ROWS = 60_000
"""The most rows tried to find out how fast they are answered."""


class Local:
    """An engine of ``workers`` processes."""

    def __init__(self, pool: ProcessPoolExecutor, workers: int) -> None:
        self._pool, self._workers = pool, workers

    def rate(self, sweep: Sweep) -> float:
        """Rows a second of one worker."""
        return self._pool.submit(rate, sweep, min(sweep.rows, RATE_ROWS)).result()

    def run(
        self, sweep: Sweep, url: str, todo: Iterator[tuple[int, tuple[int, int]]]
    ) -> Iterator[tuple[int, int, float]]:
        """Shards as they are done, two for each process under way."""
        under_way: set[Future[tuple[int, int, float]]] = set()
        while True:
            for shard, stretch in islice(todo, 2 * self._workers - len(under_way)):
                under_way.add(self._pool.submit(run_shard, sweep, url, shard, stretch))
            if not under_way:
                return
            done, under_way = wait(under_way, return_when=FIRST_COMPLETED)
            for each in done:
                yield each.result()


@contextmanager
def local_engine(workers: int | None = None) -> Iterator[Local]:
    """Processes for a sweep: as many as this one may use processors, or ``workers``."""
    number = workers or _processors()
    # A fresh interpreter for each process: one forked from threads may wait forever.
    pool = ProcessPoolExecutor(number, mp_context=get_context("spawn"), initializer=_end_with_parent)
    try:
        yield Local(pool, number)
    finally:
        pool.shutdown(cancel_futures=True)


def _processors() -> int:
    """How many this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _end_with_parent() -> None:
    """A worker whose parent was killed would wait for work for ever."""
    parent = parent_process()
    assert parent is not None

    def watch() -> None:
        connection.wait([parent.sentinel])
        os._exit(1)

    Thread(target=watch, daemon=True).start()
