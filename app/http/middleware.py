"""The outermost layer, pure ASGI: request id, limits on bodies, security headers, timing, log, metrics, the 500."""

import asyncio
import json
import logging
import re
import time
from contextlib import suppress
from functools import lru_cache
from secrets import token_hex

from prometheus_client import Counter, Histogram
from starlette._utils import get_route_path
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect, Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.errors import ContentTooLarge
from app.http.problems import answer, internal_error, problem
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

# A format is faster than json.dumps; only the client's address, which a proxy may give, needs escaping.
LOG_LINE = (
    '{"time": %.3f, "request_id": "%s", "client": %s, "method": "%s", "endpoint": "%s", "status": %d, '
    '"duration_ms": %.3f}'
)

CLIENT_GONE = 499  # nginx's status of a client that left; seen in the log only

logger = logging.getLogger(REQUEST_LOG)


def request_id(sent: bytes = b"") -> str:
    """Return the client's request id, or a new one if its characters are not permitted."""
    return sent.decode() if ACCEPTABLE_ID.fullmatch(sent) else token_hex(16)


def own_headers(identifier: str, seconds: float) -> list[tuple[bytes, bytes]]:
    """The headers of every answer."""
    timing = b"total;dur=%.1f" % (seconds * 1e3)
    return [(b"x-request-id", identifier.encode()), (b"server-timing", timing), *SECURITY_HEADERS]


def record(
    identifier: str, client: tuple[str, int] | None, method: str, endpoint: str, status: int, seconds: float
) -> None:
    """One log line and the metrics of a finished request; `client` is None where its address is not to be logged."""
    requests, duration = _meters(endpoint, status)
    requests.inc()
    duration.observe(seconds)
    if logger.isEnabledFor(logging.INFO):
        logger.info(
            LOG_LINE, time.time(), identifier, json.dumps(client and client[0]), method, endpoint, status, seconds * 1e3
        )


@lru_cache(maxsize=1024)
def _meters(endpoint: str, status: int) -> tuple[Counter, Histogram]:
    return REQUESTS.labels(endpoint, status), DURATION.labels(endpoint)


class Protection:
    """Wraps the application; see the module's title for what it does."""

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        self._app = app
        self._settings = settings
        # Files of gear units are larger than requests; they stand in forms and in JSON.
        self._most_bytes = dict.fromkeys(("/v1/rexs", "/v1/rexs/results", "/rexs"), (settings.rexs_mb + 1) * MEBIBYTE)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request, under the prefix of the settings: as ASGI wants it, its path has it, stripped or not."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        root, path = self._settings.root_path or scope.get("root_path", ""), scope["path"]
        if not f"{path}/".startswith(f"{root}/"):
            path = root + path
        scope = {**scope, "root_path": root, "path": f"{root}/" if path == root else path}
        most_bytes = self._most_bytes.get(get_route_path(scope), self._settings.max_body_bytes)
        await _Request(self._settings, most_bytes, scope, receive, send).serve(self._app)


def _whole(send: Send) -> Send:
    """Keeps an answer to HTTP/1.0, which knows no chunks, until it is whole, and sends it with its length."""
    start: Message = {}
    body = bytearray()

    async def send_whole(message: Message) -> None:
        if message["type"] == "http.response.start":
            start.update(message)
            return
        body.extend(message.get("body", b""))
        if message.get("more_body", False):
            return
        if start["status"] not in {204, 304} and all(name.lower() != b"content-length" for name, _ in start["headers"]):
            start["headers"] = [*start["headers"], (b"content-length", b"%d" % len(body))]
        await send(start)
        await send({"type": "http.response.body", "body": bytes(body)})

    return send_whole


class _Request:
    """State of a request from its arrival to its answer."""

    def __init__(self, limits: Settings, most_bytes: int, scope: Scope, receive: Receive, send: Send) -> None:
        self._limits = limits
        self._most_bytes = most_bytes
        self._started = time.perf_counter()
        self._headers: dict[bytes, bytes] = dict(scope["headers"])
        self._identifier = request_id(self._headers.get(b"x-request-id", b""))
        self._state = scope.setdefault("state", {})
        self._state["request_id"] = self._identifier
        # What a GET answers, a HEAD answers too; the server leaves the body out.
        self._scope = {**scope, "method": "GET"} if scope["method"] == "HEAD" else scope
        self._method = scope["method"]
        self._receive = receive
        self._send = _whole(send) if scope["http_version"] == "1.0" else send
        self._status = CLIENT_GONE
        self._due = asyncio.get_running_loop().time() + limits.body_deadline_s
        self._received = 0
        self._complete = b"content-length" not in self._headers and b"transfer-encoding" not in self._headers

    async def serve(self, application: ASGIApp) -> None:
        """Answer, whatever happens, and log and count it."""
        announced = self._headers.get(b"content-length", b"")
        if announced.isdigit() and int(announced) > self._most_bytes:
            application = answer(Request(self._scope), self._too_large())
        try:
            await application(self._scope, self._receive_within_limits, self._send_decorated)
        except ClientDisconnect:
            pass
        except asyncio.CancelledError:  # the server stops and waits no longer; this task ends with its answer
            if self._status == CLIENT_GONE:
                retry = {"Retry-After": "5"}
                stopping = problem(self._identifier, 503, "shutting_down", "The service stops", headers=retry)
                await stopping(self._scope, self._receive, self._send_decorated)
        except Exception as error:
            failure = internal_error(self._identifier, error)
            if self._status != CLIENT_GONE:
                raise  # too late for another answer: the connection is cut
            await failure(self._scope, self._receive, self._send_decorated)
        finally:
            endpoint = getattr(self._scope.get("route"), "path", "unmatched")
            status = self._state.get("answered", self._status)  # by the protocol, in our place
            client = self._scope.get("client") if self._limits.log_clients else None
            record(self._identifier, client, self._method, endpoint, status, time.perf_counter() - self._started)

    async def _send_decorated(self, message: Message) -> None:
        """Add the headers of every answer; end it only when the client has sent all of its body."""
        if message["type"] == "http.response.start":
            self._status = message["status"]
            given = message.get("headers", ())
            said = {name.lower() for name, _ in given}
            own = own_headers(self._identifier, time.perf_counter() - self._started)
            message["headers"] = [*given, *(header for header in own if header[0] not in said)]
        elif not self._complete and not message.get("more_body", False):
            await self._send({**message, "more_body": True})
            await self._discard_body()
            message = {"type": "http.response.body"}
        await self._send(message)

    async def _discard_body(self) -> None:
        """Take what the client still sends: closing the connection meanwhile could cost it the answer."""
        with suppress(TimeoutError):
            async with asyncio.timeout_at(self._due):
                while (await self._receive()).get("more_body", False):
                    pass

    async def _receive_within_limits(self) -> Message:
        """The next message; gives up on a body that takes too long or grows too large."""
        if self._complete:
            return await self._receive()
        try:
            async with asyncio.timeout_at(self._due):
                message = await self._receive()
        except TimeoutError as error:
            raise HTTPException(408, "The request body took too long to arrive") from error
        self._received += len(message.get("body", b""))
        if self._received > self._most_bytes:
            raise self._too_large()
        self._complete = not message.get("more_body", False)
        return message

    def _too_large(self) -> ContentTooLarge:
        return ContentTooLarge(f"The request body is larger than {self._most_bytes} bytes")
