"""The outermost layer, pure ASGI: request id, limits on headers and body, security headers, timing, log, metrics."""

import json
import logging
import re
import time
from typing import Any
from uuid import uuid4

import anyio
from starlette.datastructures import Headers, MutableHeaders
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.metrics import DURATION, REQUESTS
from app.problems import problem
from app.settings import Settings

ACCEPTABLE_ID = re.compile(r"[A-Za-z0-9._-]{1,128}")
SECURITY_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'self'; img-src 'self' data:; style-src 'self' 'unsafe-inline'; "
    "script-src 'self' 'unsafe-inline'; frame-ancestors 'none'",
}

access_log = logging.getLogger("tribodrive.access")


class Protection:
    """Wraps the application; see the module's title for what it does."""

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        self._app = app
        self._settings = settings

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        started = time.perf_counter()
        request_id = _request_id(scope)
        scope.setdefault("state", {})["request_id"] = request_id
        status = 499

        async def send_decorated(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
                _decorate(message, request_id, time.perf_counter() - started)
            await send(message)

        try:
            if _header_bytes(scope) > self._settings.max_header_bytes:
                refusal = problem(request_id, 431, "headers_too_large", "The request headers are too large")
                await refusal(scope, receive, send_decorated)
            else:
                await self._app(scope, _punctual(receive, self._settings.body_deadline_s), send_decorated)
        finally:
            _record(scope, status, request_id, time.perf_counter() - started)


def _request_id(scope: Scope) -> str:
    """The client's request id if it is a decent one, else a new one."""
    sent = Headers(scope=scope).get("x-request-id", "")
    return sent if ACCEPTABLE_ID.fullmatch(sent) else uuid4().hex


def _header_bytes(scope: Scope) -> int:
    return sum(len(name) + len(value) for name, value in scope["headers"])


def _punctual(receive: Receive, deadline_s: float) -> Receive:
    """`receive` that gives up on a body that takes longer than the deadline."""
    due = anyio.current_time() + deadline_s
    complete = False

    async def receive_in_time() -> Message:
        nonlocal complete
        if complete:
            return await receive()
        with anyio.CancelScope(deadline=due):
            message = await receive()
            complete = not message.get("more_body", False)
            return message
        raise HTTPException(408, "The request body took too long to arrive")

    return receive_in_time


def _decorate(message: Message, request_id: str, seconds: float) -> None:
    headers = MutableHeaders(scope=message)
    headers["X-Request-ID"] = request_id
    headers["Server-Timing"] = f"total;dur={seconds * 1e3:.1f}"
    for name, value in SECURITY_HEADERS.items():
        headers[name] = value


def _record(scope: Scope, status: int, request_id: str, seconds: float) -> None:
    """One log line and the metrics of a finished request."""
    endpoint = getattr(scope.get("route"), "path", "unmatched")
    REQUESTS.labels(endpoint, status).inc()
    DURATION.labels(endpoint).observe(seconds)
    line: dict[str, Any] = {
        "time": time.time(),
        "request_id": request_id,
        "method": scope["method"],
        "endpoint": endpoint,
        "status": status,
        "duration_ms": round(seconds * 1e3, 3),
    }
    access_log.info(json.dumps(line))
