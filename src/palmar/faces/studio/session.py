"""One browser's socket: reads questions, sends parts. Nothing of it outlives the socket."""

from __future__ import annotations

import asyncio
import json
import time
from contextlib import suppress

from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from palmar.errors import InputError
from palmar.faces.cli.printing import one_line
from palmar.faces.studio.hello import hello
from palmar.faces.studio.job import Job
from palmar.faces.studio.kinds import Kind
from palmar.faces.studio.pool import Pool
from palmar.faces.studio.requests import Request, read_request

Slot = tuple[Kind, str, str] | None
"""Kind, channel, and the page's slot; None for complaints that belong to no question."""
MOST_CHANNELS = 4
"""Of each kind."""
MOST_UNSENT = 4 * 2**20
"""Characters that wait for a client that does not read; with more, nothing is computed for it."""
SLOWEST_SEND = 15.0
"""Seconds after which a client that takes nothing is left."""
LONGEST_FAREWELL = 0.5
"""Seconds for saying that it is left."""
RATE, BURST = 240.0, 480.0
"""Messages a second that are read, and at once."""


class Session:
    """One client of the pool."""

    def __init__(self, socket: WebSocket, pool: Pool) -> None:
        self.socket, self.pool = socket, pool
        self.unsent: dict[Slot, str] = {}
        self.newest: dict[Slot, int] = {}
        self.size = self.count = 0
        self.some = asyncio.Event()
        self.channels: set[tuple[Kind, str]] = set()
        self.pace = Pace(RATE, BURST)

    async def run(self) -> None:
        """From the greeting until either side leaves."""
        await self.socket.accept()
        sender = asyncio.create_task(self._send_all())
        reader = asyncio.create_task(self._read_all())
        try:
            await asyncio.wait((sender, reader), return_when=asyncio.FIRST_COMPLETED)
        finally:
            self.pool.leave(self)
            for task in (sender, reader):
                task.cancel()
            await asyncio.gather(sender, reader, return_exceptions=True)
        if self.socket.application_state is WebSocketState.CONNECTED:
            await _close(self.socket)

    @property
    def reads(self) -> bool:
        """Whether what it was sent before is mostly gone."""
        return self.size < MOST_UNSENT

    def part(self, job: Job, slot: str, frame: str) -> None:
        """Send a part in its turn, unless its slot has had one for a newer question."""
        place = (*job.key, slot)
        if self.newest.get(place, 0) <= job.number:
            self.newest[place] = job.number
            self._put(place, frame)

    def file(self, job: Job, name: str, data: bytes) -> None:
        """Files do not go over the socket."""

    def ended(self, job: Job, error: str | None) -> None:
        """Say that nothing more will come, and why if it is an error."""
        end = {"part": "end", "ms": round(1e3 * job.spent, 3)} if error is None else {"error": error}
        self._put((*job.key, "end"), json.dumps({**job.head, **end, "last": True}))

    async def _read_all(self) -> None:
        while True:
            await self.pace.turn()
            message = await self.socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            self._read(message.get("text"))

    def _read(self, text: str | None) -> None:
        """Take one frame, None for a binary one."""
        try:
            if text is None:
                raise InputError("message", None, "must be text, not binary")
            self._asked(read_request(text))
        except InputError as error:
            self._complain(one_line(str(error)))

    def _asked(self, request: Request) -> None:
        self.count += 1
        job = Job(self, request.kind, request.head, request.case, request.parameters, request.channel, self.count)
        if job.key not in self.channels:
            if sum(kind is request.kind for kind, _ in self.channels) >= MOST_CHANNELS:
                raise InputError("channel", None, f"at most {MOST_CHANNELS} channels of one kind")
            self.channels.add(job.key)
        self.pool.submit(job)

    def _complain(self, words: str) -> None:
        """About something that cannot be read; the client is told of the last such thing if it reads slowly."""
        nothing = dict.fromkeys(("id", "seq", "kind", "channel"))
        self._put(None, json.dumps({**nothing, "error": words, "last": True}))

    def _put(self, place: Slot, frame: str) -> None:
        """Let a frame wait to be sent, instead of an older one for the same slot."""
        self.size += len(frame) - len(self.unsent.get(place, ""))
        self.unsent[place] = frame
        self.some.set()

    async def _send_all(self) -> None:
        """In the order in which they came."""
        try:
            await self._send(json.dumps(hello()))
            while True:
                await self.some.wait()
                self.some.clear()
                while self.unsent:
                    frame = self.unsent.pop(next(iter(self.unsent)))
                    self.size -= len(frame)
                    await self._send(frame)
        except (TimeoutError, WebSocketDisconnect, RuntimeError):
            return  # the client has gone, or takes nothing

    async def _send(self, frame: str) -> None:
        async with asyncio.timeout(SLOWEST_SEND):
            await self.socket.send_text(frame)


class Pace:
    """Tokens that come at a rate and are kept up to a number; one is taken each turn."""

    def __init__(self, rate: float, most: float) -> None:
        self.rate, self.most, self.kept, self.seen = rate, most, most, time.monotonic()

    async def turn(self) -> None:
        """Wait for a token: whoever sends faster is read more slowly."""
        now = time.monotonic()
        self.kept = min(self.most, self.kept + self.rate * (now - self.seen)) - 1.0
        self.seen = now
        if self.kept < 0.0:
            await asyncio.sleep(-self.kept / self.rate)


async def _close(socket: WebSocket, code: int = 1008) -> None:
    """Close from this side; the other may be quicker, or take nothing any more."""
    with suppress(RuntimeError, TimeoutError, WebSocketDisconnect):
        async with asyncio.timeout(LONGEST_FAREWELL):
            await socket.close(code)
