"""uvicorn as this service runs it: own protocol, own log, an end that does not keep anybody waiting."""

import signal
import socket
import sys
from types import FrameType

import uvicorn

from app import log
from app.connection import LimitedProtocol
from app.settings import settings

INTERRUPT_S = 0.5


class Server(uvicorn.Server):
    """A server that says where it listens once it does, and hurries when it is interrupted at the terminal."""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Begin to answer."""
        await super().startup(sockets)
        host = f"[{self.config.host}]" if ":" in self.config.host else self.config.host
        log.WRITER.write(sys.stdout.fileno(), f"tribodrive: docs at http://{host}:{self.config.port}/docs\n")

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        """SIGTERM lets requests in flight finish; Ctrl-C gives them half a second."""
        if sig == signal.SIGINT:
            self.config.timeout_graceful_shutdown = INTERRUPT_S  # type: ignore[assignment]  # any number will do
        super().handle_exit(sig, frame)


def run(factory: str, listener: socket.socket) -> None:
    """Serve on the open port until told to stop."""
    limits = settings()
    log.install(limits.log_level)
    config = uvicorn.Config(
        factory,
        factory=True,
        host=limits.host,
        port=limits.port,
        loop="uvloop",
        http=LimitedProtocol,
        access_log=False,
        server_header=False,
        log_config=None,
        timeout_graceful_shutdown=limits.shutdown_s,
    )
    try:
        Server(config).run([listener])
    finally:
        log.WRITER.close()
