"""Outermost layer of the application: request id, size limit of bodies, security headers, log, metrics, status 500."""

import asyncio
import json
import logging
import re
import time
from secrets import token_hex

from starlette.requests import ClientDisconnect, Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.errors import ContentTooLarge, Stopping
from app.http.problems import answer, internal_error
from app.log import DURATION, REQUEST_LOG, REQUESTS
from app.settings import MEBIBYTE, Settings

ACCEPTABLE_ID = re.compile(rb"[A-Za-z0-9._-]{1,128}")
CONTENT_POLICY = (
    b"default-src 'self'; img-src 'self' data:; style-src 'self' 'unsafe-inline'; "
    b"base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
)
SECURITY_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
    (b"referrer-policy", b"no-referrer"),
    (b"cache-control", b"no-store"),
    (b"content-security-policy", CONTENT_POLICY),
)
CLIENT_GONE = 499  # nginx's status for a client that closed the connection; this status appears only in the log

logger = logging.getLogger(REQUEST_LOG)


class Protection:
    """Outermost layer, which receives every request and calls the application."""

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        self._app = app
        self._settings = settings
        # Files of gear units are larger than requests.
        self._most_bytes = dict.fromkeys(("/v1/rexs", "/v1/rexs/results", "/rexs"), settings.rexs_bytes + MEBIBYTE)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request even if the application fails; log and count the request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        sent_id = dict(scope["headers"]).get(b"x-request-id", b"")
        identifier = sent_id.decode() if ACCEPTABLE_ID.fullmatch(sent_id) else token_hex(16)
        inner = self._inner(scope, identifier)
        most_bytes = self._most_bytes.get(inner["path"].removeprefix(inner["root_path"]), self._settings.max_body_bytes)
        began, status, received = time.perf_counter(), CLIENT_GONE, 0

        async def receive_within_limit() -> Message:
            nonlocal received
            message = await receive()
            received += len(message.get("body", b""))
            if received > most_bytes:
                while message.get("more_body", False):  # closing the connection early could lose the answer
                    message = await receive()
                raise ContentTooLarge(f"The request body is larger than {most_bytes} bytes")
            return message

        async def send_decorated(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
                timing = b"total;dur=%.1f" % ((time.perf_counter() - began) * 1e3)
                own = ((b"x-request-id", identifier.encode()), (b"server-timing", timing), *SECURITY_HEADERS)
                given = message.get("headers", ())
                names = {name.lower() for name, _ in given}
                message["headers"] = [*given, *(header for header in own if header[0] not in names)]
            await send(message)

        try:
            await self._app(inner, receive_within_limit, send_decorated)
        except ClientDisconnect:
            pass
        except (Exception, asyncio.CancelledError) as error:
            if status != CLIENT_GONE:
                raise  # an answer has begun, so another answer is impossible; the connection is cut
            # A server that is stopping cancels the requests that have not ended in time.
            stopping = answer(Request(inner), Stopping())
            failure = internal_error(identifier, error) if isinstance(error, Exception) else stopping
            await failure(inner, receive, send_decorated)
        finally:
            endpoint, seconds = getattr(inner.get("route"), "path", "unmatched"), time.perf_counter() - began
            REQUESTS.labels(endpoint, status).inc()
            DURATION.labels(endpoint).observe(seconds)
            address = scope["client"][0] if self._settings.log_clients and scope.get("client") else None
            line = {"time": round(time.time(), 3), "request_id": identifier, "client": address}
            line |= {"method": scope["method"], "endpoint": endpoint, "status": status}
            logger.info(json.dumps(line | {"duration_ms": round(seconds * 1e3, 3)}))

    def _inner(self, scope: Scope, identifier: str) -> Scope:
        """Return the ASGI scope that the application receives.

        The path in the scope begins with the prefix from the settings, even if a proxy has removed this prefix.
        """
        root, path = self._settings.root_path or scope.get("root_path", ""), scope["path"]
        path = path if f"{path}/".startswith(f"{root}/") else root + path
        path = f"{root}/" if path == root else path
        method = "GET" if scope["method"] == "HEAD" else scope["method"]  # the server leaves out the body of the answer
        state = {**scope.get("state", {}), "request_id": identifier}
        return {**scope, "root_path": root, "path": path, "method": method, "state": state}
