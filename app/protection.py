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
from starlette.responses import JSONResponse
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
            refusal = self._refusal(scope, request_id)
            application = refusal or self._app
            await application(scope, self._limited(receive), send_decorated)
        finally:
            _record(scope, status, request_id, time.perf_counter() - started)

    def _refusal(self, scope: Scope, request_id: str) -> JSONResponse | None:
        """The answer to a request whose headers alone are too much, or announce too much."""
        if sum(len(name) + len(value) for name, value in scope["headers"]) > self._settings.max_header_bytes:
            return problem(request_id, 431, "headers_too_large", "The request headers are too large")
        announced = Headers(scope=scope).get("content-length", "")
        if announced.isdecimal() and int(announced) > self._settings.max_body_bytes:
            return problem(request_id, 413, "content_too_large", self._too_large())
        return None

    def _limited(self, receive: Receive) -> Receive:
        """`receive` that gives up on a body that takes too long or grows too large."""
        due = anyio.current_time() + self._settings.body_deadline_s
        received = 0
        complete = False

        async def receive_within_limits() -> Message:
            nonlocal received, complete
            if complete:
                return await receive()
            with anyio.CancelScope(deadline=due) as scope:
                message = await receive()
            if scope.cancelled_caught:
                raise HTTPException(408, "The request body took too long to arrive")
            received += len(message.get("body", b""))
            if received > self._settings.max_body_bytes:
                raise HTTPException(413, self._too_large())
            complete = not message.get("more_body", False)
            return message

        return receive_within_limits

    def _too_large(self) -> str:
        return f"The request body is larger than {self._settings.max_body_bytes} bytes"


def _request_id(scope: Scope) -> str:
    """The client's request id if it is a decent one, else a new one."""
    sent = Headers(scope=scope).get("x-request-id", "")
    return sent if ACCEPTABLE_ID.fullmatch(sent) else uuid4().hex


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
