"""What stands before every request: which host was meant, which page asks, who holds the token; and the headers of safety.

A page of another site may not reach the studio: not by its own address (Origin), not by a name of its own that it lets
point to this machine (Host). Non-browsers send no Origin and are taken.
"""

from __future__ import annotations

import hmac
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie
from ipaddress import ip_address
from urllib.parse import parse_qs, urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

COOKIE = "palmar_studio_token"
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:;"
        " font-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}


@dataclass(frozen=True)
class Door:
    """Names (without port) by which the studio may be called besides addresses, and the token, None for none."""

    names: frozenset[str]
    token: str | None

    def refusal(self, headers: Headers) -> str | None:
        """Why a request is not answered, in a line; None if it is."""
        host = headers.get("host", "")
        if not self._is_known(host):
            return "This name is not one of the studio's; use the address that it printed."
        origin = headers.get("origin")
        if origin is not None and urlsplit(origin).netloc != host:
            return "Pages of other sites may not use the studio."
        return None

    def admits(self, headers: Headers) -> bool:
        """Whether the cookie holds the token, where there is one."""
        if self.token is None:
            return True
        try:
            held = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
        except CookieError:
            return False
        return held is not None and self.is_token(held.value)

    def is_token(self, given: str) -> bool:
        """Whether it is the token, in the same time for all others."""
        return self.token is not None and hmac.compare_digest(given.encode(), self.token.encode())

    def _is_known(self, host: str) -> bool:
        try:
            name = urlsplit(f"//{host}").hostname or ""
            if name in self.names:
                return True
            ip_address(name)
        except ValueError:
            return False
        return True


class Guard:
    """ASGI middleware: refuses, lets the token's holder in, and adds the headers."""

    def __init__(self, app: ASGIApp, door: Door) -> None:
        self.app, self.door = app, door

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer or pass on."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        answer = self._instead(scope)
        if answer is None:
            await self.app(scope, receive, _with_headers(send))
        elif scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 1008, "reason": ""})
        else:
            await answer(scope, receive, _with_headers(send))

    def _instead(self, scope: Scope) -> Response | None:
        """What is said instead of an answer."""
        headers = Headers(scope=scope)
        refusal = self.door.refusal(headers)
        if refusal is not None:
            return PlainTextResponse(refusal + "\n", 403)
        if self.door.admits(headers):
            return None
        (given, *_) = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])
        if scope["type"] == "http" and self.door.is_token(given):
            answer = RedirectResponse(scope["path"], 303)
            # Lax: a strict cookie would not come along when the address is followed from a message.
            answer.set_cookie(COOKIE, given, httponly=True, samesite="lax")
            return answer
        return PlainTextResponse("This studio asks for a token; use the address that it printed.\n", 403)


def _with_headers(send: Send) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            for name, value in HEADERS.items():
                headers.setdefault(name, value)
        await send(message)

    return sent
