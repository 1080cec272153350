"""Run a sweep into a folder: what is there already is kept, what is missing is shared out to an engine."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from time import perf_counter
from typing import Protocol

from palmar.errors import InputError
from palmar.models.sweep import Sweep
from palmar.studies.sweep.store import Manifest, Store

SHARD_SECONDS, MOST_SHARD_ROWS = 1.0, 250_000
"""How long a shard should take, at least half of it; and the most rows of one, which bounds a worker's memory."""


class Engine(Protocol):
    """What answers shards, in other processes."""

    def rate(self, sweep: Sweep) -> float:
        """Rows a second of one worker."""
        ...

    def run(
        self, sweep: Sweep, url: str, todo: Iterator[tuple[int, tuple[int, int]]]
    ) -> Iterator[tuple[int, int, float]]:
        """(Shard, its rows, seconds) of each as it is done, few under way at a time."""
        ...


@dataclass(frozen=True)
class Swept:
    """Rows and shards there are now, of these found already there, and the seconds it took."""

    rows: int
    shards: int
    found: int
    seconds: float


def run_sweep(sweep: Sweep, store: Store, engine: Engine, report: Callable[[int], None] | None = None) -> Swept:
    """Answer all rows that are not there; ``report`` is told how many rows are.

    Raises InputError if the folder holds another sweep.
    """
    began = perf_counter()
    manifest = store.manifest() or _begin(sweep, store, engine)
    if manifest.digest != sweep.digest:
        raise InputError("--out", repr(store.url[:80]), "holds a sweep of another specification; name a new folder")
    with store.alone():
        store.sweep_up()
        there = store.done()
        rows = sum(last - first for first, last in map(manifest.stretch, there))
        if report is not None:
            report(rows)
        todo = ((k, manifest.stretch(k)) for k in range(manifest.shards) if k not in there)
        for _, more, _ in engine.run(sweep, store.url, todo):
            rows += more
            if report is not None:
                report(rows)
    return Swept(rows, manifest.shards, len(there), perf_counter() - began)


def _begin(sweep: Sweep, store: Store, engine: Engine) -> Manifest:
    rows = int(min(max(engine.rate(sweep) * SHARD_SECONDS, 1), MOST_SHARD_ROWS, sweep.rows))
    manifest = Manifest(sweep.digest, sweep.rows, rows, sweep.command.value)
    store.begin(manifest)
    return manifest
