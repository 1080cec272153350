"""A batch of independent rows in parts, each on a thread: kernels run without the interpreter's lock."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from multiprocessing import cpu_count

_ALLOTTED: ContextVar[int | None] = ContextVar("allotted", default=None)


def allot(count: int) -> None:
    """Let batches that are begun from here on take so many threads, instead of one for each processor."""
    _ALLOTTED.set(count)


@contextmanager
def allotted(count: int) -> Iterator[None]:
    """As ``allot``, for a while."""
    before = _ALLOTTED.set(count)
    try:
        yield
    finally:
        _ALLOTTED.reset(before)


def in_parts(part: Callable[[slice], None], rows: int, size: int, threads: int | None = None) -> None:
    """Call ``part`` with slices of at most ``size`` of so many rows; the result must not depend on their order."""
    slices = [slice(first, min(first + size, rows)) for first in range(0, rows, size)]
    most = min(threads or _ALLOTTED.get() or cpu_count(), len(slices))
    if most <= 1:
        for each in slices:
            part(each)
        return
    with ThreadPoolExecutor(most) as pool:
        list(pool.map(part, slices))
