"""The log, written by a thread of its own: a reader that stalls costs lines, which are counted, never a request."""

import logging
import os
import queue
import sys
import threading
import time

from app.metrics import LINES_DROPPED

LINES_KEPT = 10_000
LAST_LINES_S = 1.0


class LogWriter:
    """A bounded queue of lines and the thread that writes them."""

    def __init__(self) -> None:
        self._lines: queue.Queue[tuple[int, str] | None] = queue.Queue(LINES_KEPT)
        self._thread = threading.Thread(target=self._write_lines, daemon=True)

    def start(self) -> None:
        """Begin to write."""
        self._thread.start()

    def close(self) -> None:
        """Write what is left, as far as it goes within a second."""
        try:
            self._lines.put_nowait(None)
        except queue.Full:
            return
        if self._thread.is_alive():
            self._thread.join(LAST_LINES_S)

    def write(self, descriptor: int, text: str) -> None:
        """Hand over some text, or count it as lost."""
        try:
            self._lines.put_nowait((descriptor, text))
        except queue.Full:
            LINES_DROPPED.inc()

    def _write_lines(self) -> None:
        while (line := self._lines.get()) is not None:
            descriptor, text = line
            _write_all(descriptor, text.encode(errors="replace"))


class QueuedHandler(logging.Handler):
    """Sends log records the same way."""

    def emit(self, record: logging.LogRecord) -> None:
        """Format and hand over; what cannot be formatted must not harm the caller."""
        try:
            WRITER.write(sys.stderr.fileno(), self.format(record) + "\n")
        except Exception:  # noqa: BLE001
            LINES_DROPPED.inc()


WRITER = LogWriter()


def install(level: str) -> None:
    """Send everything that is logged through the writer's queue."""
    logging.basicConfig(level=level.upper(), format="%(message)s", handlers=[QueuedHandler()], force=True)
    logging.getLogger("uvicorn").setLevel(logging.WARNING)
    WRITER.start()


def _write_all(descriptor: int, content: bytes) -> None:
    while content:
        try:
            content = content[os.write(descriptor, content) :]
        except BlockingIOError:
            time.sleep(0.01)
        except OSError:  # nobody reads any more
            return
