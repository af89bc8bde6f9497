"""The server's side of one connection: limits where bytes arrive, before memory is spent on them.

uvicorn's protocol hands a request over when its headers are complete, so whatever limits headers, their time and the
number of connections has to sit here. What it refuses, and what its parser cannot read, is answered with a problem
document and written to the books like every other answer.
"""

import asyncio
import http
import time
from typing import Any

from uvicorn.protocols.http.httptools_impl import STATUS_LINE, HttpToolsProtocol

from app.books import own_headers, record, request_id
from app.problems import problem
from app.settings import settings

MOST_PIPELINED = 16
LINGER_S = 2.0


class Refused(Exception):
    """Ends the parsing of a request that goes beyond a limit."""


class LimitedProtocol(HttpToolsProtocol):
    """uvicorn's protocol with limits."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._limits = settings()
        self._began = time.perf_counter()
        self._refusal = http.HTTPStatus.BAD_REQUEST
        self._in_body = False
        self._complete = True
        self._overhead = 0  # bytes of the current message that are not its body
        self._unparsed = 0  # bytes since the parser last said anything
        self._timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """A client connected."""
        super().connection_made(transport)
        if len(self.connections) > self._limits.max_connections:
            self._answer(http.HTTPStatus.SERVICE_UNAVAILABLE)
        else:
            self._set_timer(self._limits.header_deadline_s, self._headers_are_late)

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection is gone."""
        self._unset_timer()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Some bytes arrived."""
        if self.transport.is_closing():
            return
        if self._complete and self._timer is None:
            self._set_timer(self._limits.header_deadline_s, self._headers_are_late)
        self._unparsed += len(data)
        super().data_received(data)
        if self._unparsed and not self.transport.is_closing():
            self._check_overhead()

    def on_message_begin(self) -> None:
        """The first byte of a request."""
        self._began = time.perf_counter()
        self._complete = self._in_body = False
        self._overhead = 0
        super().on_message_begin()

    def on_url(self, url: bytes) -> None:
        """A piece of the address."""
        self._count(len(url))
        super().on_url(url)

    def on_header(self, name: bytes, value: bytes) -> None:
        """One header, or one trailer, which nobody asked for."""
        self._count(len(name) + len(value))
        if not self._in_body:
            super().on_header(name, value)

    def on_headers_complete(self) -> None:
        """The body follows."""
        self._unset_timer()
        self._in_body = True
        self._unparsed = 0
        if len(self.pipeline) >= MOST_PIPELINED:
            self._refuse(http.HTTPStatus.SERVICE_UNAVAILABLE)
        super().on_headers_complete()

    def on_body(self, body: bytes) -> None:
        """A piece of the body; its own limit is the application's."""
        self._unparsed = 0
        super().on_body(body)

    def on_message_complete(self) -> None:
        """The last byte of a request."""
        self._complete = True
        self._unparsed = 0
        super().on_message_complete()

    def on_response_complete(self) -> None:
        """The answer is on its way; a client that still sends its body has a moment to stop."""
        super().on_response_complete()
        if not self._complete and not self.transport.is_closing():
            self._set_timer(LINGER_S, self.transport.close)

    def send_400_response(self, msg: str) -> None:
        """Answer what the parser gave up on."""
        del msg
        self._answer(self._refusal)

    def _count(self, size: int) -> None:
        self._overhead += size
        self._unparsed = 0
        if self._overhead > self._limits.max_header_bytes:
            self._refuse(http.HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE)

    def _refuse(self, status: http.HTTPStatus) -> None:
        self._refusal = status
        raise Refused

    def _check_overhead(self) -> None:
        """Refuse a header that never ends, which the parser would keep to itself."""
        if self._overhead + self._unparsed > self._limits.max_header_bytes:
            self._answer(http.HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE)

    def _headers_are_late(self) -> None:
        if self._complete:
            self.transport.close()  # it never sent a byte
        else:
            self._answer(http.HTTPStatus.REQUEST_TIMEOUT)

    def _answer(self, status: http.HTTPStatus) -> None:
        """A problem document and the end of the connection."""
        if self.transport.is_closing():
            return
        self._unset_timer()
        cycle = self.cycle
        in_progress = cycle is not None and not cycle.response_complete
        seconds = time.perf_counter() - self._began
        identifier = request_id()
        if in_progress:  # the application waits for the rest of this request and will write its books
            identifier = cycle.scope.get("state", {}).get("request_id", identifier)
            cycle.scope.setdefault("state", {})["answered"] = int(status)
        else:
            record(identifier, "-", "unparsed", int(status), seconds)
        if not (in_progress and cycle.response_started):
            self.transport.write(_response(status, identifier, seconds))
        self.transport.close()

    def _set_timer(self, seconds: float, action: Any) -> None:
        self._unset_timer()
        self._timer = self.loop.call_later(seconds, action)

    def _unset_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None


def _response(status: http.HTTPStatus, identifier: str, seconds: float) -> bytes:
    code = status.phrase.lower().replace(" ", "_").replace("-", "_")
    document = problem(identifier, status, code, status.phrase, detail=status.description or status.phrase)
    headers = [*document.raw_headers, *own_headers(identifier, seconds), (b"connection", b"close")]
    if status == http.HTTPStatus.SERVICE_UNAVAILABLE:
        headers.append((b"retry-after", b"1"))
    lines = b"".join(b"%s: %s\r\n" % header for header in headers)
    return STATUS_LINE[status] + lines + b"\r\n" + bytes(document.body)
