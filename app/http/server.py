"""uvicorn as this service runs it: limits where bytes arrive, its own log, a short shutdown.

The limits are the sum and time of headers, the number of connections, and the time of answers that are not read.
uvicorn's protocol hands a request over when its headers are complete, so they have to sit in it. What it refuses, and
what its parser cannot read, is answered with a problem document and logged like every other answer. Anything beyond
(rates, bodies that arrive byte by byte) is left to a reverse proxy.
"""

import asyncio
import gc
import logging
import signal
import socket
import time
from collections import deque
from http import HTTPStatus
from types import FrameType
from typing import Any, NoReturn

import uvicorn
from uvicorn.importer import import_from_string
from uvicorn.protocols.http.httptools_impl import STATUS_LINE, HttpToolsProtocol, RequestResponseCycle

from app.http.middleware import own_headers, record, request_id
from app.http.problems import code_of, problem
from app.log import REQUEST_LOG
from app.settings import settings
from app.workers.processes import Template

INTERRUPT_S = 0.5  # for requests in flight after Ctrl-C
MOST_PIPELINED = 16  # thousands arrive at once, and each that waits takes 4 kB
MOST_TINY_PIECES, TINY_B = 1000, 16  # of a body; each takes 5 us, and one byte each held up all others for seconds

log = logging.getLogger(REQUEST_LOG)  # which goes to the standard output


class Refused(Exception):
    """A request exceeds a limit; raised inside the parser, which stops there."""


class LimitedProtocol(HttpToolsProtocol):
    """uvicorn's protocol with limits."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._limits = settings()
        self._began = time.perf_counter()
        self._refusal = HTTPStatus.BAD_REQUEST
        self._outstanding: HTTPStatus | None = None  # a refusal that waits for the answers before it
        self._cycles: deque[RequestResponseCycle] = deque(maxlen=MOST_PIPELINED + 2)  # of these some are not answered
        self._in_headers = False
        self._in_body = False
        self._pieces = self._body_bytes = 0
        self._unparsed = 0  # bytes since the end of headers, a piece of a body or the end of a request
        self._unsent = 0  # bytes of answers when the client was last seen to read
        self._header_timer: asyncio.TimerHandle | None = None
        self._send_timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """A client connected."""
        super().connection_made(transport)
        if len(self.connections) > self._limits.max_connections:
            self._answer(HTTPStatus.SERVICE_UNAVAILABLE)
        else:
            self._expect_request()

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection is gone."""
        for timer in (self._header_timer, self._send_timer):
            if timer is not None:
                timer.cancel()
        for cycle in self._cycles:  # uvicorn informs the last one only
            cycle.disconnected = True
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Some bytes arrived; behind a request that is refused they are dropped."""
        if self.transport.is_closing() or self._outstanding is not None:
            return
        if self._header_timer is None and not self._in_body and self._answered:
            self._expect_request()
        self._unparsed += len(data)
        super().data_received(data)
        if self._unparsed > self._limits.max_header_bytes:
            self._answer(HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE)

    def on_message_begin(self) -> None:
        """The first byte of a request."""
        self._began = time.perf_counter()
        self._in_headers = True
        super().on_message_begin()

    def on_headers_complete(self) -> None:
        """The body follows."""
        if len(self.url) + sum(len(name) + len(value) for name, value in self.headers) > self._limits.max_header_bytes:
            self._refuse(HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE)
        if sum(name == b"host" for name, _ in self.headers) > 1:
            self._refuse(HTTPStatus.BAD_REQUEST)
        if len(self.pipeline) >= MOST_PIPELINED:
            self._refuse(HTTPStatus.SERVICE_UNAVAILABLE)
        self._stop_expecting()
        self._in_headers, self._in_body = False, True
        self._unparsed = self._pieces = self._body_bytes = 0
        super().on_headers_complete()
        self._cycles.append(self.cycle)
        self.headers = []  # of trailers, which nobody looks at

    def on_body(self, body: bytes) -> None:
        """A piece of the body, whose size is limited by the application."""
        self._unparsed = 0
        self._pieces += 1
        self._body_bytes += len(body)
        if self._pieces > MOST_TINY_PIECES and self._body_bytes < TINY_B * self._pieces:
            self._refuse(HTTPStatus.BAD_REQUEST)
        super().on_body(body)

    def on_message_complete(self) -> None:
        """Stop the deadline of the body: all of the request has arrived."""
        self._in_body = False
        self._unparsed = 0
        super().on_message_complete()

    def on_response_complete(self) -> None:
        """The answer is on its way; what has begun to arrive meanwhile, or still arrives, has to come to an end."""
        super().on_response_complete()
        if self._outstanding is not None and self._answered:
            self._answer(self._outstanding)
        elif (self._in_headers or self._in_body) and self._answered and not self.transport.is_closing():
            self._expect_request()

    def send_400_response(self, msg: str) -> None:
        """Answer a request that cannot be parsed, or that `_refuse` has stopped."""
        del msg
        self._unparsed = 0
        self._answer(self._refusal)

    def pause_writing(self) -> None:
        """The client reads more slowly than it is answered."""
        super().pause_writing()
        self._unsent = self.transport.get_write_buffer_size()
        self._send_timer = self.loop.call_later(self._limits.send_deadline_s, self._check_reading)

    def resume_writing(self) -> None:
        """The client has read."""
        super().resume_writing()
        if self._send_timer is not None:
            self._send_timer.cancel()

    def _check_reading(self) -> None:
        """Give up on a client that has read nothing for a while, and free the memory of its answer."""
        if self.transport.is_closing():
            return
        unsent = self.transport.get_write_buffer_size()
        if unsent >= self._unsent:
            self.transport.abort()
        else:
            self._unsent = unsent
            self._send_timer = self.loop.call_later(self._limits.send_deadline_s, self._check_reading)

    @property
    def _answered(self) -> bool:
        """Whether no answer to what has arrived is outstanding."""
        return self.cycle is None or self.cycle.response_complete

    def _refuse(self, status: HTTPStatus) -> NoReturn:
        """Stop parsing; uvicorn then calls `send_400_response`, which answers with the status."""
        self._refusal = status
        raise Refused

    def _expect_request(self) -> None:
        self._stop_expecting()
        self._header_timer = self.loop.call_later(self._limits.header_deadline_s, self._request_is_late)

    def _stop_expecting(self) -> None:
        if self._header_timer is not None:
            self._header_timer.cancel()
            self._header_timer = None

    def _request_is_late(self) -> None:
        if self._in_headers:
            self._answer(HTTPStatus.REQUEST_TIMEOUT)
        else:
            self.transport.close()  # it never sent a byte, or has its answer and still sends a body

    def _answer(self, status: HTTPStatus) -> None:
        """Send a problem document once all earlier requests are answered, and close the connection."""
        if self.transport.is_closing():
            return
        if self._in_body and self.pipeline:  # its request waits for the answers before it, and will not start
            self.pipeline.popleft()
            self._cycles.pop()
            self.cycle, self._in_body = self._cycles[-1], False
        if not (self._answered or self._in_body):
            self._outstanding = status
            return
        self._stop_expecting()
        cycle = self.cycle
        seconds = time.perf_counter() - self._began
        identifier = request_id()
        if self._answered:
            client = self.client if self._limits.log_clients else None
            record(identifier, client, "-", "unparsed", int(status), seconds)
        else:  # the application waits for the rest of this request and will log it
            identifier = cycle.scope.get("state", {}).get("request_id", identifier)
            cycle.scope.setdefault("state", {})["answered"] = int(status)
        if self._answered or not cycle.response_started:
            self.transport.write(_response(status, identifier, seconds))
        self.transport.close()


def _response(status: HTTPStatus, identifier: str, seconds: float) -> bytes:
    document = problem(
        identifier, status, code_of(status.phrase), status.phrase, detail=status.description or status.phrase
    )
    headers = [*document.raw_headers, *own_headers(identifier, seconds), (b"connection", b"close")]
    if status == HTTPStatus.SERVICE_UNAVAILABLE:
        headers.append((b"retry-after", b"1"))
    lines = b"".join(b"%s: %s\r\n" % header for header in headers)
    return STATUS_LINE[status] + lines + b"\r\n" + bytes(document.body)


class Server(uvicorn.Server):
    """A server that logs its address once it listens, and stops quickly when it is interrupted at the terminal."""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Begin to answer."""
        await super().startup(sockets)
        host = f"[{self.config.host}]" if ":" in self.config.host else self.config.host
        log.info("tribodrive: docs at http://%s:%d/docs", host, self.config.port)

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        """SIGTERM lets requests in flight finish; Ctrl-C gives them half a second, a second Ctrl-C no less."""
        if sig == signal.SIGINT:
            if self.config.timeout_graceful_shutdown == INTERRUPT_S:
                return
            self.config.timeout_graceful_shutdown = INTERRUPT_S  # type: ignore[assignment]  # any number will do
        super().handle_exit(sig, frame)


def run(address: str, listeners: list[socket.socket], template: Template) -> None:
    """Serve on the open ports until told to stop."""
    limits = settings()
    application = import_from_string(address)
    application.state.template = template
    gc.freeze()  # what was imported stays: looking through it for garbage would hold up requests for 0.1 s each time
    gc.enable()
    logging.getLogger("uvicorn").setLevel(logging.WARNING)
    config = uvicorn.Config(
        application,
        host=limits.host,
        port=limits.port,
        loop="uvloop",
        http=LimitedProtocol,
        access_log=False,
        server_header=False,
        log_config=None,
        timeout_graceful_shutdown=limits.shutdown_s,
    )
    Server(config).run(listeners)
