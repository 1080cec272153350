"""A worker process as the server sees it: started, given one job at a time, watched, killed and started anew."""

from __future__ import annotations

import asyncio
import sys
import time
from collections.abc import Callable
from typing import Protocol

from palmar.faces.studio.framing import LENGTH, Tag
from palmar.faces.studio.job import Job, stop_message
from palmar.faces.studio.kinds import Lane

COMMAND = (sys.executable, "-P", "-m", "palmar.faces.studio.worker")
COMPILING_SECONDS = 900.0
"""A limit does not count the time in which kernels are compiled, up to this."""
PATIENCE = 2.0
"""A job that nobody wants may go on for so long (s) where others wait."""
PAUSE = 1.0
"""Between the end of a worker that never was ready and the next one (s)."""


class Watcher(Protocol):
    """Who is told what a worker does."""

    def free(self) -> None:
        """Some worker can take a job."""
        ...

    def step_ended(self, job: Job, error: str | None) -> None:
        """A step is over."""
        ...


class Seat:
    """A place for one worker."""

    def __init__(self, watcher: Watcher, clock: Callable[[], float] = time.monotonic) -> None:
        self.watcher, self.clock = watcher, clock
        self.job: Job | None = None
        self.lane = Lane.QUICK
        self.number = 0
        self.ready = self.lived = self.compiling = False
        self.began = self.compiling_since = 0.0
        self.why = ""
        self.process: asyncio.subprocess.Process | None = None

    @property
    def is_free(self) -> bool:
        """Whether it can take a job."""
        return self.ready and self.job is None

    async def live(self) -> None:
        """Keep a worker on the seat until cancelled."""
        while True:
            self.process = await asyncio.create_subprocess_exec(
                *COMMAND, stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE
            )
            try:
                await self._listen(self.process)
            except asyncio.CancelledError:
                self.process.kill()
                raise
            finally:
                self.ready = self.compiling = False
                await self.process.communicate()
            self._ended(self.why or "the computation came to an unexpected end")
            if not self.lived:
                await asyncio.sleep(PAUSE)
            self.why, self.lived = "", False

    def give(self, job: Job) -> None:
        """Let it work on a step."""
        assert self.process is not None and self.process.stdin is not None
        self.job, self.lane, self.began, self.number = job, job.now.lane, self.clock(), self.number + 1
        self.process.stdin.write(job.message(self.number))

    def stop(self) -> None:
        """The job is not wanted any more: it ends at its next part."""
        if self.process is not None and self.process.stdin is not None and self.ready:
            self.process.stdin.write(stop_message(self.number))

    def check(self, others_wait: bool) -> None:
        """Kill a worker that is over its limit, or that works for nobody while others wait."""
        if self.job is None or self.process is None:
            return
        now = self.clock()
        if self.compiling and now - self.compiling_since < COMPILING_SECONDS:
            return
        spent, limit = now - self.began, self.job.now.seconds
        if self.compiling or spent > limit:
            self._kill(f"took longer than {limit:g} s and was stopped; the command line has no such limit")
        elif not self.job.is_wanted and others_wait and spent > PATIENCE:
            self._kill("is not wanted any more")

    def _kill(self, why: str) -> None:
        assert self.process is not None
        self.why = why
        self.process.kill()

    async def _listen(self, process: asyncio.subprocess.Process) -> None:
        assert process.stdout is not None
        while True:
            try:
                size = LENGTH.unpack(await process.stdout.readexactly(LENGTH.size))[0]
                message = await process.stdout.readexactly(size)
            except asyncio.IncompleteReadError:
                return
            self._heard(Tag(message[:1]), message[1:])

    def _heard(self, tag: Tag, data: bytes) -> None:
        job = self.job
        if tag in (Tag.COMPILING, Tag.COMPILED):
            self._compiles(tag is Tag.COMPILING)
        elif tag is Tag.READY:
            self.ready = self.lived = True
            self.watcher.free()
        elif tag is Tag.LEAVING:
            self.ready = False
        elif job is not None and tag is Tag.PART and not job.stopped:
            slot, _, frame = data.partition(b"\n")
            job.client.part(job, slot.decode(), frame.decode())
        elif job is not None and tag is Tag.FILE and not job.stopped:
            name, _, content = data.partition(b"\n")
            job.client.file(job, name.decode(), content)
        elif tag in (Tag.DONE, Tag.ERROR):
            self._ended(data.decode() if tag is Tag.ERROR else None)

    def _compiles(self, begins: bool) -> None:
        now = self.clock()
        if begins:
            self.compiling_since = now
            if self.job is not None:
                self.job.tell_waiting("kernels are being compiled, once after installation")
        else:
            self.began += now - self.compiling_since
        self.compiling = begins

    def _ended(self, error: str | None) -> None:
        job, self.job = self.job, None
        if job is not None:
            job.spent += self.clock() - self.began
            self.watcher.step_ended(job, error)
        self.watcher.free()
