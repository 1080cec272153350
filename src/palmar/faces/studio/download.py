"""One wish for a file: a client of the pool that waits for a single answer."""

from __future__ import annotations

import asyncio

from palmar.faces.studio.job import Job
from palmar.faces.studio.kinds import Kind
from palmar.faces.studio.pool import Pool
from palmar.faces.studio.requests import FileRequest

File = tuple[str, bytes]


class Download:
    """Its answer is a name and bytes, or one line that says why there is none."""

    def __init__(self) -> None:
        self.answer: asyncio.Future[File | str] = asyncio.get_running_loop().create_future()

    @property
    def reads(self) -> bool:
        """Always."""
        return True

    def part(self, job: Job, slot: str, frame: str) -> None:
        """Files have no parts."""

    def file(self, job: Job, name: str, data: bytes) -> None:
        """The file."""
        self._answered((name, data))

    def ended(self, job: Job, error: str | None) -> None:
        """Without a file, or after it."""
        self._answered(error or "no file was made")

    def _answered(self, answer: File | str) -> None:
        if not self.answer.done():
            self.answer.set_result(answer)


async def download(pool: Pool, request: FileRequest) -> File | str:
    """The file asked for, or why there is none."""
    client = Download()
    given = {"what": request.what, "format": request.format, "parameters": request.parameters}
    try:
        pool.submit(Job(client, Kind.EXPORT, {"kind": Kind.EXPORT.value}, request.case, given))
        return await client.answer
    finally:
        pool.leave(client)
