"""The log, written by a thread of its own: a reader that stalls costs lines, which are counted, never a request.

Lines of answered requests go to the standard output, everything else to the standard error.
"""

import logging
import os
import queue
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from logging.handlers import QueueHandler, QueueListener

from app.metrics import LINES_DROPPED

LINES_KEPT = 10_000
LAST_LINES_S = 1.0
REQUESTS = "tribodrive.requests"


class _Handler(QueueHandler):
    """Puts records into the queue while there is room."""

    queue: "queue.SimpleQueue[logging.LogRecord | None]"

    def enqueue(self, record: logging.LogRecord) -> None:
        """Hand a record over, or count it as lost."""
        if self.queue.qsize() < LINES_KEPT:
            self.queue.put(record)
        else:
            LINES_DROPPED.inc()

    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802  logging's name
        """What cannot be formatted must not harm the caller."""
        del record
        LINES_DROPPED.inc()


class _Output:
    """Writes records; not one of logging's handlers, which the end of the process waits for."""

    level = logging.NOTSET

    def handle(self, record: logging.LogRecord) -> None:
        """Write one record; no failure ends the thread."""
        try:
            stream = sys.stdout if record.name == REQUESTS else sys.stderr
            _write_all(stream.fileno(), f"{record.getMessage()}\n".encode(errors="replace"))
        except Exception:  # noqa: BLE001
            LINES_DROPPED.inc()


class _Listener(QueueListener):
    """The thread that writes; at the end it has a second for what is left."""

    def stop(self) -> None:
        """Let the thread end, if anybody reads what it writes."""
        self.enqueue_sentinel()
        if self._thread is not None:
            self._thread.join(LAST_LINES_S)


@contextmanager
def running(level: str) -> Iterator[None]:
    """Send what is logged through the queue while the context is open, unless the server of another has a log."""
    lines: queue.SimpleQueue[logging.LogRecord | None] = queue.SimpleQueue()
    handler = _Handler(lines)
    listener = _Listener(lines, _Output())  # type: ignore[arg-type]  # anything that handles records
    logger = logging.getLogger("tribodrive")
    logger.setLevel(level.upper())
    logger.propagate = False
    loggers = [logger, *([logging.root] if not logging.root.handlers else [])]
    for each in loggers:
        each.addHandler(handler)
    listener.start()
    try:
        yield
    finally:
        for each in loggers:
            each.removeHandler(handler)
        listener.stop()


def _write_all(descriptor: int, content: bytes) -> None:
    while content:
        try:
            content = content[os.write(descriptor, content) :]
        except BlockingIOError:
            time.sleep(0.01)
        except OSError:  # nobody reads any more
            return
