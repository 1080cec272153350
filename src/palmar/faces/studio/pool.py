"""The workers, and who of those that wait is next."""

from __future__ import annotations

import asyncio
import time
from collections import Counter
from multiprocessing import cpu_count

from palmar.faces.studio.job import Client, Job
from palmar.faces.studio.kinds import Lane
from palmar.faces.studio.seat import Seat
from palmar.faces.studio.turns import Turns

CHECKED_EVERY = 0.25
"""Seconds between two looks at limits."""


def workers_here() -> int:
    """As many as there are processors, two at least, eight at most."""
    return min(max(cpu_count(), 2), 8)


class Pool:
    """Gives jobs to workers in turn: of each client one at a time in a lane, on each channel only the newest.

    Long steps never take the last worker.
    """

    def __init__(self, workers: int) -> None:
        self.seats = [Seat(self) for _ in range(max(workers, 2))]
        self.turns = {lane: Turns[Job]() for lane in Lane}
        self.running: Counter[tuple[Client, Lane]] = Counter()
        self._tasks: list[asyncio.Task[None]] = []

    async def start(self) -> None:
        """Start the workers; what is asked before they are ready waits."""
        self._tasks = [asyncio.create_task(each.live()) for each in self.seats]
        self._tasks.append(asyncio.create_task(self._look_after()))

    async def stop(self) -> None:
        """End them."""
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    def submit(self, job: Job) -> None:
        """Let a job wait in the place of what its client asked on that channel before.

        Of that, a step that runs is carried on with, for its answers come as often as they can; but not a slow one.
        """
        for turns in self.turns.values():
            turns.remove(job.client, job.key)
        for old in self._running(job.client):
            if old.key == job.key:
                old.superseded = True
                if old.now.rest:
                    self._stop(old)
        job.arrived = time.monotonic()
        if not any(seat.ready for seat in self.seats):
            job.tell_waiting("the studio is starting")
        self._wait(job)

    def leave(self, client: Client) -> None:
        """Forget a client and all it asked."""
        for turns in self.turns.values():
            turns.drop(client)
        for job in self._running(client):
            self._stop(job)

    def _running(self, client: Client) -> list[Job]:
        return [seat.job for seat in self.seats if seat.job is not None and seat.job.client is client]

    def _stop(self, job: Job) -> None:
        job.stopped = True
        for seat in self.seats:
            if seat.job is job:
                seat.stop()

    def free(self) -> None:
        """Give to every worker that is free what is next."""
        now = time.monotonic()
        long = sum(seat.job is not None and seat.lane is Lane.LONG for seat in self.seats)
        for seat in self.seats:
            if not seat.is_free:
                continue
            job = self.turns[Lane.QUICK].take(lambda job: self._fits(job, now))
            if job is None and long + 1 < len(self.seats):
                job = self.turns[Lane.LONG].take(lambda job: self._fits(job, now))
            if job is None:
                return
            long += job.now.lane is Lane.LONG
            self.running[job.client, job.now.lane] += 1
            seat.give(job)

    def step_ended(self, job: Job, error: str | None) -> None:
        """Go on to the next step, if there is one and it is wanted."""
        lane = job.now.lane
        self.running[job.client, lane] -= 1
        if not self.running[job.client, lane]:
            del self.running[job.client, lane]
        if not job.is_wanted:
            return
        if error is not None or job.is_last:
            job.client.ended(job, error)
            return
        job.step += 1
        self._wait(job)

    def _wait(self, job: Job) -> None:
        self.turns[job.now.lane].put(job.client, job.key, job)
        rest = job.arrived + job.now.rest - time.monotonic()
        if rest > 0.0:
            asyncio.get_running_loop().call_later(rest + 1e-3, self.free)
        self.free()

    def _fits(self, job: Job, now: float) -> bool:
        alone = not self.running[job.client, job.now.lane]
        return alone and job.client.reads and now >= job.arrived + job.now.rest

    async def _look_after(self) -> None:
        """Keep limits, and give work to those that have begun to read again."""
        while True:
            await asyncio.sleep(CHECKED_EVERY)
            now = time.monotonic()
            waits = any(job.client.reads and now >= job.arrived + job.now.rest for job in self.turns[Lane.LONG])
            for seat in self.seats:
                seat.check(waits)
            self.free()
