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
GATHERING_S = 0.02
MOST_AT_ONCE = 1000


class LogWriter:
    """A bounded queue of lines and the thread that writes them, some at a time, so that it seldom interrupts."""

    def __init__(self) -> None:
        self._lines: queue.SimpleQueue[tuple[int, str] | None] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._write_lines, daemon=True)

    def start(self) -> None:
        """Begin to write."""
        self._thread.start()

    def close(self) -> None:
        """Write what is left, as far as it goes within a second."""
        self._lines.put(None)
        if self._thread.is_alive():
            self._thread.join(LAST_LINES_S)

    def write(self, descriptor: int, text: str) -> None:
        """Hand over some text, or count it as lost."""
        if self._lines.qsize() < LINES_KEPT:
            self._lines.put((descriptor, text))
        else:
            LINES_DROPPED.inc()

    def _write_lines(self) -> None:
        while (first := self._lines.get()) is not None:
            time.sleep(GATHERING_S)
            if self._write_batch(first):
                return

    def _write_batch(self, line: tuple[int, str] | None) -> bool:
        """Write the line and those that wait behind it; whether the end is reached."""
        texts: dict[int, list[str]] = {}
        for room in range(MOST_AT_ONCE, 0, -1):
            if line is None:
                break
            texts.setdefault(line[0], []).append(line[1])
            if room == 1 or self._lines.empty():
                break
            line = self._lines.get()
        for descriptor, waiting in texts.items():
            _write_all(descriptor, "".join(waiting).encode(errors="replace"))
        return line is None


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
