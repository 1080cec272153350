"""The web application: the page's files, the socket, and files to save."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager

from fastapi import FastAPI, Request, Response, WebSocket
from starlette.exceptions import HTTPException
from starlette.responses import JSONResponse

from palmar.errors import InputError
from palmar.faces.cli.printing import one_line
from palmar.faces.studio.bundle import assets
from palmar.faces.studio.download import download
from palmar.faces.studio.guard import Door, Guard
from palmar.faces.studio.pool import Pool
from palmar.faces.studio.requests import LARGEST_MESSAGE, read_file_request
from palmar.faces.studio.session import Session

MOST_SESSIONS, MOST_DOWNLOADS = 64, 8
TRY_AGAIN_LATER = 1013


class Studio:
    """What the routes share; nothing of any client."""

    def __init__(self, pool: Pool) -> None:
        self.pool, self.assets = pool, assets()
        self.sessions = self.downloads = 0

    async def socket(self, socket: WebSocket) -> None:
        """One browser, until it leaves."""
        if self.sessions >= MOST_SESSIONS:
            await socket.close(TRY_AGAIN_LATER)
            return
        self.sessions += 1
        try:
            await Session(socket, self.pool).run()
        finally:
            self.sessions -= 1

    async def export(self, request: Request) -> Response:
        """A file to save."""
        if self.downloads >= MOST_DOWNLOADS:
            return _error("too many files are being made, try again in a moment", 503)
        self.downloads += 1
        try:
            wish = read_file_request(await _body(request))
            answer = await download(self.pool, wish)
        except InputError as error:
            return _error(str(error), 400)
        finally:
            self.downloads -= 1
        if isinstance(answer, str):
            return _error(answer, 422)
        name, data = answer
        saved = {"Content-Disposition": f'attachment; filename="{name}"', "Cache-Control": "no-store"}
        return Response(data, media_type="application/octet-stream", headers=saved)

    async def asset(self, path: str = "") -> Response:
        """One of the page's files."""
        known = self.assets.get(path)
        if known is None:
            raise HTTPException(404)
        return Response(known.data, media_type=known.media_type, headers={"Cache-Control": known.cache})


def make_app(pool: Pool, door: Door, ready: Callable[[], None] = lambda: None) -> FastAPI:
    """The application; ``ready`` is called when it takes requests."""

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        await pool.start()
        ready()
        yield
        await pool.stop()

    studio = Studio(pool)
    app = FastAPI(lifespan=lifespan, openapi_url=None, docs_url=None, redoc_url=None)
    app.add_middleware(Guard, door=door)
    app.add_api_websocket_route("/ws", studio.socket)
    app.add_api_route("/export", studio.export, methods=["POST"], response_model=None)
    app.add_api_route("/{path:path}", studio.asset, methods=["GET"], response_model=None)
    return app


async def _body(request: Request) -> str:
    """The body, if it is not too long; raises InputError."""
    if request.headers.get("content-type", "").partition(";")[0].strip() != "application/json":
        raise InputError("Content-Type", None, "must be application/json")
    data = bytearray()
    async for piece in request.stream():
        data += piece
        if len(data) > LARGEST_MESSAGE:
            raise InputError("message", None, f"must be at most {LARGEST_MESSAGE} bytes")
    try:
        return data.decode()
    except UnicodeDecodeError:
        raise InputError("message", None, "is not text in UTF-8") from None


def _error(words: str, status: int) -> Response:
    return JSONResponse({"error": one_line(words)}, status)
