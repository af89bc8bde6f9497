"""uvicorn as this service runs it: with its own protocol, its own log and a short shutdown."""

import gc
import logging
import signal
import socket
from types import FrameType

import uvicorn
from uvicorn.importer import import_from_string

from app.http.connection import LimitedProtocol
from app.log import REQUEST_LOG
from app.settings import settings
from app.workers.control import Template

INTERRUPT_S = 0.5  # for requests in flight after Ctrl-C

log = logging.getLogger(REQUEST_LOG)  # which goes to the standard output


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
