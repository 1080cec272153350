"""A connection that ends with its session, whether or not the other side takes what was sent."""

from __future__ import annotations

import asyncio

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

LAST_WORDS = 1.0
"""Seconds in which what is under way may still be taken."""


class LeavingProtocol(WebSocketsSansIOProtocol):
    """Uvicorn closes when all is sent, which to a client that never reads it never is: its buffers would stay for good."""

    async def run_asgi(self) -> None:
        """Serve the socket, and then be gone."""
        await super().run_asgi()
        asyncio.get_running_loop().call_later(LAST_WORDS, self.transport.abort)
