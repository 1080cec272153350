"""The same sweep on a Dask cluster: workers write to the shared folder themselves, only counts come back."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import islice

from palmar.errors import InputError, NotCoveredError
from palmar.models.sweep import Sweep
from palmar.studies.sweep.local import RATE_ROWS
from palmar.studies.sweep.shards import rate, run_shard

try:
    from distributed import Client, as_completed
except ImportError:
    raise NotCoveredError('--engine dask: needs the extra, pip install "palmar[dask]"') from None

RETRIES = 3
"""How often a shard is tried again if its worker dies."""
PATIENCE = "20s"
"""For the scheduler to answer."""


class OnDask:
    """An engine of the workers that a scheduler has."""

    def __init__(self, client: Client) -> None:
        self._client = client

    def rate(self, sweep: Sweep) -> float:
        """Rows a second of one worker."""
        found: float = self._client.submit(
            rate, sweep, min(sweep.rows, RATE_ROWS), pure=False, retries=RETRIES
        ).result()
        return found

    def run(
        self, sweep: Sweep, url: str, todo: Iterator[tuple[int, tuple[int, int]]]
    ) -> Iterator[tuple[int, int, float]]:
        """Shards as they are done, two for each thread of the workers under way."""
        under_way = as_completed(loop=self._client.loop)
        for shard, stretch in islice(todo, 2 * max(1, sum(self._client.nthreads().values()))):
            under_way.add(self._submit(sweep, url, shard, stretch))
        for done in under_way:
            found: tuple[int, int, float] = done.result()
            yield found
            for shard, stretch in islice(todo, 1):
                under_way.add(self._submit(sweep, url, shard, stretch))

    def _submit(self, sweep: Sweep, url: str, shard: int, stretch: tuple[int, int]) -> object:
        return self._client.submit(run_shard, sweep, url, shard, stretch, pure=False, retries=RETRIES)


@contextmanager
def dask_engine(address: str) -> Iterator[OnDask]:
    """The cluster whose scheduler listens at an address; raises InputError if none does, or it has another palmar."""
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError("--address", repr(address[:80]), f"no Dask scheduler answers: {error}") from None
    with client:
        try:
            yield OnDask(client)
        except RuntimeError as error:
            if "deserialization" not in str(error):
                raise
            told = "its scheduler and workers need the same palmar as here"
            raise InputError("--address", repr(address[:80]), told) from None
