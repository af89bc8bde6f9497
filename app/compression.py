"""Compresses answers for clients that accept it, in a thread: the event loop goes on meanwhile. Pure ASGI."""

import gzip
from typing import Any

import anyio.to_thread
from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LEAST_BYTES = 4096
LEVEL = 4
COMPRESSIBLE = ("text/", "application/json", "application/problem+json", "image/svg+xml")


class Compression:
    """Wraps the application; answers that are sent in pieces pass as they are."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""
        if scope["type"] != "http" or "gzip" not in Headers(scope=scope).get("accept-encoding", ""):
            await self._app(scope, receive, send)
            return
        await self._app(scope, receive, _Sender(send).send)


class _Sender:
    """Holds the head of an answer back until its body is there."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self._head: dict[str, Any] | None = None

    async def send(self, message: Message) -> None:
        """Send a message, the head together with the first piece of the body."""
        if message["type"] == "http.response.start":
            self._head = dict(message)
            return
        if self._head is not None:
            head, self._head = self._head, None
            if _worthwhile(head, message):
                message = await _compressed(head, message)
            await self._send(head)
        await self._send(message)


def _worthwhile(head: dict[str, Any], message: Message) -> bool:
    headers = Headers(raw=head["headers"])
    return (
        not message.get("more_body", False)
        and len(message.get("body", b"")) >= LEAST_BYTES
        and "content-encoding" not in headers
        and headers.get("content-type", "").startswith(COMPRESSIBLE)
    )


async def _compressed(head: dict[str, Any], message: Message) -> Message:
    body = await anyio.to_thread.run_sync(lambda: gzip.compress(message["body"], LEVEL, mtime=0))
    headers = MutableHeaders(raw=head["headers"])
    headers["Content-Encoding"] = "gzip"
    headers["Content-Length"] = str(len(body))
    headers.add_vary_header("Accept-Encoding")
    return {**message, "body": body}
