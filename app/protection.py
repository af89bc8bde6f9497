"""The outermost layer, pure ASGI: request id, limits on headers and body, security headers, timing, log, metrics."""

import asyncio
import json
import logging
import re
import time
from functools import lru_cache
from typing import Any
from uuid import uuid4

from prometheus_client import Counter, Histogram
from starlette.exceptions import HTTPException
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.metrics import DURATION, REQUESTS
from app.problems import problem
from app.settings import Settings

ACCEPTABLE_ID = re.compile(rb"[A-Za-z0-9._-]{1,128}")
CONTENT_POLICY = (
    b"default-src 'self'; img-src 'self' data:; style-src 'self' 'unsafe-inline'; "
    b"script-src 'self' 'unsafe-inline'; frame-ancestors 'none'"
)
SECURITY_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
    (b"referrer-policy", b"no-referrer"),
    (b"cache-control", b"no-store"),
    (b"content-security-policy", CONTENT_POLICY),
)

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
        headers: dict[bytes, bytes] = dict(scope["headers"])
        request_id = _request_id(headers)
        scope.setdefault("state", {})["request_id"] = request_id
        status = 499

        async def send_decorated(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
                duration = f"total;dur={(time.perf_counter() - started) * 1e3:.1f}"
                own = ((b"x-request-id", request_id.encode()), (b"server-timing", duration.encode()))
                message["headers"] = [*message.get("headers", ()), *own, *SECURITY_HEADERS]
            await send(message)

        try:
            application = self._refusal(scope, headers, request_id) or self._app
            await application(scope, self._limited(receive), send_decorated)
        finally:
            _record(scope, status, request_id, time.perf_counter() - started)

    def _refusal(self, scope: Scope, headers: dict[bytes, bytes], request_id: str) -> JSONResponse | None:
        """The answer to a request whose headers alone are too much, or announce too much."""
        if sum(len(name) + len(value) for name, value in scope["headers"]) > self._settings.max_header_bytes:
            return problem(request_id, 431, "headers_too_large", "The request headers are too large")
        announced = headers.get(b"content-length", b"")
        if announced.isdigit() and int(announced) > self._settings.max_body_bytes:
            return problem(request_id, 413, "content_too_large", self._too_large())
        return None

    def _limited(self, receive: Receive) -> Receive:
        """`receive` that gives up on a body that takes too long or grows too large."""
        due = asyncio.get_running_loop().time() + self._settings.body_deadline_s
        received = 0
        complete = False

        async def receive_within_limits() -> Message:
            nonlocal received, complete
            if complete:
                return await receive()
            try:
                async with asyncio.timeout_at(due):
                    message = await receive()
            except TimeoutError as error:
                raise HTTPException(408, "The request body took too long to arrive") from error
            received += len(message.get("body", b""))
            if received > self._settings.max_body_bytes:
                raise HTTPException(413, self._too_large())
            complete = not message.get("more_body", False)
            return message

        return receive_within_limits

    def _too_large(self) -> str:
        return f"The request body is larger than {self._settings.max_body_bytes} bytes"


def _request_id(headers: dict[bytes, bytes]) -> str:
    """The client's request id if it is a decent one, else a new one."""
    sent = headers.get(b"x-request-id", b"")
    return sent.decode() if ACCEPTABLE_ID.fullmatch(sent) else uuid4().hex


def _record(scope: Scope, status: int, request_id: str, seconds: float) -> None:
    """One log line and the metrics of a finished request."""
    endpoint = getattr(scope.get("route"), "path", "unmatched")
    requests, duration = _meters(endpoint, status)
    requests.inc()
    duration.observe(seconds)
    line: dict[str, Any] = {
        "time": time.time(),
        "request_id": request_id,
        "method": scope["method"],
        "endpoint": endpoint,
        "status": status,
        "duration_ms": round(seconds * 1e3, 3),
    }
    access_log.info(json.dumps(line))


@lru_cache(maxsize=1024)
def _meters(endpoint: str, status: int) -> tuple[Counter, Histogram]:
    return REQUESTS.labels(endpoint, status), DURATION.labels(endpoint)
