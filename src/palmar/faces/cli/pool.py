"""Work on all processors, with a bar of what is done on stderr."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import cpu_count, get_context
from typing import Protocol

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.text import Text

from palmar.mechanics.batch import allot


@contextmanager
def processes(most: int | None = None) -> Iterator[Executor]:
    """One process for each processor, ``most`` at most; a process starts with its first task."""
    # A fresh interpreter for each process: one forked from threads may wait forever.
    pool = ProcessPoolExecutor(
        min(cpu_count(), most or 1_000_000), mp_context=get_context("spawn"), initializer=allot, initargs=(1,)
    )
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


class Count(Protocol):
    """How many are done, and of how many if that changes."""

    def __call__(self, done: int, whole: int | None = None) -> None:
        """Tell."""
        ...


@contextmanager
def counting(whole: int, things: str, done: int = 0) -> Iterator[Count]:
    """A bar with rate and time left, on a terminal; it is told how many are done, and of how many if that changes."""
    with _bar(things) as bar:
        task = bar.add_task(things, total=whole, completed=done)

        def report(done: int, whole: int | None = None) -> None:
            bar.update(task, completed=done, total=whole)

        yield report


def _bar(things: str) -> Progress:
    """On stderr, and nothing where that is no terminal."""
    console = Console(stderr=True)
    columns = (
        TextColumn("palmar:"), BarColumn(), MofNCompleteColumn(), TextColumn(things), _Rate(), TimeElapsedColumn(),
        TextColumn("left"), TimeRemainingColumn(),
    )  # fmt: skip
    return Progress(*columns, console=console, disable=not console.is_terminal)


class _Rate(ProgressColumn):
    """So many a second."""

    def render(self, task: Task) -> Text:
        """The column's text."""
        return Text("" if task.speed is None else f"{task.speed:.3g}/s")
