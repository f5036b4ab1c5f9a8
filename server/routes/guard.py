"""What stands before every route: a request id, a bounded body, security headers, and no stack trace for anybody."""

from __future__ import annotations

import asyncio
import logging
import re
import time
import uuid
from typing import TYPE_CHECKING
from urllib.parse import unquote_to_bytes

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import Request

from ..services.config.files import MOST_BYTES
from ..services.faces.imports import MOST_BYTES as HEAD_BYTES
from ..services.faces.models import MOST_BYTES as MODEL_BYTES
from .errors import answer, error_body

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

    from ..settings import Settings

logger = logging.getLogger("emogen.request")

POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' blob: data:",
        "font-src 'self'",
        "connect-src 'self'",
        "manifest-src 'self'",
        "form-action 'self'",
        "base-uri 'none'",
        "frame-ancestors 'none'",
    )
)
HEADERS = {
    "Content-Security-Policy": POLICY,
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
}
LARGE = re.compile(r"/admin/studies/(import|[^/]+/design)")
"""Where a study file may arrive, or the form of a whole study."""
LARGE_BYTES = 2 * MOST_BYTES + 2**20
"""A file and a text of the size that is allowed, and what is around them; what is too long, the page says."""
MODELS = re.compile(r"/admin/models")
"""Where the two files of a face model may arrive."""
MODELS_BYTES = 2 * MODEL_BYTES + 2**20
HEADS = re.compile(r"/admin/models/import")
"""Where the file of a head to be imported may arrive."""
HEADS_BYTES = HEAD_BYTES + 2**20
TRANSPORT = "max-age=31536000; includeSubDomains"


class Guard:
    """ASGI middleware around the whole app."""

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        self._app = app
        self._limit = settings.body_limit_bytes
        larger = ((LARGE, LARGE_BYTES), (MODELS, MODELS_BYTES), (HEADS, HEADS_BYTES))
        self._larger = tuple((paths, max(self._limit, most)) for paths, most in larger)
        self._patience = settings.body_timeout_seconds
        self._headers = {**HEADERS, "Strict-Transport-Security": TRANSPORT} if settings.secure else HEADERS

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Take a request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        exchange = _Exchange(scope, send, self._headers)
        body = await self._body(scope, receive)
        try:
            if isinstance(body, int):
                await answer(Request(scope), body, error_body(body), {"Connection": "close"})(
                    scope, receive, exchange.send
                )
            else:
                await self._app(scope, _replay(body, receive), exchange.send)
        except Exception:
            logger.exception("request failed", extra={"request_id": exchange.id})
            if exchange.status:
                raise
            await answer(Request(scope), 500, error_body(500, request=exchange.id))(scope, receive, exchange.send)
        finally:
            exchange.log()

    async def _body(self, scope: Scope, receive: Receive) -> list[bytes] | int:
        """Return the whole body, or the status of its refusal: nothing behind this reads more than the limit."""
        length = Headers(scope=scope).get("content-length", "0")
        if not length.isdigit() or _has_nul(scope):
            return 400
        limit = next((most for paths, most in self._larger if paths.fullmatch(scope["path"])), self._limit)
        if int(length) > limit:
            return 413
        try:
            async with asyncio.timeout(self._patience):
                return await self._read(receive, limit)
        except TimeoutError:
            return 408

    async def _read(self, receive: Receive, limit: int) -> list[bytes] | int:
        parts: list[bytes] = []
        while True:
            message = await receive()
            if message["type"] != "http.request":
                return 400
            parts.append(message.get("body", b""))
            if sum(map(len, parts)) > limit:
                return 413
            if not message.get("more_body", False):
                return parts


class _Exchange:
    """One request and its answer, as they are logged."""

    def __init__(self, scope: Scope, send: Send, headers: dict[str, str]) -> None:
        self.id = uuid.uuid4().hex
        self.status = 0
        self._scope = scope
        self._send = send
        self._headers = headers
        # Styles and scripts have no version in their address: kept, but asked for again by their ETag.
        self._keep = "no-cache" if scope["path"].startswith("/static/") else "no-store"
        self._began = time.perf_counter()

    async def send(self, message: Message) -> None:
        """Send a part of the answer, with the headers that every answer has."""
        if message["type"] == "http.response.start":
            self.status = message["status"]
            headers = MutableHeaders(scope=message)
            for name, value in self._headers.items():
                headers.setdefault(name, value)
            headers.setdefault("Cache-Control", self._keep)
            headers["X-Request-ID"] = self.id
        await self._send(message)

    def log(self) -> None:
        """Write one line about it."""
        taken = round((time.perf_counter() - self._began) * 1000, 1)
        extra = {"request_id": self.id, "method": self._scope["method"], "status": self.status, "ms": taken}
        logger.info("request", extra={**extra, "path": public_path(self._scope["path"])})


def _has_nul(scope: Scope) -> bool:
    """Return whether an address has the one character that no text of it may hold: PostgreSQL cannot look for it."""
    return "\0" in scope["path"] or b"\0" in unquote_to_bytes(scope["query_string"])


def public_path(path: str) -> str:
    """Return a path without the token or link in it: who reads the log must not be able to answer for a participant."""
    parts = path.split("/")
    return "/".join([*parts[:2], "…", *parts[3:]]) if len(parts) > 2 and parts[1] in {"p", "s"} else path


def _replay(parts: list[bytes], receive: Receive) -> Receive:
    """Return a `receive` that gives the body that was read, then whatever the connection says next."""
    given = False

    async def again() -> Message:
        nonlocal given
        if given:
            return await receive()
        given = True
        return {"type": "http.request", "body": b"".join(parts), "more_body": False}

    return again
