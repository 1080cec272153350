"""A connection ends with its session."""

import asyncio
import socket

import pytest
import uvicorn
from websockets.asyncio.client import connect

from palmar.faces.studio import leaving
from palmar.faces.studio.leaving import LeavingProtocol

MUCH = "x" * 2**20


async def talk_on(_, receive, send):
    """Send until the other side takes no more, then give up."""
    await receive()
    await send({"type": "websocket.accept"})
    try:
        async with asyncio.timeout(0.2):
            while True:
                await send({"type": "websocket.send", "text": MUCH})
    except TimeoutError:
        return


async def connections_left(seconds):
    listener = socket.create_server(("127.0.0.1", 0))
    config = uvicorn.Config(
        talk_on, ws=LeavingProtocol, lifespan="off", log_level="error", ws_per_message_deflate=False
    )
    server = uvicorn.Server(config)
    serving = asyncio.create_task(server.serve(sockets=[listener]))
    while not server.started:
        await asyncio.sleep(0.01)
    async with connect(f"ws://127.0.0.1:{listener.getsockname()[1]}/", max_queue=1, max_size=None, close_timeout=0.1):
        await asyncio.sleep(seconds)
        left = len(server.server_state.connections)
    server.should_exit = server.force_exit = True
    await serving
    return left


@pytest.mark.parametrize(("last_words", "left"), [(0.1, 0), (60.0, 1)])
def test_a_client_that_never_reads_is_gone_soon_after_it_was_left(monkeypatch, last_words, left):
    monkeypatch.setattr(leaving, "LAST_WORDS", last_words)
    assert asyncio.run(connections_left(1.0)) == left
