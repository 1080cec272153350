"""``palmar studio``: the web page, served from this machine."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Annotated

from cyclopts import App, Parameter

from palmar.errors import InputError, NotCoveredError

app = App(name="studio")
PORT = 8470


@app.default
def studio(
    *,
    port: Annotated[int, Parameter(help="Where to listen; 0 takes any that is free.")] = PORT,
    host: Annotated[str, Parameter(help="An address of this machine; beyond loopback it needs --token.")] = "127.0.0.1",
    token: Annotated[str | None, Parameter(help="Only who has it gets in: 16 characters or more.")] = None,
    no_browser: Annotated[bool, Parameter(negative="", help="Do not open the browser.")] = False,
) -> None:
    """Serve the studio until interrupted (Ctrl-C); the first line printed is its address."""
    if not 0 <= port <= 65535:
        raise InputError("--port", str(port), "must be from 0 to 65535")
    if any(find_spec(each) is None for each in ("fastapi", "uvicorn", "websockets")):
        raise NotCoveredError("the studio needs FastAPI, uvicorn and websockets: pip install palmar[studio]")
    from palmar.faces.studio.serve import Address, serve

    serve(Address(host, port, token), browser=not no_browser)
