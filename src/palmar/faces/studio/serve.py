"""Bind, say where, serve until interrupted."""

from __future__ import annotations

import errno
import socket
import sys
import threading
import webbrowser
from dataclasses import dataclass
from ipaddress import ip_address
from urllib.parse import quote

import uvicorn

from palmar.errors import InputError, OutputError
from palmar.faces.studio.app import make_app
from palmar.faces.studio.guard import Door
from palmar.faces.studio.leaving import LeavingProtocol
from palmar.faces.studio.pool import Pool, workers_here
from palmar.faces.studio.requests import LARGEST_MESSAGE

SHORTEST_TOKEN = 16
LOOPBACK = "127.0.0.1"
MOST_CONNECTIONS = 256
GRACE = 5
"""Seconds for open pages to leave at the end."""


@dataclass(frozen=True)
class Address:
    """Where to listen; ``token`` None: to anyone on this machine."""

    host: str
    port: int
    token: str | None


def serve(address: Address, *, browser: bool) -> None:
    """Serve until interrupted; the address is the first line on standard output.

    Raises InputError where the address is not allowed, OutputError where it is taken.
    """
    _check(address)
    listener = _bound(address)
    url = _url(address, listener.getsockname()[1])

    def ready() -> None:
        print(url, flush=True)
        if browser:
            threading.Thread(target=webbrowser.open, args=(url,), daemon=True).start()

    door = Door(frozenset({"localhost", address.host}), address.token)
    config = uvicorn.Config(
        make_app(Pool(workers_here()), door, ready),
        ws=LeavingProtocol, ws_max_size=LARGEST_MESSAGE, ws_max_queue=16, ws_per_message_deflate=False,
        http="h11", loop="asyncio", log_level="warning", access_log=False, server_header=False, proxy_headers=False,
        limit_concurrency=MOST_CONNECTIONS, timeout_graceful_shutdown=GRACE,
    )  # fmt: skip
    try:
        uvicorn.Server(config).run(sockets=[listener])
    except KeyboardInterrupt:
        print("palmar: the studio is closed", file=sys.stderr)


def _check(address: Address) -> None:
    token = address.token
    if token is not None and (len(token) < SHORTEST_TOKEN or not token.isascii() or not token.isprintable()):
        raise InputError("--token", None, f"must be at least {SHORTEST_TOKEN} printable ASCII characters")
    if token is None and not _is_loopback(address.host):
        raise InputError("--host", repr(address.host), "beyond this machine the studio needs --token too")


def _is_loopback(host: str) -> bool:
    try:
        return host == "localhost" or ip_address(host).is_loopback
    except ValueError:
        return False


def _bound(address: Address) -> socket.socket:
    """A listening socket."""
    try:
        family, kind, protocol, _, where = socket.getaddrinfo(address.host, address.port, type=socket.SOCK_STREAM)[0]
        listener = socket.socket(family, kind, protocol)
    except OSError as error:
        raise _cannot(address, error) from None
    try:
        if sys.platform != "win32":
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(where)
        listener.listen(128)
    except OSError as error:
        listener.close()
        raise _cannot(address, error) from None
    return listener


def _cannot(address: Address, error: OSError) -> OutputError:
    taken = error.errno == errno.EADDRINUSE
    words = "is in use, another --port may be free" if taken else f"cannot be used: {error.strerror or error}"
    return OutputError(f"{address.host} port {address.port} {words}")


def _url(address: Address, port: int) -> str:
    host = f"[{address.host}]" if ":" in address.host else address.host
    query = "" if address.token is None else f"?token={quote(address.token, safe='')}"
    return f"http://{host}:{port}/{query}"
