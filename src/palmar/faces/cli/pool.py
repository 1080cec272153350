"""Work on all processors, with a count of what is done on stderr."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from os import cpu_count


@contextmanager
def processes(most: int | None = None) -> Iterator[Executor]:
    """One process for each processor, ``most`` at most; a process starts with its first task."""
    # A fresh interpreter for each process: one forked from threads may wait forever.
    pool = ProcessPoolExecutor(min(cpu_count() or 1, most or 1_000_000), mp_context=get_context("spawn"))
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def counting(whole: int | None, things: str) -> Iterator[Callable[[int], None] | None]:
    """What shows how many are done, on a terminal; None elsewhere."""
    if not sys.stderr.isatty():
        yield None
        return

    def report(done: int) -> None:
        share = "" if not whole else f" of {whole}"
        print(f"\rpalmar: {done}{share} {things}", end="", file=sys.stderr, flush=True)

    try:
        yield report
    finally:
        print(file=sys.stderr)
