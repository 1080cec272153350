"""Who is let in."""

import asyncio

import pytest
from starlette.datastructures import Headers
from starlette.responses import PlainTextResponse

from palmar.faces.studio.guard import COOKIE, Door, Guard

TOKEN = "0123456789abcdef"
OPEN, LOCKED = Door(frozenset({"localhost"}), None), Door(frozenset({"localhost"}), TOKEN)
HOST = {"host": "127.0.0.1:8470"}


def asked(door, headers, query="", kind="http"):
    """(what the application or the guard sent first, its headers)."""
    sent = []
    scope = {
        "type": kind, "method": "GET", "path": "/", "query_string": query.encode(),
        "headers": [(name.encode(), value.encode()) for name, value in headers.items()],
    }  # fmt: skip

    async def send(message):
        sent.append(message)

    async def application(scope, receive, send):
        if scope["type"] == "websocket":
            await send({"type": "websocket.accept"})
        else:
            await PlainTextResponse("page")(scope, receive, send)

    asyncio.run(Guard(application, door)(scope, None, send))
    return sent[0], Headers(raw=sent[0].get("headers", []))


@pytest.mark.parametrize(
    ("headers", "refused"),
    [
        (HOST, False),
        ({"host": "[::1]:8470"}, False),
        ({"host": "localhost:8470", "origin": "http://localhost:8470"}, False),
        ({"host": "evil.example:8470"}, True),
        ({"host": ""}, True),
        ({"host": "[:"}, True),
        ({**HOST, "origin": "http://evil.example"}, True),
        ({**HOST, "origin": "http://127.0.0.1:9999"}, True),
        ({**HOST, "origin": "null"}, True),
    ],
)
def test_other_sites_and_other_names_are_refused(headers, refused):
    assert (asked(OPEN, headers)[0]["status"] == 403) is refused
    socket, _ = asked(OPEN, headers, kind="websocket")
    assert (socket["type"] == "websocket.close") is refused


def test_pages_carry_the_headers_of_safety():
    _, headers = asked(OPEN, HOST)
    assert headers["content-security-policy"].startswith("default-src 'none'; script-src 'self';")
    assert headers["x-content-type-options"] == "nosniff"


def test_only_who_has_the_token_gets_in_and_keeps_it_as_a_cookie():
    assert asked(LOCKED, HOST)[0]["status"] == 403
    assert asked(LOCKED, HOST, "token=wrong")[0]["status"] == 403
    assert asked(LOCKED, HOST, f"token={TOKEN}", "websocket")[0]["type"] == "websocket.close"
    first, headers = asked(LOCKED, HOST, f"token={TOKEN}")
    assert (first["status"], headers["location"]) == (303, "/")
    assert "httponly" in headers["set-cookie"].lower()
    cookie = {**HOST, "cookie": headers["set-cookie"].partition(";")[0]}
    assert asked(LOCKED, cookie)[0]["status"] == 200
    assert asked(LOCKED, cookie, kind="websocket")[0]["type"] == "websocket.accept"
    assert asked(LOCKED, {**HOST, "cookie": f"{COOKIE}=wrong"})[0]["status"] == 403
